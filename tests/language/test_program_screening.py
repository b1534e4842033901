"""A program is checked as before a run, and not run."""

import pytest

from memorymaze.errors import ProgramError
from memorymaze.language.program_limits import ProgramLimits
from memorymaze.language.program_screening import screen_program


@pytest.mark.parametrize(
    "program",
    [
        "move_forward(1)\nstop()\n",
        "",
        "while True:\n    pass\n",
        "print(1 / 0)",
        "'''What it does.'''\nturn('left')",
    ],
)
def test_what_only_a_run_would_show_is_not_found(program: str) -> None:
    assert screen_program(program) == []


@pytest.mark.parametrize(
    ("program", "line", "unsafe", "said"),
    [
        ("x = 1\nmove_forward('2 m')", 2, False, "line 2: Argument to function"),
        ("  x = 1", 1, False, "Unexpected indentation"),
        ("turn('left'", 1, False, "invalid-syntax"),
        ("stop()\n\nimport numpy", 3, True, "line 3: Cannot resolve"),
        ("open('/etc/passwd')", 1, True, "`open`"),
        ("walk()", 1, False, "`walk` used when not defined"),
        ("a" * 11, None, False, "has 11 characters; at most 10"),
    ],
)
def test_what_the_sandbox_would_refuse_is_found(
    program: str, line: int | None, unsafe: bool, said: str
) -> None:
    limits = ProgramLimits(program_characters=max(10, 0 if line is None else 100))
    with pytest.raises(ProgramError, match=said) as caught:
        screen_program(program, limits)
    assert (caught.value.line, caught.value.unsafe) == (line, unsafe)


def test_doubts_are_told_with_their_line() -> None:
    assert screen_program("stop()\nx: int = 'a'") == [
        'line 2: Object of type `Literal["a"]` is not assignable to `int`'
    ]
