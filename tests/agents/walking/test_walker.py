"""What a walker makes of halts between crossings, and of what is written on the way."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from memorymaze.agents.walking.floor_map import Sighting
from memorymaze.agents.walking.walker import Walker
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.world.sites import load_site


def robot_in(scene: Scene, x: float, y: float, degrees: float) -> SimulatedRobot:
    return SimulatedRobot(
        scene,
        Pose(x, y, math.radians(degrees)),
        SimulationSettings(),
        np.random.default_rng(0),
    )


def test_a_halt_is_a_place_from_which_ways_lead_on_and_back(
    scenes: dict[str, Scene],
) -> None:
    robot = robot_in(scenes["t_junction"], 0, -7, 90)
    walker = Walker(robot)

    def far_enough(seen: list[Sighting]) -> bool:
        return walker.travelled >= 3

    assert walker.follow_exit(0, ["door"], far_enough) is None
    walker.halt()
    spot = walker.at
    assert walker.map.stretches[0, 0].end == spot
    onwards = walker.follow_exit(0, [])
    assert onwards is not None
    assert walker.at == onwards.end == 1
    assert walker.go_to(spot)
    assert (robot.pose.x, robot.pose.y) == pytest.approx((0, -4), abs=1.0)
    assert walker.go_to(0)
    assert (robot.pose.x, robot.pose.y) == pytest.approx((0, -7), abs=1.0)


def test_after_a_look_along_a_slanted_way_it_goes_back_the_way_it_came(
    scenes: dict[str, Scene],
) -> None:
    robot = robot_in(scenes["slanted_crossing"], -7, 0, 0)
    walker = Walker(robot)
    walker.follow_exit(0, [])
    crossing = walker.map.crossings[walker.at]
    slanted = crossing.find_exit(math.radians(50))
    assert slanted is not None
    assert walker.face(slanted)
    assert walker.go_to(0)
    assert (robot.pose.x, robot.pose.y) == pytest.approx((-7, 0), abs=1.0)


def test_what_is_written_on_the_way_goes_on_the_map_where_it_is_asked_for(
    scenes: dict[str, Scene],
) -> None:
    reads, reads_not = (
        Walker(robot_in(scenes["t_junction"], 0, -7, 90), reads_signs=each)
        for each in (True, False)
    )
    for walker in (reads, reads_not):
        walker.follow_exit(0, ["door"])
    [sign] = reads.map.texts
    assert sign.label == "Library left, lift right"
    assert sign.place == pytest.approx((8, 0), abs=1.0)
    assert (sign.stretch, sign.side) == ((0, 0), "ahead")
    assert reads_not.map.texts == []


def test_who_reads_no_signs_still_sees_where_one_points_and_keeps_nothing_of_it(
    changed: Callable[..., Path],
) -> None:
    words = {"properties.text": "Library \u2192"}
    scene = build_scene(load_site(changed("t_junction", "sign", words)))
    walker = Walker(robot_in(scene, 0, -2.5, 90))
    [sign] = walker.look(["sign"])
    assert walker.points_on(sign)
    assert walker.map.texts == []


def test_letters_are_read_from_farther_away_than_things_are_seen(
    changed: Callable[..., Path],
) -> None:
    words = {
        "properties.category": "signboard",
        "properties.text": "LIBRARY",
        "properties.heading_deg": 180,
        "properties.size_m": [1.2, 0.1, 1.5],
    }
    scene = build_scene(load_site(changed("corridor", "bench", words)))
    walker = Walker(robot_in(scene, 5, 0, 0), reads_signs=True)
    wanted = "sign that says Library"
    [written] = walker.look([wanted, "sign that says Café"])
    assert (written.phrase, written.is_written) == (wanted, True)
    assert written.place == pytest.approx((5, -1.2), abs=0.5)
    walker.walk_on(2)
    [seen] = walker.look([wanted])
    assert not seen.is_written
    assert walker.map.seen(wanted) == [seen]


def test_things_at_a_wall_are_seen_after_turning_to_it(
    scenes: dict[str, Scene],
) -> None:
    walker = Walker(robot_in(scenes["corridor"], 3, 0, 0))
    assert walker.look(["door"]) == []
    walker.turn_by(90)
    [door] = walker.look(["door"])
    assert door.place == pytest.approx((0, 1.5), abs=0.5)
    assert walker.heading == pytest.approx(math.pi / 2, abs=0.05)


def test_a_glance_finds_what_stands_beside_the_way_and_faces_on(
    scenes: dict[str, Scene],
) -> None:
    walker = Walker(robot_in(scenes["corridor"], 3, 0, 0))
    assert walker.glance(["door"], "right") == []
    [door] = walker.glance(["door"], "left")
    assert door.place == pytest.approx((0, 1.5), abs=0.5)
    assert walker.heading == pytest.approx(0, abs=0.05)


@pytest.mark.parametrize(
    ("place", "leads_there"),
    [((7.3, 4.0), True), ((9.5, 1.5), False)],
    ids=["down the way", "beside the crossing"],
)
def test_it_turns_in_only_where_the_way_leads_to_the_thing(
    scenes: dict[str, Scene], place: tuple[float, float], leads_there: bool
) -> None:
    walker = Walker(robot_in(scenes["crossing"], -7, 0, 0))
    door = Sighting("door", "automatic door", 1, place, (0, 0), 4, 1, (0, 0), "left")
    assert walker.turn_in(door) is None
    walker.walk_on(6)
    assert walker.turn_in(door) is leads_there
    assert walker.heading == pytest.approx(math.pi / 2 * leads_there, abs=0.1)
