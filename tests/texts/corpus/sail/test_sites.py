import math
from pathlib import Path

import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.testing import check_site
from memorymaze.texts.corpus.sail import (
    EDGE,
    load_sail,
    maze_site,
    paragraph_of,
    sail_episodes,
)
from memorymaze.world.sites import Site, load_site


@pytest.fixture
def site(small_folder: Path) -> Site:
    return maze_site(load_sail(small_folder).mazes["Small"])


def _labels(site: Site, pose: Pose, query: str, *, sees: float = 40.0) -> list[str]:
    settings = SimulationSettings(detection_range=sees)
    robot = SimulatedRobot(build_scene(site), pose, settings)
    return [found.label for found in robot.detect_from_RGB_image(query)]


def test_the_plan_of_a_maze_keeps_the_format(
    small_folder: Path, tmp_path: Path
) -> None:
    site = maze_site(load_sail(small_folder).mazes["Small"])
    path = tmp_path / "sail_small.geojson"
    site.save(path)
    assert load_site(path) == site
    check_site(path)


def test_rows_that_grow_south_become_northing(site: Site) -> None:
    route = site.find_route("1-2")
    corners = [tuple(point) for point in route.line.coords]
    assert corners == [(0, 2 * EDGE), (EDGE, 2 * EDGE), (EDGE, EDGE), (EDGE, 0)]
    assert [turn.direction for turn in route.turns] == ["right"]


def test_the_floor_of_a_hall_is_seen_and_told_from_others(site: Site) -> None:
    east = Pose(0.0, 2 * EDGE, 0.0)
    assert _labels(site, east, "brick floor") == ["brick floor", "brick floor"]
    assert _labels(site, east, "red floor") == ["brick floor", "brick floor"]
    assert _labels(site, east, "blue floor") == []
    south = Pose(EDGE, 2 * EDGE, -math.pi / 2)
    assert set(_labels(site, south, "grass floor")) == {"grass carpet floor"}


def test_pictures_and_furniture_are_seen(site: Site) -> None:
    east = Pose(0.0, 2 * EDGE, 0.0)
    assert "picture of a fish" in _labels(site, east, "fish")
    assert _labels(site, east, "sofa") == ["sofa"]
    assert _labels(site, east, "easel") == []


def test_how_far_one_sees_is_a_setting(site: Site) -> None:
    east = Pose(0.0, 2 * EDGE, 0.0)
    assert _labels(site, east, "sofa", sees=4.0) == []


def test_a_paragraph_is_followed_from_four_headings(
    small_folder: Path, site: Site
) -> None:
    paragraphs = load_sail(small_folder).paragraphs
    episodes = sail_episodes(paragraphs, {site.name: site})
    first = episodes[:4]
    assert len(episodes) == 8
    assert len({round(each.start.heading, 6) for each in first}) == 4
    assert {paragraph_of(each.id) for each in first} == {"ANN-Small-1-2-1"}
    assert {each.goal for each in first} == {(EDGE, 0.0)}
    assert first[0].instruction.study == "sail"
    assert first[0].instruction.followers is not None
    assert first[0].instruction.followers.arrived == 3
