"""Asking people on the way: when the guide does, and what it makes of their answers."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from memorymaze.agents.agent import TOLD_AGAIN, Journal
from memorymaze.agents.guide import GuideAgent
from memorymaze.agents.guide.agent import GuideOptions
from memorymaze.agents.guide.asking import Inquiry, Situation, destination_names
from memorymaze.language.reading import parse_route_description
from memorymaze.robot.api.asking import Question
from memorymaze.robot.api.control import Robot

Walk = Any
TakeWalk = Callable[..., Walk]

WELL = Situation(share=0.95, doubt=0.02, over=0.0)
LOST = Situation(share=0.1, doubt=0.9, over=1.0)


class Crowded:
    """A robot that always has somebody beside it, who says one thing after another."""

    def __init__(self, robot: Robot, destination: str, answers: Sequence[str]) -> None:
        self._robot = robot
        self._destination = destination
        self._answers = list(answers)
        self.asked: list[Question] = []

    def __getattr__(self, name: str) -> object:
        return getattr(self._robot, name)

    def destination(self) -> str:
        return self._destination

    def questions_left(self) -> int:
        return len(self._answers)

    def ask(self, question: Question) -> str | None:
        if not self._answers:
            return None
        self.asked.append(question)
        return self._answers.pop(0)


@pytest.fixture
def ask_on(walk_with: TakeWalk) -> TakeWalk:
    """Walk where somebody answers: `ask_on(start, text, destination, answers, **options)`."""

    def walk(
        start: str, text: str, destination: str, said: Sequence[str], **options: Any
    ) -> Walk:
        agent = GuideAgent(GuideOptions(**options))
        return walk_with(
            agent, start, text, as_seen=lambda r: Crowded(r, destination, said)
        )

    return walk


def inquiry(when: Any, *answers: str, seed: int = 0) -> Inquiry:
    robot: Any = Crowded(None, "the library", answers)  # type: ignore[arg-type]
    rng = np.random.default_rng(seed)
    return Inquiry(robot, when, 100.0, Journal(), rng)


def test_an_answer_corrects_a_turn_that_was_told_to_the_wrong_side(
    ask_on: TakeWalk,
) -> None:
    told = "At the end turn left and go to the end."
    answers = ["Turn right at the end and go to the end. It is the lift at the end."]
    assert ask_on("t_junction", told, "the lift", [], ask="start").ends_near(-11, 0)
    assert ask_on("t_junction", told, "the lift", answers, ask="start").ends_near(11, 0)


def test_answers_that_do_not_count_change_nothing(ask_on: TakeWalk) -> None:
    told = "At the end turn left and walk up to the clock."
    answers = ["Turn right at the end and go to the end."]
    walk = ask_on("t_junction", told, "the clock", answers, ask="start", answers=False)
    assert walk.notes("asked")
    assert walk.ends_near(-4, 0)


def test_who_was_told_nothing_goes_by_the_answer_alone(ask_on: TakeWalk) -> None:
    answers = ["At the crossing turn left. The kitchen is at the end."]
    told = "Turn right at the crossing and walk to the end."
    walk = ask_on("crossing", told, "the kitchen", answers, ask="start", told=False)
    assert walk.ends_near(0, 11)


def test_nothing_is_asked_where_there_is_nobody_to_ask(walk_with: TakeWalk) -> None:
    walk = walk_with(GuideAgent(), "t_junction", "At the end turn left.")
    assert not walk.notes("asked")


def test_where_nothing_that_was_told_fits_and_nobody_is_near_the_guide_gives_up(
    walk_with: TakeWalk,
) -> None:
    class Deserted(Crowded):
        def ask(self, question: Question) -> str | None:
            return None

    told = "Turn left, then turn right at the fifth crossing. " * 20
    walk = walk_with(
        GuideAgent(GuideOptions(ask="lost")),
        "l_shape",
        told,
        as_seen=lambda robot: Deserted(robot, "the kitchen", ["Turn left."]),
    )
    assert walk.notes("gave_up")


def test_the_same_way_told_twice_leads_to_the_same_place(walk_with: TakeWalk) -> None:
    once = "Turn left at the T junction and go to the end."
    twice = once + TOLD_AGAIN + "At the end go left, then straight on to the end."
    assert walk_with(GuideAgent(), "t_junction", twice).ends_near(-11, 0)


def test_one_telling_outvotes_an_error_in_the_other(walk_with: TakeWalk) -> None:
    wrong = "Turn right at the T junction. You end at the clock."
    right = "Turn left at the T junction, walk a few metres, and there is the clock."
    walk = walk_with(GuideAgent(), "t_junction", wrong + TOLD_AGAIN + right)
    assert walk.ends_near(-4, 0)


@pytest.mark.parametrize(
    ("when", "situation", "asks"),
    [
        ("never", LOST, False),
        ("start", WELL, True),
        ("lost", WELL, False),
        ("lost", LOST, True),
        ("gain", WELL, False),
        ("gain", LOST, True),
    ],
)
def test_each_policy_asks_when_it_is_time(
    when: str, situation: Situation, asks: bool
) -> None:
    asked = inquiry(when, "Turn left.").way(lambda: situation, 0.0) is not None
    assert asked == asks


def test_random_moments_come_on_the_way_whatever_the_situation() -> None:
    random = inquiry("random", "Turn left.")
    assert random.way(lambda: LOST, 0.0) is None
    assert random.way(lambda: WELL, 100.0) is not None


@pytest.mark.parametrize(
    "words",
    ["I don't know, sorry.", "No idea.", "It's on this floor, I think."],
)
def test_who_does_not_know_the_way_is_not_heeded(words: str) -> None:
    assert inquiry("start", words).way(lambda: WELL, 0.0) is None


def test_a_way_that_begins_by_turning_back_is_told_from_there() -> None:
    answer = inquiry("start", "Turn around, then take the first left.").way(
        lambda: WELL, 0.0
    )
    assert answer is not None
    assert answer.turned_back
    assert [leg.turn.way for leg in answer.plan.legs] == ["left"]


def test_an_answer_that_ends_before_the_destination_breaks_off() -> None:
    words = "Go straight on and turn left at the end, then ask somebody there."
    answer = inquiry("start", words).way(lambda: WELL, 0.0)
    assert answer is not None
    assert answer.breaks_off


def test_the_users_name_of_the_destination_comes_first() -> None:
    plan = parse_route_description("Turn left and walk to the green door.")
    names = inquiry("never").named(plan).arrival.destinations
    assert names[0] == "library"
    assert "green door" in names


def test_what_the_user_calls_the_destination_is_what_to_look_for() -> None:
    assert "conference room 6" in destination_names("Conference Room 6")
    assert destination_names("the terrace") == ("terrace",)


class Deserted:
    """A place where somebody comes by only after the robot has turned some times."""

    def __init__(self, when: Any, comes_after: int) -> None:
        self.comes_after = comes_after
        self.turns = 0
        robot: Any = self
        rng = np.random.default_rng(0)
        self.inquiry = Inquiry(robot, when, 100.0, Journal(), rng)

    def destination(self) -> str:
        return "the library"

    def turn_by(self, degrees: float) -> None:
        self.turns += 1

    def questions_left(self) -> int:
        return 1

    def ask(self, question: Question) -> str | None:
        return "Turn left." if self.turns >= self.comes_after else None


def test_rather_than_stop_at_an_unlikely_place_it_waits_for_somebody_to_ask() -> None:
    here: Any = Deserted("gain", comes_after=5)
    assert here.inquiry.before_stopping(0.3, here) is not None
    assert here.turns == 5


def test_nobody_is_waited_for_at_a_likely_place() -> None:
    here: Any = Deserted("gain", comes_after=0)
    assert here.inquiry.before_stopping(0.9, here) is None


def test_it_waits_in_vain_once() -> None:
    here: Any = Deserted("gain", comes_after=10_000)
    assert here.inquiry.before_stopping(0.3, here) is None
    turned = here.turns
    assert turned > 0
    assert here.inquiry.before_stopping(0.3, here) is None
    assert here.turns == turned


def test_success_is_less_likely_the_more_is_wrong() -> None:
    assert WELL.success > 0.75 > LOST.success


def test_the_last_question_is_kept_for_a_greater_need() -> None:
    unsure = Situation(share=0.9, doubt=0.08, over=0.0)
    assert inquiry("gain", "Turn left.").way(lambda: unsure, 0.0) is None
    three = inquiry("gain", "Turn left.", "Turn left.", "Turn left.")
    assert three.way(lambda: unsure, 0.0) is not None
