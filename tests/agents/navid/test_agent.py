"""The loop: pictures out, answers in, primitives done, budgets kept."""

import io

import numpy as np
import pytest
from PIL import Image

from memorymaze.agents.agent import Agent, FairLimits, Journal
from memorymaze.agents.navid import NavidAgent, NavidOptions
from memorymaze.agents.notes import OutOfStepsNote
from memorymaze.basics.errors import (
    CommandError,
    EpisodeOver,
    LanguageModelError,
    SettingsError,
)
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    Picture,
    Usage,
)

TEXT = "Down the hall, then left."
UNUSED = "Your last answer could not be used"
AHEAD = "The next action is move forward 75 cm."


class TalkingModel:
    """Says its sentences in turn, the last one again and again; keeps the questions."""

    name = "talker"

    def __init__(self, *sentences: str) -> None:
        self.sentences = sentences
        self.requests: list[CompletionRequest] = []

    def complete(self, request: CompletionRequest) -> Completion:
        said = self.sentences[min(len(self.requests), len(self.sentences) - 1)]
        self.requests.append(request)
        return Completion(said, self.name, Usage(10, 2), 0.5)

    @property
    def asked(self) -> list[str]:
        """The texts of the questions."""
        return [request.messages[1].content for request in self.requests]

    @property
    def video(self) -> tuple[Picture, ...]:
        """The pictures of the last question."""
        return self.requests[-1].messages[1].pictures


def captions(asked: str) -> list[str]:
    """What a question says of its pictures; the last one is the current one."""
    lines = (line for line in asked.splitlines() if line.startswith("Picture"))
    return [line.partition(": ")[2] for line in lines]


def follow(
    model: TalkingModel, robot: object, *, fair_steps: int | None = None, **options
) -> tuple[str, Journal]:
    """Follow, shown nothing unless options say so; return what ended it, and the journal."""
    agent = NavidAgent(NavidOptions(**{"pictures": "none", **options}), model)
    limits = None if fair_steps is None else FairLimits(0, {30: fair_steps})
    journal = Journal(limits=limits)
    with pytest.raises(EpisodeOver) as over:
        agent.follow(TEXT, robot, journal, np.random.default_rng(0))
    return over.value.stopped_by, journal


def test_what_is_answered_is_done_by_primitives(robot):
    model = TalkingModel(AHEAD, "turn left 60 degrees", "turn right 30 degrees", "stop")

    assert follow(model, robot)[0] == "agent"

    assert robot.calls == [
        *[("forward", 0.25)] * 3,
        *[("rotate", 30)] * 2,
        ("rotate", -30),
    ]
    assert robot.stopped
    assert TEXT in model.asked[0]


def test_every_primitive_gives_one_picture_of_the_video(robot):
    model = TalkingModel(AHEAD, "turn left 60 degrees", "stop")

    follow(model, robot, pictures="shown", history=100)

    assert [captions(asked)[-1] for asked in model.asked] == [
        "at the start",
        "step 3, after 25 cm forward",
        "step 5, after turning left by 30 degrees",
    ]
    assert captions(model.asked[-1]) == [
        "at the start",
        "step 1, after 25 cm forward",
        "step 2, after 25 cm forward",
        "step 3, after 25 cm forward",
        "step 4, after turning left by 30 degrees",
        "step 5, after turning left by 30 degrees",
    ]
    # The picture after n motions is the one taken then: its grey tells.
    pictures = [Image.open(io.BytesIO(picture.data)) for picture in model.video]
    assert [round(float(np.asarray(each).mean())) for each in pictures] == [*range(6)]


def test_pictures_have_names_by_what_was_done_in_which_episode(make_robot):
    def names(*sentences: str, seed: int = 0) -> list[str]:
        model = TalkingModel(*sentences, "stop")
        with pytest.raises(EpisodeOver):
            NavidAgent(NavidOptions(), model).follow(
                TEXT, make_robot(), Journal(), np.random.default_rng(seed)
            )
        return [str(picture.name).partition("-")[0] for picture in model.video]

    ahead = names(AHEAD)
    assert names(AHEAD) == ahead
    assert len(set(ahead)) == len(ahead) == 4
    assert names("forward 25 cm", "left 30 degrees")[:2] == ahead[:2]
    assert names("left 30 degrees")[1] != ahead[1]
    assert not set(names(AHEAD, seed=1)) & set(ahead)


