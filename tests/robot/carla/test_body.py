"""The body on a server that is our own simulation."""

import math

import carla
import numpy as np
import pytest
from tests.robot.carla.conftest import MakeBody
from tests.robot.carla.stand_in import StandInServer

from memorymaze.basics.errors import RobotBodyError, SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.physics_engine import mujoco
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.api.sensors_and_motion import SensorsAndMotion
from memorymaze.robot.carla.frames import pose_of
from memorymaze.robot.simulation.cameras import SceneCameras
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.senses.lidar import Lidar
from memorymaze.robot.steering.guide_robot import GuideRobot
from memorymaze.testing import check_robot, check_sensors_and_motion

EAST = Pose(2.0, 0.0, 0.0)


def _drive(body: SensorsAndMotion, speed: float, turn_rate: float, times: int) -> None:
    for _ in range(times):
        body.drive(speed, turn_rate, 0.05)


def test_it_keeps_the_contract_of_bodies_though_new_sensors_leave_out_a_frame(
    put_body: MakeBody, server: StandInServer
) -> None:
    server.first_left_out = 1
    body = put_body()
    assert isinstance(body, SensorsAndMotion)
    check_sensors_and_motion(body)


def test_it_keeps_the_contract_though_all_its_sensors_send_late(
    put_body: MakeBody, server: StandInServer
) -> None:
    server.delay = 0.002
    check_sensors_and_motion(put_body())


def test_a_guide_robot_on_it_does_all_that_agents_call(put_body: MakeBody) -> None:
    check_robot(GuideRobot(put_body()))


def test_a_guide_robot_on_it_finds_the_corner_and_takes_it(put_body: MakeBody) -> None:
    body = put_body(EAST)
    robot = GuideRobot(body)
    robot.move_forward(9)
    assert robot.detect_turning_point() == ["left"]
    assert robot.turn("left").turned
    robot.move_forward(6)
    where = body.pose_in_site()
    assert (where.x, where.y) == pytest.approx((11, 6), abs=0.5)


def test_it_goes_exactly_along_the_arc_that_its_speeds_describe(
    put_body: MakeBody, server: StandInServer
) -> None:
    body = put_body(EAST)
    before = body.odometry()
    _drive(body, 0.25, 0.5, 40)
    after = body.odometry()
    there = Pose(2 + 0.5 * math.sin(1), 0.5 * (1 - math.cos(1)), 1.0)
    assert after.pose == pytest.approx(there, abs=1e-5)
    assert after.pose == body.pose_in_site()
    assert after.speed == pytest.approx(0.25, rel=1e-3)
    assert after.time - before.time == pytest.approx(2.0)
    # To the left is to smaller y and yaw in CARLA.
    stands = server.body().truth
    assert pose_of(stands) == pytest.approx(there, abs=1e-5)
    assert stands.location.y < 0
    assert stands.rotation.yaw == pytest.approx(-math.degrees(1), abs=1e-3)


def test_commands_of_10_ms_are_exact_and_cost_the_server_a_frame_per_50_ms(
    put_body: MakeBody, server: StandInServer
) -> None:
    body = put_body(EAST)
    before, frame = body.odometry().time, server.frame
    for _ in range(7):
        body.drive(0.5, 0.0, 0.01)
    assert body.odometry().pose.x == pytest.approx(2.035, abs=1e-5)
    assert body.odometry().time == pytest.approx(before + 0.07)
    assert server.frame == frame + 1
    body.drive(0.5, 0.0, 0.13)
    assert server.frame == frame + 4
    assert body.odometry().time == pytest.approx(before + 0.2)


def test_a_scan_between_two_frames_lets_the_body_stand_until_the_next(
    put_body: MakeBody, server: StandInServer
) -> None:
    body = put_body(EAST)
    before, frame = body.odometry().time, server.frame
    body.drive(0.5, 0.0, 0.02)
    scan = body.lidar_scan()
    assert server.frame == frame + 1
    assert scan.time == body.odometry().time == pytest.approx(before + 0.05)
    assert body.odometry().pose.x == pytest.approx(2.01, abs=1e-5)
    assert scan.ranges[180] == pytest.approx(12 - 2.01, abs=0.01)
    assert body.lidar_scan() is scan


def test_its_scan_is_the_one_that_our_own_lidar_takes_there(
    put_body: MakeBody, server: StandInServer
) -> None:
    body = put_body(Pose(9.0, 0.3, 0.7))
    _drive(body, 0.4, -0.3, 9)
    ours = Lidar(build_scene(server.site)).scan(body.pose_in_site())
    seen = body.lidar_scan()
    assert seen.angles == pytest.approx(ours.angles)
    assert seen.ranges == pytest.approx(ours.ranges, abs=0.01)


@pytest.mark.proof
def test_its_pictures_are_those_of_our_own_camera_there(
    put_body: MakeBody, server: StandInServer
) -> None:
    body = put_body(Pose(3.0, 0.2, -0.4))
    scene = build_scene(server.site)
    data = mujoco.MjData(scene.model)
    mujoco.mj_kinematics(scene.model, data)
    eyes = SceneCameras(scene, data, "own")
    for width, height, fov in ((64, 48, 1.2), (32, 32, math.pi / 2), (64, 48, 1.2)):
        picture = body.camera_picture(width, height, fov)
        ours = eyes.frame(body.pose_in_site(), width, height, fov)
        assert np.abs(picture.rgb.astype(int) - ours.rgb).mean() < 1
        assert picture.depth == pytest.approx(ours.depth, abs=0.01)
        body.drive(0.0, 0.2, 0.01)
    cameras = [each for each in server.actors.values() if "camera" in each.type_id]
    assert [each.type_id for each in cameras] == [
        "sensor.camera.rgb",
        "sensor.camera.depth",
    ] * 2
    assert {each.in_world().location.z for each in cameras} == {1.25}


