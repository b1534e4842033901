import json
import math
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.robot.simulation.conftest import PutRobot

from memorymaze.basics.errors import CommandError, EpisodeOver
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.robot.steering.calls import TraceEvent
from memorymaze.runs.episodes.trace import trace_lines
from memorymaze.runs.episodes.trace_entries import call_entry
from memorymaze.testing import check_robot
from memorymaze.world.sites import Site


def test_keeps_the_contract_of_the_control_api(scenes: dict[str, Scene]) -> None:
    for scene in scenes.values():
        check_robot(SimulatedRobot(scene, scene.site.routes[0].start))


def test_a_refused_distance_takes_no_time_and_stands_in_the_trace(
    put_robot: PutRobot,
) -> None:
    events: list[TraceEvent] = []
    robot = put_robot("corridor", 2, 0, events=events)
    with pytest.raises(CommandError, match="greater than 0"):
        robot.move_forward(-0.5)
    assert robot.time == 0
    assert "error" in json.dumps(events[-1].result)


def test_many_short_moves_are_one_long_walk(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0)
    for _ in range(20):
        assert robot.move_forward(0.5).reason == "done"
    assert robot.pose.x == pytest.approx(12, abs=0.1)
    assert robot.distance_travelled() == pytest.approx(10, abs=0.1)
    assert robot.time < 16, "it must not stop after each of them"


def test_no_time_passes_while_it_looks(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0)
    robot.move_forward(1)
    before = robot.time, robot.pose
    robot.detect_turning_point()
    robot.turning_point_id()
    robot.detect_from_RGB_image("door")
    robot.say("Hello.")
    robot.distance_travelled()
    assert (robot.time, robot.pose) == before


def test_stands_still_within_a_few_centimetres_after_stop(put_robot: PutRobot) -> None:
    robot = put_robot("corridor", 2, 0)
    robot.move_forward(3)
    with pytest.raises(EpisodeOver) as over:
        robot.stop()
    assert over.value.stopped_by == robot.stopped_by == "agent"
    assert robot.pose.x == pytest.approx(5.1, abs=0.1)


def test_the_same_seed_gives_the_same_walk_step_by_step(put_robot: PutRobot) -> None:
    walks = []
    for seed in (7, 7, 8):
        robot = put_robot("l_shape", 1, 0.2, seed=seed)
        robot.move_forward(20)
        robot.turn("left")
        robot.move_forward(20)
        walks.append(robot.trajectory().poses)
    assert walks[0] == walks[1]
    assert walks[0] != walks[2]


def test_two_robots_in_one_scene_do_not_disturb_each_other(put_robot: PutRobot) -> None:
    alone = put_robot("l_shape", 1, 0)
    alone.move_forward(4)
    alone.move_forward(4)
    first, second = (put_robot("l_shape", 1, 0) for _ in range(2))
    for robot in (first, second, first, second):
        robot.move_forward(4)
    assert first.trajectory() == second.trajectory() == alone.trajectory()


def test_the_trajectory_is_sampled_evenly_and_after_every_call(
    put_robot: PutRobot,
) -> None:
    robot = put_robot("corridor", 2, 0)
    robot.move_forward(2.1)
    after_move = robot.pose
    robot.turn("around")
    times = np.array([pose.time for pose in robot.trajectory().poses])
    assert times[0] == 0
    assert times[-1] == robot.time
    assert np.diff(times).max() <= 0.2 + 1e-9
    assert after_move in [pose.pose for pose in robot.trajectory().poses]


def test_every_call_leaves_an_event_that_json_can_tell(put_robot: PutRobot) -> None:
    events: list[TraceEvent] = []
    robot = put_robot("corridor", 7.5, 0, events=events)
    robot.move_forward(1)
    robot.turn("left")
    robot.detect_from_RGB_image("bench")
    robot.say("A bench.")
    robot.finish()
    assert [event.call for event in events] == [
        "move_forward",
        "turn",
        "detect_from_RGB_image",
        "say",
        "stop",
    ]
    assert events[0].arguments == {"distance": 1.0}
    assert events[0].pose.x == pytest.approx(8.5, abs=0.02)
    lines = trace_lines(map(call_entry, events)).splitlines()
    told = [json.loads(line)["result"] for line in lines]
    assert told[0]["reason"] == "done"
    assert told[1]["turned"] is False
    assert told[2][0]["label"] == "bench"
    assert robot.refused_turns == 1


@pytest.mark.parametrize("line", [[1.0, 2.0], [[1.0]], [[math.nan, 0.0]]])
def test_refuses_lines_without_meaning(put_robot: PutRobot, line: object) -> None:
    robot = put_robot("corridor", 2, 0)
    with pytest.raises(CommandError, match="follow"):
        robot.follow(line)  # type: ignore[arg-type]


@given(
    y=st.floats(-0.9, 0.9),
    degrees=st.floats(-30, 30),
    seed=st.integers(0, 1000),
)
def test_finds_the_middle_from_anywhere_in_a_corridor(
    scenes: dict[str, Scene], y: float, degrees: float, seed: int
) -> None:
    robot = SimulatedRobot(
        scenes["corridor"],
        Pose(2, y, math.radians(degrees)),
        rng=np.random.default_rng(seed),
    )
    robot.move_forward(6)
    assert abs(robot.pose.y) < 0.15
    assert robot.collisions == ()


def test_a_random_walker_touches_nothing_and_is_always_told_the_truth(
    builtin_sites: dict[str, Site],
) -> None:
    site = builtin_sites["museum_7f"]
    scene = build_scene(site)
    rng = np.random.default_rng(3)
    robot = SimulatedRobot(
        scene, site.routes[0].start, SimulationSettings(time_budget=300), rng
    )
    with suppress(EpisodeOver):
        while True:
            ways = robot.detect_turning_point()
            if ways and rng.random() < 0.3:
                assert robot.turn(str(rng.choice(ways))).turned or robot.stopped_by
            if robot.move_forward(float(rng.uniform(0.3, 5))).reason != "done":
                robot.turn(str(rng.choice([*robot.detect_turning_point(), "around"])))
    assert robot.stopped_by == "budget"
    assert robot.collisions == ()
    assert scene.clearance.to_anything(robot.trajectory().points).min() > 0.27
