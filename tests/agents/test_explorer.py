"""Walks of the explorer through the tiny sites, with the simulated robot."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from memorymaze.agents.agent import Journal
from memorymaze.agents.explorer import (
    ExplorerAgent,
    ExplorerOptions,
    _destination_names,
)
from memorymaze.agents.notes import GaveUpNote
from memorymaze.basics.errors import EpisodeOver, SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.language.plans import Arrival
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.world.sites import Site, load_site

NEAR = 3.0
"""Metres from a place that count as there."""


class Search(NamedTuple):
    """How a search went."""

    points: tuple[tuple[float, float], ...]
    stopped_by: str
    notes: list[dict[str, Any]]

    @property
    def end(self) -> tuple[float, float]:
        return self.points[-1]

    def came_by(self, x: float, y: float) -> bool:
        return any(math.dist(point, (x, y)) <= NEAR for point in self.points)


def search(
    site: Site, text: str, start: Pose, seed: int = 0, least_score: float = 0.65
) -> Search:
    """Search as a text asks for, from a place, with lots drawn by a seed."""
    robot = SimulatedRobot(build_scene(site), start, rng=np.random.default_rng(0))
    journal = Journal()
    agent = ExplorerAgent(ExplorerOptions(least_score=least_score))
    with pytest.raises(EpisodeOver) as over:
        agent.follow(text, robot, journal, np.random.default_rng(seed))
    points = tuple((at[0], at[1]) for at in robot.trajectory().points)
    return Search(points, over.value.stopped_by, journal.notes)


IN_THE_LOOP = Pose(1.0, 4.0, math.pi / 2)


@pytest.mark.parametrize("heading", [math.pi / 2, -math.pi / 2])
def test_a_destination_is_found_in_a_loop_from_either_side(
    loop_site: Site, heading: float
) -> None:
    found = search(loop_site, "To the drinking fountain.", Pose(1.0, 4.0, heading))
    assert math.dist(found.end, (7, 13)) <= NEAR
    assert found.stopped_by == "agent"
    assert (
        found.notes[-1].details["reason"]
        == "drinking fountain seen as drinking fountain"
    )


def test_it_does_not_stop_at_another_name(loop_site: Site) -> None:
    start = Pose(1.0, 4.0, -math.pi / 2)
    found = search(loop_site, "Walk to the drinking fountain.", start)
    assert found.came_by(7, 1)  # the yellow box
    assert math.dist(found.end, (7, 13)) <= NEAR


def test_it_gives_up_when_every_way_is_tried(loop_site: Site) -> None:
    lost = search(loop_site, "Walk to the white statue.", IN_THE_LOOP)
    assert all(lost.came_by(*corner) for corner in [(1, 1), (13, 1), (1, 13), (13, 13)])
    assert lost.stopped_by == "agent"
    assert lost.notes[-1] == GaveUpNote("every way is tried")


def test_dead_ends_are_left_for_the_nearest_way_not_tried(crossing_site: Site) -> None:
    start = Pose(-10.0, 0.0, 0.0)
    lost = search(crossing_site, "Walk to the drinking fountain.", start)
    assert all(lost.came_by(*end) for end in [(11, 0), (0, 11), (0, -11), (-11, 0)])
    assert [note.about for note in lost.notes].count("decision") == 5


def test_the_way_told_is_ignored(crossing_site: Site) -> None:
    start = Pose(-10.0, 0.0, 0.0)
    left, right = (
        search(crossing_site, f"Turn {way} at the crossing. The piano is there.", start, 1)
        for way in ("left", "right")
    )  # fmt: skip
    assert left == right


def test_which_way_is_tried_first_is_drawn_by_lot(crossing_site: Site) -> None:
    start = Pose(-10.0, 0.0, 0.0)
    walks = [search(crossing_site, "To the piano.", start, seed) for seed in range(4)]
    firsts = {walk.notes[2].details["exit"] for walk in walks}
    assert len(firsts) > 1


def test_a_text_without_a_destination_leads_nowhere(loop_site: Site) -> None:
    lost = search(loop_site, "Turn right, and then left.", IN_THE_LOOP)
    assert len(set(lost.points)) == 1
    assert lost.notes[-1].details["reason"] == "the text names no destination"


@pytest.mark.parametrize(
    ("words", "least_score", "arrived"),
    [
        pytest.param("LIBRARY", 0.65, True, id="names the place"),
        pytest.param("LIBRARY \u2192", 0.65, False, id="points elsewhere"),
        pytest.param("LIBRARY", 0.7, False, id="fits too badly"),
    ],
)
def test_a_sign_is_arrived_at_where_it_names_the_place(
    changed: Callable[..., Path], words: str, least_score: float, arrived: bool
) -> None:
    sign = {
        "properties.category": "signboard",
        "properties.text": words,
        "properties.heading_deg": 180,
        "properties.size_m": [1.2, 0.1, 1.5],
    }
    site = load_site(changed("corridor", "bench", sign))
    start = Pose(2.0, 0.0, 0.0)
    found = search(site, "Go on to the library.", start, least_score=least_score)
    assert (math.dist(found.end, (10, 0)) <= NEAR) == arrived
    assert found.notes[-1].about == ("arrival" if arrived else "gave_up")


def test_a_score_beyond_one_is_refused() -> None:
    with pytest.raises(
        SettingsError, match=r"least_score: expected a number from 0 to 1, got 1\.5"
    ):
        ExplorerOptions(least_score=1.5)


@pytest.mark.parametrize(
    ("told", "names"),
    [
        (("library", "sign that says Library"), ("library",)),
        (("glass door", "sign that says 2347"), ("2347",)),
        (("door", "blue floor"), ("door",)),
        ((), ()),
    ],
)
def test_names_are_those_that_tell_the_destination_from_other_places(
    told: tuple[str, ...], names: tuple[str, ...]
) -> None:
    assert _destination_names(Arrival(told)) == names
