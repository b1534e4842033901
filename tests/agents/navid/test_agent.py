"""The loop: pictures out, answers in, primitives done, budgets kept."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from memorymaze.agents.agent import Agent, Journal
from memorymaze.agents.navid import NavidAgent, NavidOptions
from memorymaze.agents.navid.policy import Answer, Command, Frame, Task
from memorymaze.errors import (
    CommandError,
    EpisodeOver,
    LanguageModelError,
    SettingsError,
)
from memorymaze.language.model import Completion, Usage

TEXT = "Down the hall, then left."
AHEAD = "The next action is move forward 75 cm."


class TalkingPolicy:
    """Says its sentences in turn, the last one again and again; keeps what it saw."""

    name = "talker"

    def __init__(self, *sentences: str | Sequence[Any]) -> None:
        self.sentences = sentences
        self.tasks: list[Task] = []
        self.video: list[tuple[str, Frame]] = []
        self.problems: list[str | None] = []
        self.closed = 0

    def begin(self, task: Task) -> "TalkingPolicy":
        self.tasks.append(task)
        return self

    def observe(self, frame: Frame) -> None:
        self.video.append(("observe", frame))

    def act(self, frame: Frame, problem: str | None = None) -> Answer:
        said = self.sentences[min(len(self.problems), len(self.sentences) - 1)]
        self.video.append(("act", frame))
        self.problems.append(problem)
        completion = Completion(str(said), self.name, Usage(10, 2), 0.5)
        if isinstance(said, str):
            return Answer(completion, said)
        return Answer(completion, "", tuple(said))

    def close(self) -> None:
        self.closed += 1


def follow(
    policy: TalkingPolicy, robot: object, *, fair_steps: int | None = None, **options
) -> tuple[str, Journal]:
    """Follow, and return what ended it and the journal."""
    agent = NavidAgent(policy, NavidOptions(**options))
    journal = Journal()
    with pytest.raises(EpisodeOver) as over:
        agent.follow(TEXT, robot, journal, np.random.default_rng(0), fair_steps)
    return over.value.stopped_by, journal


def test_what_is_answered_is_done_by_primitives(robot):
    policy = TalkingPolicy(
        AHEAD, "turn left 60 degrees", "turn right 30 degrees", "stop"
    )

    assert follow(policy, robot)[0] == "agent"

    assert robot.calls == [
        *[("forward", 0.25)] * 3,
        *[("rotate", 30)] * 2,
        ("rotate", -30),
    ]
    assert robot.stopped
    assert policy.tasks[0].instruction == TEXT
    assert policy.closed == 1


def test_every_primitive_gives_one_picture_of_the_video(robot):
    policy = TalkingPolicy(AHEAD, "turn left 60 degrees", "stop")

    follow(policy, robot)

    assert [(how, frame.step, frame.after) for how, frame in policy.video] == [
        ("act", 0, None),
        ("observe", 1, "forward"),
        ("observe", 2, "forward"),
        ("act", 3, "forward"),
        ("observe", 4, "left"),
        ("act", 5, "left"),
    ]
    # The picture after n motions is the one taken then.
    assert [int(frame.rgb[0, 0, 0]) for _, frame in policy.video] == [0, 1, 2, 3, 4, 5]


def test_pictures_have_names_by_what_was_done_in_which_episode(make_robot):
    def names(*sentences: str, seed: int = 0) -> list[str]:
        policy = TalkingPolicy(*sentences, "stop")
        with pytest.raises(EpisodeOver):
            NavidAgent(policy).follow(
                TEXT, make_robot(), Journal(), np.random.default_rng(seed)
            )
        return [frame.name for _, frame in policy.video]

    ahead = names(AHEAD)
    assert names(AHEAD) == ahead
    assert len(set(ahead)) == len(ahead) == 4
    assert names("forward 25 cm", "left 30 degrees")[:2] == ahead[:2]
    assert names("left 30 degrees")[1] != ahead[1]
    assert not set(names(AHEAD, seed=1)) & set(ahead)


def test_each_answer_is_counted_and_noted(robot):
    _, journal = follow(TalkingPolicy(AHEAD, "stop"), robot)

    assert (journal.model_calls, journal.tokens, journal.inference_s) == (2, 24, 1.0)
    assert [note["kind"] for note in journal.notes] == [
        "model_reply",
        "decision",
        "model_reply",
        "decision",
    ]
    assert journal.notes[1]["motions"] == [["forward", 3]]
    assert journal.notes[1]["step"] == 0
    assert journal.notes[1]["picture"] != journal.notes[3]["picture"]


def test_motions_in_a_policys_own_terms_are_done_in_turn(robot):
    policy = TalkingPolicy([Command("left"), Command("forward", 2), Command("stop")])

    assert follow(policy, robot)[0] == "agent"
    assert robot.calls == [("rotate", 30), ("forward", 0.25), ("forward", 0.25)]


def test_an_unreadable_answer_is_asked_for_once_more_and_then_nothing_is_done(robot):
    policy = TalkingPolicy("Hm.", "Er.", "Hm.", AHEAD, "stop")

    assert follow(policy, robot)[0] == "agent"

    assert robot.calls == [("forward", 0.25)] * 3
    first, again = policy.problems[:2]
    assert first is None
    assert "no command" in again
    steps = [frame.step for how, frame in policy.video if how == "act"]
    assert steps == [0, 0, 1, 1, 4]
    assert policy.video[2][1].after is None


def test_five_unreadable_decisions_in_a_row_are_a_model_error(robot):
    policy = TalkingPolicy("Hm.", "Hm.", AHEAD, "Hm.")

    with pytest.raises(LanguageModelError, match="talker: 5 decisions in a row"):
        NavidAgent(policy).follow(TEXT, robot, Journal(), np.random.default_rng(0))

    assert robot.calls == [("forward", 0.25)] * 3
    assert len(policy.problems) == 2 + 1 + 10
    assert not robot.stopped
    assert policy.closed == 1


def test_faithful_draws_a_seeded_motion_for_an_unreadable_answer(make_robot):
    def drawn(seed: int) -> list[object]:
        robot = make_robot()
        policy = TalkingPolicy(*["turn left 13 degrees."] * 30, "stop.")
        agent = NavidAgent(policy, NavidOptions(faithful=True, still_steps=30))
        with pytest.raises(EpisodeOver):
            agent.follow(TEXT, robot, Journal(), np.random.default_rng(seed))
        assert policy.problems == [None] * 31
        return robot.calls

    assert drawn(0) == drawn(0) != drawn(1)
    assert set(drawn(0)) == {("forward", 0.25), ("rotate", 30), ("rotate", -30)}


def test_faithful_misses_a_stop_without_its_full_stop(robot):
    policy = TalkingPolicy("stop", "stop.")

    follow(policy, robot, faithful=True)

    assert len(robot.calls) == 1


def test_the_released_budget_ends_after_400_steps_and_that_is_no_stop(robot):
    ended, journal = follow(TalkingPolicy(AHEAD), robot, budget="released")

    assert ended == "budget"
    assert len(robot.calls) == 400
    assert not robot.stopped
    assert journal.notes[-1] == {"kind": "out_of_steps", "step": 400, "limit": 400}


@pytest.mark.parametrize(
    ("options", "steps"),
    [
        ({"fair_steps": 30}, 30),
        ({"fair_steps": 30, "max_steps": 7}, 7),
        ({"fair_steps": 30, "budget": "released", "max_steps": 500}, 500),
        ({"fair_steps": 30, "budget": "released"}, 400),
    ],
)
def test_the_fair_budget_is_what_the_place_allows(robot, options, steps):
    assert follow(TalkingPolicy(AHEAD), robot, **options)[0] == "budget"
    assert len(robot.calls) == steps


def test_a_stop_after_the_last_step_still_counts(robot):
    assert follow(TalkingPolicy(AHEAD, "stop"), robot, max_steps=3)[0] == "agent"


@pytest.mark.parametrize("sentence", [AHEAD, "turn left 90 degrees"])
def test_25_steps_without_getting_ahead_are_stuck(sentence, make_robot):
    robot = make_robot(free_metres=0.6)

    ended, journal = follow(TalkingPolicy(sentence), robot)

    assert ended == "stuck"
    assert len(robot.calls) == (3 + 25 if sentence == AHEAD else 25)
    assert journal.notes[-1]["kind"] == "stuck"


def test_a_robot_without_primitive_motions_is_refused():
    with pytest.raises(CommandError, match="primitive motions and a camera"):
        NavidAgent(TalkingPolicy("stop")).follow(
            TEXT,
            object(),  # type: ignore[arg-type]
            Journal(),
            np.random.default_rng(0),
        )


def test_the_name_says_protocol_model_and_rules():
    def name(**options) -> str:
        agent: Agent = NavidAgent(TalkingPolicy("stop"), NavidOptions(**options))
        return agent.name

    assert name() == "NaVid protocol with talker+fair"
    assert name(budget="released", faithful=True) == (
        "NaVid protocol with talker+released+faithful"
    )
    assert name(budget="released", max_steps=500).endswith("+released+max_steps=500")


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("max_steps", 0),
        ("failures", 0),
        ("history", -1),
        ("history_width", 641),
        ("temperature", -0.1),
    ],
)
def test_options_without_meaning_are_refused(option, value):
    with pytest.raises(SettingsError, match=f"--set {option}: expected"):
        NavidOptions(**{option: value})
