"""Only what is certainly wrong keeps a program from running."""

import json

import pytest

from memorymaze.agents.code_generation.program_check import first_error, read_findings
from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import ProgramError

WRONG = {
    "an undefined name in a branch": "if turning_point_id() == 99:\n    go()",
    "an unknown attribute of a list of results": "detect_from_RGB_image('a').label",
    "too many arguments of an alias": "f = say\nf('a', 'b')",
    "a number plus a result": "1 + move_forward(1)",
    "a result that is called": "turn('left')()",
    "a result that is unpacked": "a, b = move_forward(1)",
    "an attribute a module lacks": "import math\nmath.tau_squared",
}

DOUBTFUL = {
    "a name that is defined in a loop": (
        "for i in range(len(detect_turning_point())):\n    x = i\n"
        "if False:\n    say(str(x))"
    ),
    "arithmetic on what may be nothing": "if False:\n    turning_point_id() + 1",
    "an annotation that does not fit": "metres: int = 2.5",
    "a result annotated as something else": (
        "def go() -> bool:\n    return move_forward(1)\ngo()"
    ),
    "an argument that may be nothing": "x = turning_point_id()\nif x:\n    pass\n"
    "if False:\n    move_forward(turning_point_id())",
    "a late future import": "from __future__ import annotations\nmove_forward(1)",
    "an attribute given to an object": "class A:\n    pass\na = A()\na.x = 1",
    "a builtin the checker does not know": "getattr(move_forward(1), 'reason')",
    "no doubt: numbers of both kinds": "x = 1\nx = x + 0.5\nmove_forward(x)",
    "no doubt: a tuple of functions": "for f in (say, turn):\n    f('x')",
}


@pytest.mark.parametrize("program", WRONG.values(), ids=WRONG)
def test_what_is_certainly_wrong_is_refused_before_the_robot_moves(program, robot):
    with pytest.raises(ProgramError) as caught:
        run_program(f"move_forward(1)\n{program}", robot)

    assert robot.calls == []
    assert not caught.value.unsafe


@pytest.mark.parametrize("program", DOUBTFUL.values(), ids=DOUBTFUL)
def test_what_may_work_is_run(program, robot):
    events: list[dict[str, object]] = []

    run_program(program, robot, on_event=events.append)

    assert [event["kind"] for event in events] == ["doubts"] * len(events)


def diagnostic(rule: str, message: str, line: int = 1, severity: str = "error") -> str:
    return json.dumps({
        "code": rule,
        "message": message,
        "location": {"row": line, "column": 1},
        "severity": severity,
    })


def test_what_is_no_python_is_told_first_and_then_what_is_unsafe():
    undefined = diagnostic("unresolved-reference", "Name `x` used when not defined", 1)
    unsafe = diagnostic("unresolved-import", "Cannot resolve imported module `a`", 2)
    syntax = diagnostic("invalid-syntax", "Expected an expression", 3)

    for diagnostics, line in (
        ([undefined], 1),
        ([undefined, unsafe], 2),
        ([undefined, unsafe, syntax], 3),
    ):
        error = first_error(read_findings("\n".join(diagnostics)))
        assert error is not None
        assert error.line == line
        assert error.unsafe == (line == 2)


def test_what_a_message_quotes_does_not_break_it_up(robot):
    with pytest.raises(ProgramError, match=r"^line 2: "):
        run_program("move_forward(1)\nsay(\x85\u2028)", robot)


def test_warnings_do_not_count():
    warning = diagnostic("unresolved-reference", "Name `x`", severity="warning")

    assert read_findings(f"{warning}\n\n") == []
    assert first_error([]) is None