@pytest.mark.parametrize(
    ("size", "words"),
    [((0, 48, 1.0), "width"), ((64, 4.5, 1.0), "height"), ((64, 48, 3.2), "fov")],
)
def test_a_picture_that_no_camera_takes_is_refused(
    put_body: MakeBody, size: tuple[int, int, float], words: str
) -> None:
    with pytest.raises(SettingsError, match=f"camera .*{words}"):
        put_body().camera_picture(*size)


def test_it_stops_a_radius_before_a_wall_and_can_leave_it(put_body: MakeBody) -> None:
    body = put_body(Pose(2.0, 0.0, math.pi / 2))
    _drive(body, 0.5, 0.0, 60)
    assert body.pose_in_site().y == pytest.approx(1 - ROBOT_RADIUS, abs=0.005)
    assert body.odometry().speed == pytest.approx(0, abs=1e-3)
    _drive(body, -0.5, 0.0, 20)
    assert body.pose_in_site().y == pytest.approx(0.25, abs=0.01)


def test_it_stops_a_radius_before_a_person_and_goes_on_when_they_have_left(
    put_body: MakeBody, server: StandInServer
) -> None:
    body = put_body(EAST)
    library = server.get_blueprint_library()
    person = server.spawn_actor(
        library.find("walker.pedestrian.0001"), carla.Transform(carla.Location(4, 0, 1))
    )
    _drive(body, 0.5, 0.0, 100)
    assert body.pose_in_site().x == pytest.approx(4 - 0.2 - ROBOT_RADIUS, abs=0.01)
    person.set_transform(carla.Transform(carla.Location(4, 8, 1)))
    _drive(body, 0.5, 0.0, 20)
    assert body.pose_in_site().x > 3.9


@pytest.mark.parametrize("start", [EAST, Pose(11.0, 5.0, -math.pi / 2)])
def test_what_touches_it_holds_it_on_that_way_for_half_a_second(
    put_body: MakeBody, server: StandInServer, start: Pose
) -> None:
    body = put_body(start)

    def after(speed: float, times: int) -> float:
        """Return metres ahead of the start."""
        _drive(body, speed, 0.0, times)
        there = body.pose_in_site()
        dx, dy = there.x - start.x, there.y - start.y
        return dx * math.cos(start.heading) + dy * math.sin(start.heading)

    server.is_touched = True
    held = after(0.5, 2)
    assert after(0.5, 5) == pytest.approx(held, abs=0.03)
    held = after(0.0, 1)
    assert after(-0.5, 2) == pytest.approx(held - 0.05, abs=1e-4)
    assert after(0.5, 10) > held + 0.1


def test_its_wheels_tell_of_a_frame_that_begins_where_it_did_and_err_as_asked(
    put_body: MakeBody,
) -> None:
    body = put_body(EAST, carla_odometry="scale_error=0.1")
    assert body.odometry().pose == (0.0, 0.0, 0.0)
    _drive(body, 0.5, 0.0, 20)
    assert body.odometry().pose == pytest.approx((0.55, 0, 0), abs=1e-4)
    assert math.dist(body.pose_in_site()[:2], EAST[:2]) == pytest.approx(0.5, abs=1e-4)


@pytest.mark.proof
def test_the_noise_of_its_wheels_is_the_same_for_the_same_seed(
    put_body: MakeBody,
) -> None:
    ends = []
    for seed in (1, 1, 2):
        body = put_body(seed=seed, carla_odometry="heading_noise=0.1")
        _drive(body, 0.5, 0.0, 20)
        ends.append(body.odometry().pose)
        body.close()
    assert ends[0] == ends[1] != ends[2]


@pytest.mark.proof
def test_a_walkers_sensors_are_as_high_as_a_suitcases(
    put_body: MakeBody, server: StandInServer
) -> None:
    """The origin of a walker is in its middle."""
    for blueprint in ("walker.pedestrian.0001", "static.prop.travelcase"):
        body = put_body(carla_body=blueprint)
        [lidar] = [each for each in server.actors.values() if "lidar" in each.type_id]
        assert lidar.in_world().location.z == pytest.approx(0.4)
        body.close()


def test_a_sensor_that_leaves_out_a_frame_is_told(
    put_body: MakeBody, server: StandInServer
) -> None:
    body = put_body(carla_timeout=0.05)
    lost = server.frame + 3
    server.lost = lambda kind, frame: "lidar" in kind and frame == lost
    with pytest.raises(RobotBodyError, match=f"ray_cast: expected frame {lost} within"):
        _drive(body, 0.1, 0.0, 5)


def test_a_server_that_dies_half_way_is_told_and_so_is_that_nothing_was_taken_out(
    put_body: MakeBody, server: StandInServer
) -> None:
    body = put_body(carla_host="far", carla_port=2004, carla_timeout=3)
    server.die(after=4)
    with pytest.raises(RobotBodyError) as told:
        _drive(body, 0.5, 0.0, 10)
    for words in ("far:2004", "compute a frame", "time-out of 3000ms", "./CarlaUE4.sh"):
        assert words in str(told.value)
    with pytest.raises(RobotBodyError, match="end the episode"):
        body.close()