def test_each_answer_is_counted_and_noted(robot):
    _, journal = follow(TalkingModel(AHEAD, "stop"), robot)

    assert (journal.model_calls, journal.tokens, journal.inference_s) == (2, 24, 1.0)
    assert [note.about for note in journal.notes] == [
        "model_reply",
        "decision",
        "model_reply",
        "decision",
    ]
    assert journal.notes[1].details["motions"] == (("forward", 3),)
    assert journal.notes[1].details["step"] == 0
    assert journal.notes[1].details["picture"] != journal.notes[3].details["picture"]


def test_an_unreadable_answer_is_asked_for_once_more_and_then_nothing_is_done(robot):
    model = TalkingModel("Hm.", "Er.", "Hm.", AHEAD, "stop")

    assert follow(model, robot, pictures="shown")[0] == "agent"

    assert robot.calls == [("forward", 0.25)] * 3
    first, again = model.asked[:2]
    assert UNUSED not in first
    assert len(model.requests[1].messages[1].pictures) == 1
    assert f"{UNUSED}: the reply has no command" in again
    assert [captions(asked)[-1] for asked in model.asked] == [
        *["at the start"] * 2,
        *["step 1, nothing was done, because the answer could not be used"] * 2,
        "step 4, after 25 cm forward",
    ]


def test_five_unreadable_decisions_in_a_row_are_a_model_error(robot):
    model = TalkingModel("Hm.", "Hm.", AHEAD, "Hm.")

    with pytest.raises(LanguageModelError, match="talker: 5 decisions in a row"):
        NavidAgent(NavidOptions(), model).follow(
            TEXT, robot, Journal(), np.random.default_rng(0)
        )

    assert robot.calls == [("forward", 0.25)] * 3
    # Each decision is a new question, so that recorded replies tell them apart.
    assert len(set(model.asked)) == len(model.requests) == 2 + 1 + 10
    assert not robot.stopped


def test_faithful_draws_a_seeded_motion_for_an_unreadable_answer(make_robot):
    def drawn(seed: int) -> list[object]:
        robot = make_robot()
        model = TalkingModel(*["turn left 13 degrees."] * 30, "stop.")
        options = NavidOptions(faithful=True, still_steps=30, pictures="none")
        agent = NavidAgent(options, model)
        with pytest.raises(EpisodeOver):
            agent.follow(TEXT, robot, Journal(), np.random.default_rng(seed))
        assert len(model.asked) == 31
        assert not any(UNUSED in asked for asked in model.asked)
        return robot.calls

    assert drawn(0) == drawn(0) != drawn(1)
    assert set(drawn(0)) == {("forward", 0.25), ("rotate", 30), ("rotate", -30)}


def test_faithful_misses_a_stop_without_its_full_stop(robot):
    model = TalkingModel("stop", "stop.")

    follow(model, robot, faithful=True)

    assert len(robot.calls) == 1


def test_the_released_budget_ends_after_400_steps_and_that_is_no_stop(robot):
    ended, journal = follow(TalkingModel(AHEAD), robot, budget="released")

    assert ended == "budget"
    assert len(robot.calls) == 400
    assert not robot.stopped
    assert journal.notes[-1] == OutOfStepsNote(400, 400)


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
    assert follow(TalkingModel(AHEAD), robot, **options)[0] == "budget"
    assert len(robot.calls) == steps


def test_a_stop_after_the_last_step_still_counts(robot):
    assert follow(TalkingModel(AHEAD, "stop"), robot, max_steps=3)[0] == "agent"


@pytest.mark.parametrize("sentence", [AHEAD, "turn left 90 degrees"])
def test_25_steps_without_getting_ahead_are_stuck(sentence, make_robot):
    robot = make_robot(free_metres=0.6)

    ended, journal = follow(TalkingModel(sentence), robot)

    assert ended == "stuck"
    assert len(robot.calls) == (3 + 25 if sentence == AHEAD else 25)
    assert journal.notes[-1].about == "stuck"


def test_a_robot_without_primitive_motions_is_refused():
    with pytest.raises(CommandError, match="primitive motions and a camera"):
        NavidAgent(NavidOptions(), TalkingModel("stop")).follow(
            TEXT,
            object(),  # type: ignore[arg-type]
            Journal(),
            np.random.default_rng(0),
        )


def test_the_name_says_protocol_model_and_rules():
    def name(**options) -> str:
        agent: Agent = NavidAgent(NavidOptions(**options), TalkingModel("stop"))
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


def test_a_model_that_sees_nothing_is_refused_unless_it_is_shown_nothing() -> None:
    class BlindModel(TalkingModel):
        takes_pictures = False

    with pytest.raises(
        SettingsError, match=r"see no pictures; .* --set pictures=none$"
    ):
        NavidAgent(NavidOptions(), BlindModel("stop"))
    NavidAgent(NavidOptions(pictures="none"), BlindModel("stop"))
