import math
from collections.abc import Callable

import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.language.models.answers import RecordingModel, ReplayingModel
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.robot.api.asking import way_to
from memorymaze.robot.simulation.obstacles.crowd import Person
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.runs.episodes.trace_entries import answer_entry, line_of
from memorymaze.texts.passers_by import (
    Encounters,
    FloorKnowledge,
    Memory,
    ModelInRole,
    load_bank,
)
from memorymaze.texts.passers_by.bank_records import (
    REPLY_CASES,
    Reply,
    TurnFact,
    WayFacts,
)
from memorymaze.texts.passers_by.players import reply_in_words, steps_in_words
from memorymaze.world.sites import Site

Meet = Callable[..., tuple[SimulatedRobot, Encounters, Person]]

STEM = Pose(0, -6, math.pi / 2)
"""Before the T junction, facing it."""


@pytest.fixture
def floor(knowing: Callable[[Site], FloorKnowledge], t_site: Site) -> FloorKnowledge:
    return knowing(t_site)


def remembering(floor: FloorKnowledge, kind: str = "memory", seed: int = 0) -> Memory:
    """Return somebody who remembers the way to the library, or all wrongly."""
    people = (
        Memory((number,), floor, load_bank(), 0.0, 3.0, kind)  # type: ignore[arg-type]
        for number in range(seed, 100)
    )
    wanted = {"memory": "right"}.get(kind, kind)
    return next(
        each
        for each in people
        if each.answer(way_to("the library"), STEM).truth == wanted
    )


@pytest.mark.parametrize("kind", ["memory", "wrong"])
def test_a_model_says_what_the_person_remembers_right_or_wrong(
    floor: FloorKnowledge, met: Meet, kind: str
) -> None:
    memory = remembering(floor, kind)
    model = ScriptedLanguageModel(["Second left, dear.\n"])
    _, people, _ = met(meet=lambda _, number: ModelInRole(memory, model, number))
    assert people.ask(way_to("the library")) == "Second left, dear."
    [request] = model.requests
    told = request.messages[-1].content
    recalled = memory.recall(way_to("the library"), STEM)
    assert isinstance(recalled.facts, WayFacts)
    assert all(line in told for line in steps_in_words(recalled.facts))
    assert f"Who you are: {memory.voice}" in told
    assert str(way_to("the library")) in told
    [answered] = people.asked
    assert answered.truth == {"memory": "right"}.get(kind, kind)
    assert answered.error == recalled.error
    entry = line_of(answer_entry(answered))
    assert entry["model"] == "scripted"
    assert entry["tokens"] > 100


def test_who_does_not_know_is_played_as_one_who_does_not(floor: FloorKnowledge) -> None:
    model = ScriptedLanguageModel(["No idea, sorry."])
    memory = remembering(floor, "memory")
    told = ModelInRole(memory, model, 1).answer(way_to("the aquarium"), STEM)
    assert told.truth == "unknown"
    assert "you do not know" in model.requests[0].messages[-1].content


def test_a_models_words_are_replayed_from_a_store(
    floor: FloorKnowledge, tmp_path: pytest.TempPathFactory
) -> None:
    store = f"{tmp_path}/replies.jsonl"
    memory = remembering(floor)
    asked = way_to("the library")
    recording = RecordingModel(ScriptedLanguageModel(["Just there."]), store)
    first = ModelInRole(memory, recording, 1).answer(asked, STEM)
    again = ModelInRole(memory, ReplayingModel(store), 1).answer(asked, STEM)
    assert again == first


def test_what_a_trace_tells_of_others_names_no_model(met: Meet) -> None:
    _, people, _ = met()
    people.ask(way_to("the library"))
    assert {"model", "tokens", "cost_usd"}.isdisjoint(
        line_of(answer_entry(people.asked[0]))
    )


@pytest.mark.parametrize(("kind", "case"), REPLY_CASES)
def test_every_reply_can_be_told_in_plain_words(kind: str, case: str) -> None:
    filled = {"metres": "8", "where": "left", "near": "the sofa"}
    slots = {slot: filled.get(slot, "the lift") for slot in REPLY_CASES[kind, case]}
    told = reply_in_words(Reply(case, slots))
    assert "the lift" in told
    assert ("8 m" in told) == ("metres" in slots)
    assert ("near the sofa" in told) == ("near" in slots)


def test_every_way_can_be_told_in_plain_words() -> None:
    turns = (
        TurnFact("left", "next", 1, "", 4.0),
        TurnFact("half right", "ordinal", 3, "", 12.4),
        TurnFact("right", "end", 1, "", 7.0),
        TurnFact("left", "thing", 1, "the vending machine", 2.0),
        TurnFact("right", "crossing", 1, "", 9.0),
    )
    way = WayFacts("back", turns, "right", "the lift", 5.0)
    assert steps_in_words(way) == (
        "turn round and go back, away from where the robot faces",
        "after 4 m turn left at the next way on that side",
        "after 12 m turn half right at the third way on that side",
        "after 7 m turn right where the way ahead ends",
        "after 2 m turn left at the vending machine",
        "after 9 m turn right at the crossing",
        "after 5 m the lift is on the right",
    )
