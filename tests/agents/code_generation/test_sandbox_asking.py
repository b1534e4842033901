"""Programs can ask people in the track where the robot can, and in no other."""

from typing import Any

import pytest

from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.basics.errors import ProgramError
from memorymaze.robot.api.asking import Question, way_to, where_is


@pytest.fixture
def asking_robot(robot: Any) -> Any:
    """A robot that records its calls, and whose people answer."""

    def ask(question: Question) -> str:
        robot.calls.append(("ask", question))
        return f"{question.about}? Left."

    robot.ask = ask
    robot.destination = lambda: "the library"
    robot.questions_left = lambda: 2
    return robot


def test_a_program_asks_and_hears_words(asking_robot: Any) -> None:
    program = """
answer = ask(way_to(destination()))
if answer is not None and "left" in answer.lower():
    turn("left")
asked = where_is("a bin")
say(ask(question=asked) + f" {asked.kind} {questions_left()}")
"""
    run_program(program, asking_robot)
    assert asking_robot.calls == [
        ("ask", way_to("the library")),
        ("turn", "left"),
        ("ask", where_is("a bin")),
        ("say", "a bin? Left. where_is 2"),
    ]


@pytest.mark.parametrize("call", ["ask(way_to('x'))", "destination()"])
def test_elsewhere_no_program_can_ask(robot: Any, call: str) -> None:
    with pytest.raises(ProgramError, match="line 1"):
        run_program(call, robot)
    assert robot.calls == []


def test_words_are_no_question(asking_robot: Any) -> None:
    with pytest.raises(ProgramError, match="invalid-argument-type"):
        run_program("ask('where is the library?')", asking_robot)


def test_a_question_made_up_by_the_program_is_refused(asking_robot: Any) -> None:
    program = """
from typing import Any
def made() -> Any:
    return [1]
ask(made())
"""
    with pytest.raises(ProgramError, match="made by way_to"):
        run_program(program, asking_robot)
