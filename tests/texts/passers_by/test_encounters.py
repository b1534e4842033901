import math
from collections.abc import Callable
from typing import Any

import pytest

from memorymaze.basics.errors import CommandError
from memorymaze.robot.api.asking import Question, is_this, way_to, where_is
from memorymaze.robot.simulation.obstacles.crowd import Person
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.texts.passers_by import Encounters

Meet = Callable[..., tuple[SimulatedRobot, Encounters, Person]]


def test_somebody_near_answers_in_words_and_it_counts(met: Meet) -> None:
    _, people, _ = met()
    words = people.ask(way_to("the library"))
    assert isinstance(words, str)
    assert len(words.split()) > 2
    assert people.questions_left == 2
    assert [each.person for each in people.asked] == ["person-0"]


def test_nobody_near_is_no_answer_and_costs_nothing(met: Meet) -> None:
    robot, people, _ = met((0.0, -2.5))
    assert people.ask(way_to("the library")) is None
    assert people.questions_left == 3
    assert people.in_vain == 1
    assert robot.time == 0.0


def test_somebody_behind_the_robot_can_be_asked(met: Meet) -> None:
    _, people, _ = met((0.0, -8.5))
    assert people.ask(way_to("the library")) is not None


def test_nobody_is_asked_through_a_wall(met: Meet) -> None:
    robot, people, person = met((2.0, -0.7))
    robot.move_forward(4.0)
    # Round the corner of the junction.
    person.x, person.y = 2.0, -0.7
    assert math.dist((person.x, person.y), robot.pose[:2]) < 2.7
    assert people.ask(way_to("the library")) is None
    person.x = 0.8
    assert people.ask(way_to("the library")) is not None


def test_nobody_answers_when_no_question_is_left(met: Meet) -> None:
    _, people, _ = met(questions=1)
    assert people.ask(way_to("the library")) is not None
    assert people.questions_left == 0
    assert people.ask(way_to("the library")) is None
    assert len(people.asked) == 1


def test_both_stand_while_they_speak_and_the_time_for_walking_stays(met: Meet) -> None:
    robot, people, person = met(time_budget=3.0)
    before = person.x, person.y
    words = people.ask(way_to("the library"))
    assert words is not None
    said = len(f"{way_to('the library')} {words}".split())
    assert people.seconds == pytest.approx(said / 2.5, abs=0.02)
    assert robot.time == pytest.approx(people.seconds, abs=0.1)
    assert robot.time > 3.0
    assert robot.stopped_by is None
    assert math.dist(before, (person.x, person.y)) < 0.3
    assert robot.move_forward(1.0).reason == "done"


def test_the_trace_has_question_and_answer(met: Meet) -> None:
    robot, people, _ = met()
    events: list[Any] = []
    robot._log._on_event = events.append
    words = people.ask(is_this("the library"))
    [event] = events
    assert event.call == "ask"
    assert event.arguments == {"question": "Excuse me, is this the library?"}
    assert event.result == words


def test_the_same_seed_gives_the_same_answers(met: Meet) -> None:
    def talk(seed: int) -> list[str | None]:
        _, people, _ = met(seed=seed, error_rate=0.5)
        asked = (way_to("the library"), where_is("a chair"), is_this("the lift"))
        return [people.ask(question) for question in asked]

    assert talk(1) == talk(1)
    assert len({tuple(talk(seed)) for seed in range(4)}) > 1


def test_a_person_asked_twice_says_the_same(met: Meet) -> None:
    _, people, _ = met(error_rate=0.5)
    first, second = (people.ask(way_to("the library")) for _ in range(2))
    assert first == second


@pytest.mark.parametrize(
    "question",
    ["where is the library?", Question("way_to", "  "), Question("way_to", "a" * 300)],
    ids=["words", "nothing", "too much"],
)
def test_what_is_no_question_is_refused(met: Meet, question: Any) -> None:
    _, people, _ = met()
    with pytest.raises(CommandError, match="ask: expected"):
        people.ask(question)
    assert people.questions_left == 3
