"""Walks that a language model decides, in simulated buildings."""

import json
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from memorymaze.agents.agent import Journal
from memorymaze.agents.closed_loop import ClosedLoopAgent, ClosedLoopOptions
from memorymaze.agents.closed_loop.decided_walk import DecidedWalk
from memorymaze.agents.closed_loop.questions import DecisionQuestions
from memorymaze.agents.closed_loop.walk_log import WalkLog
from memorymaze.agents.notes import RepairNote
from memorymaze.agents.plan_readers import read_plan_reply
from memorymaze.agents.walking.walker import Walker
from memorymaze.basics.errors import LanguageModelError, SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.language.models.answers import (
    AboutInstruction,
    RecordingModel,
    ReplayingModel,
)
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.language.plans import RoutePlan
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.navigation import navigate
from memorymaze.runs.episodes.sampling import sample
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.runs.episodes.trace_entries import NoteEntry
from memorymaze.texts.corpus import load_corpus
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.turning_point_graph import TurningPointGraph
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Route, Site

REPLIES = Path(__file__).with_name("wrong_side.jsonl")
RECORDED = Path(__file__).parents[3] / "examples/recorded/plans.jsonl"
STARTS = {
    "corridor": (2.0, 0.0, 0.0),
    "l_shape": (1.0, 0.0, 0.0),
    "t_junction": (0.0, -7.0, 90.0),
    "loop": (1.0, 4.0, 90.0),
}


def say(action: str, **fields: Any) -> str:
    """An answer."""
    return json.dumps({
        "note": "On.",
        "turns_done": 0,
        "doubt": 0.1,
        "confidence": 0.9,
        "action": action,
        **fields,
    })


class Walk(NamedTuple):
    """How a walk went."""

    end: tuple[float, float]
    asked: list[str]
    journal: Journal

    def notes(self, kind: str) -> list[dict[str, Any]]:
        return [dict(each.details) for each in self.journal.notes if each.about == kind]

    def ends_near(self, x: float, y: float, metres: float = 1.5) -> bool:
        return math.dist(self.end, (x, y)) <= metres


@pytest.fixture
def walk(scenes: dict[str, Scene]) -> Callable[..., Walk]:
    """Let replies decide a walk from a start in a tiny site."""

    def take(site: str, *replies: str, **options: Any) -> Walk:
        x, y, degrees = STARTS[site]
        robot = SimulatedRobot(
            scenes[site],
            Pose(x, y, math.radians(degrees)),
            SimulationSettings(),
            np.random.default_rng(0),
        )
        model, journal = ScriptedLanguageModel(replies), Journal()
        walker = Walker(robot, reads_signs=True)
        questions = DecisionQuestions(
            "To the clock.", model, journal, WalkLog(walker.map), **options
        )
        DecidedWalk(walker, questions).run()
        asked = [each.messages[-1].content for each in model.requests]
        return Walk((robot.pose.x, robot.pose.y), asked, journal)

    return take


def test_the_model_is_told_what_the_robot_met_and_nothing_else(
    walk: Callable[..., Walk],
) -> None:
    taken = walk(
        "t_junction",
        say("walk", way="A", look_for=["black clock"]),
        say("walk", way="A"),
        say("give_up", confidence=0.2),
    )
    first, second, third = taken.asked
    assert "Place 0 (the start): A ahead, not tried; B back, not tried.\n" in first
    assert 'ahead "Library left, lift right"' in second
    assert "Place 1 (turning point): A left, not tried; B right, not tried;" in second
    assert (
        "The robot is at place 1 after 7 m. It looks for: door, black clock" in second
    )
    assert "12 m: ahead clock [black clock] 5 m, door 12 m" in third
    assert (
        "2. At place 1, 0 turns done, doubt 0.1: On. -> way A left. Came to " in third
    )
    assert taken.notes("gave_up") == [{"reason": "On.", "confidence": 0.2}]


def test_decisions_doubts_and_repairs_are_noted(walk: Callable[..., Walk]) -> None:
    taken = walk(
        "t_junction",
        say("walk", way="A"),
        say("walk", way="B", turns_done=1, confidence=0.6),
        say("walk", place=1, way="A", turns_done=0, doubt=0.8, note="Other side."),
        say("stop"),
    )
    assert taken.ends_near(-10, 0)
    assert [(each["at"], each["exit"]) for each in taken.notes("decision")] == [
        (0, 0),
        (1, 1),
        (1, 0),
    ]
    [repair] = taken.notes("repair")
    assert (repair["leg"], repair["at"], repair["reason"]) == (1, 1, "Other side.")
    assert [each["score"] for each in taken.notes("doubt")] == [0.1, 0.8, 0.1]
    assert taken.journal.confidence == 0.9


@pytest.mark.parametrize(
    ("fields", "x"),
    [
        ({"metres": 5}, 7.0),
        ({"until": "bench"}, 10.0),
        ({"until": "bench", "metres": 5}, 7.0),
        ({"until": "piano"}, 19.3),
    ],
)
def test_the_robot_halts_on_the_way_where_it_is_told_to(
    walk: Callable[..., Walk], fields: Mapping[str, Any], x: float
) -> None:
    taken = walk("corridor", say("walk", way="A", **fields), say("stop"))
    assert taken.ends_near(x, 0, 1.0)
    missed = fields.get("until") == "piano"
    assert ("no piano was seen" in taken.asked[1]) == missed
    assert ("(halt on the way)" in taken.asked[1]) == (not missed)


