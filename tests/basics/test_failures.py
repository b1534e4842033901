import pytest

from memorymaze.agents.stop import StopAgent
from memorymaze.basics.errors import LanguageModelError, ProgramError
from memorymaze.basics.failures import (
    WorkerLost,
    failure_line,
    failure_traceback,
)


class Mute(Exception):
    def __str__(self) -> str:
        raise RuntimeError("nothing to say")


def raised(problem: BaseException) -> BaseException:
    try:
        raise problem
    except BaseException as caught:
        return caught


@pytest.mark.parametrize(
    ("problem", "line"),
    [
        pytest.param(ValueError("a\nb  c"), "ValueError: a b c", id="one line"),
        pytest.param(ValueError(), "ValueError: no message", id="silent"),
        pytest.param(
            ValueError("\x1b[31m \ud800 é"),
            r"ValueError: \x1b[31m \ud800 é",
            id="printable",
        ),
        pytest.param(
            Mute(), "Mute: a message that cannot be shown (RuntimeError)", id="mute"
        ),
        pytest.param(
            ProgramError("line 3: bad", line=3), "ProgramError: line 3: bad", id="line"
        ),
        pytest.param(
            ProgramError("bad", line=3),
            "ProgramError: bad (line 3 of the program)",
            id="line unsaid",
        ),
    ],
)
def test_a_failure_is_one_printable_line(problem: BaseException, line: str) -> None:
    assert failure_line(problem) == line


def test_the_place_in_the_agents_own_file_is_said() -> None:
    def call(depth: int) -> None:
        StopAgent().follow("", None, None, None)  # type: ignore[arg-type]

    with pytest.raises(AttributeError) as caught:
        call(1)
    inside = failure_line(caught.value, StopAgent())
    assert " (stop.py, line " in inside
    outside = failure_line(raised(KeyError("x")), StopAgent())
    assert " (test_failures.py, line " in outside


def test_the_place_is_kept_when_the_message_is_cut() -> None:
    line = failure_line(raised(ValueError("x" * 9999)))
    assert len(line) == 500
    assert line.endswith(")")


def test_failures_that_explain_themselves_leave_no_traceback() -> None:
    for problem in (ProgramError("a"), LanguageModelError("b"), WorkerLost("c")):
        assert failure_traceback(raised(problem)) == []
    lines = failure_traceback(raised(ValueError("d")))
    assert lines[-1] == "ValueError: d"
    assert any("in raised" in line for line in lines)


def test_an_endless_recursion_leaves_a_short_traceback() -> None:
    def deeper() -> None:
        deeper()

    with pytest.raises(RecursionError) as caught:
        deeper()
    assert len(failure_traceback(caught.value)) < 61