def test_from_a_halt_the_robot_goes_on_and_back(walk: Callable[..., Walk]) -> None:
    halt = say("walk", way="A", metres=4)
    assert walk("corridor", halt, halt, say("stop")).ends_near(10, 0)
    back = say("go_back", place=0)
    taken = walk("corridor", halt, halt, back, say("stop"))
    assert taken.ends_near(2, 0)
    assert "-> back to place 0. Came to place 0 after 8 m." in taken.asked[-1]


def test_doors_beside_a_halt_are_seen(walk: Callable[..., Walk]) -> None:
    halt = say("walk", way="A", metres=5.5)
    taken = walk("corridor", halt, say("stop", at="door"))
    assert taken.ends_near(7.5, 0.7, 1.0)


def test_who_stops_at_what_is_not_there_is_asked_again(
    walk: Callable[..., Walk],
) -> None:
    taken = walk("l_shape", say("stop", at="piano"), say("give_up"))
    assert "Not stopped: no piano is to be seen from here." in taken.asked[1]
    assert taken.ends_near(1, 0)


def test_ways_and_places_that_are_not_there_are_asked_for_once_more(
    walk: Callable[..., Walk],
) -> None:
    taken = walk("l_shape", say("walk", way="F"), say("walk", way="A"), say("stop"))
    assert "expected one of A, B, which lead out of place 0; got F" in taken.asked[1]
    assert taken.ends_near(11, 0)
    with pytest.raises(LanguageModelError, match="expected one of 0; got 7"):
        walk("l_shape", *[say("go_back", place=7)] * 2)


def test_the_walk_ends_without_a_claim_when_no_request_is_left(
    walk: Callable[..., Walk],
) -> None:
    taken = walk("loop", *[say("walk", way="A")] * 5, most_requests=3)
    assert len(taken.asked) == 3
    assert taken.journal.gave_up
    assert taken.journal.confidence == 0.0


def test_a_recorded_walk_is_replayed_without_a_model(
    t_site: Site, tmp_path: Path
) -> None:
    store, route = tmp_path / "replies.jsonl", t_site.routes[0]
    replies = [say("walk", way="A"), say("walk", way="A"), say("stop")]
    model = RecordingModel(ScriptedLanguageModel(replies, name="m"), store)
    asked = AboutInstruction(model, f"t_junction-{route.id}")
    first = navigate(t_site, route, "Left.", ClosedLoopAgent(None, asked))
    again = navigate(
        t_site,
        route,
        "Left.",
        AgentSettings(
            "closed_loop",
            language_model=ModelSettings(replay=str(store)),
        ),
    )
    assert first.result.success
    assert again.result.agent == first.result.agent == "closed_loop[m]"
    assert again.trajectory == first.trajectory
    assert again.result.model_calls == 3


def test_less_than_one_request_is_refused() -> None:
    with pytest.raises(SettingsError, match="most_requests: expected a whole number"):
        ClosedLoopOptions(most_requests=0)


def test_a_text_that_says_left_for_right_is_noticed_and_repaired(
    builtin_sites: dict[str, Site],
) -> None:
    # What a large language model said to this text, at its eleven turning points; one
    # reply was replaced by hand, so it proves the loop and measures nothing.
    name = "ons-museum_7f-r2-21-1"
    texts = (each.instruction for each in load_corpus().episodes)
    told = next(each for each in texts if each.id == name)
    model = AboutInstruction(ReplayingModel(REPLIES), name)
    site = builtin_sites[told.site]
    agent = ClosedLoopAgent(None, model)
    run = navigate(site, site.find_route(told.reference_route), told.text, agent)
    assert [failure.kind for failure in told.failures] == ["wrong_direction_at_turn"]
    assert run.result.success
    notes = [entry.note for entry in run.trace if isinstance(entry, NoteEntry)]
    [repair] = [each for each in notes if isinstance(each, RepairNote)]
    assert (repair.leg, repair.at) == (1, 1)
    assert run.result.confidence == 0.8


StandIn = Callable[[RoutePlan], ScriptedLanguageModel]


def arrives(site: Site, route: Route, plan: RoutePlan, stand_in: StandIn) -> bool:
    """Tell whether the stand-in arrives, which knows the plan and the log."""
    agent = ClosedLoopAgent(None, stand_in(plan))
    run = navigate(site, route, "As the plan says.", agent)
    return run.result.success and run.result.claims_arrival


@pytest.mark.proof
@pytest.mark.parametrize("name", BUILTIN_SITE_NAMES)
def test_the_log_suffices_to_follow_each_route_of_the_benchmark(
    builtin_sites: dict[str, Site], believes: StandIn, name: str
) -> None:
    graph = TurningPointGraph(builtin_sites[name])
    routes = [each for each in graph.site.routes if each.role == "reference"]
    plans = [RouteFacts(graph, route).plan.said for route in routes]
    assert len(routes) == 2
    for route, plan in zip(routes, plans, strict=True):
        assert arrives(graph.site, route, plan, believes), route.id


@pytest.mark.proof
def test_the_log_tells_the_belief_most_of_what_the_map_does(believes: StandIn) -> None:
    corpus = load_corpus()
    plans = {
        record["instruction_id"]: read_plan_reply(record["reply"])
        for record in map(json.loads, RECORDED.read_text("utf-8").splitlines())
    }
    right = [each for each in corpus.episodes if not each.instruction.failures]
    arrived = 0
    for told in (each.instruction for each in sample(right, 48)):
        site = corpus.sites[told.site]
        route = site.find_route(told.reference_route)
        arrived += arrives(site, route, plans[told.id], believes)
    # 43 where it sees the map itself.
    assert arrived >= 36
