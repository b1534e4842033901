"""The simulated robot reads what is written on things and doors."""

import math
from collections.abc import Callable

import pytest
from shapely import LineString

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.perception.eyes import Eyes
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.world.sites.records import Door


@pytest.fixture
def reader_at(plans) -> Callable[..., SimulatedRobot]:
    """Put a robot at (x, 0), facing a board at (6, 0) that faces `degrees`."""

    def put(x: float, degrees: float = 180.0, size=(1.2, 0.05, 0.4), text="Library"):
        board = plans.thing(
            "board", 6, 0, size=size, mount="wall", degrees=degrees, obstacle=False
        )
        object.__setattr__(board, "text", text)
        site = plans.site(plans.corridor("c", -4, -2, 8, 2), board)
        return SimulatedRobot(build_scene(site), Pose(x, 0, 0))

    return put


def test_a_sign_that_faces_the_robot_is_read(reader_at):
    [sign] = reader_at(3).read_signs()

    assert sign.text == "Library"
    assert sign.distance == pytest.approx(3.0, abs=0.3)
    assert sign.bearing_deg == pytest.approx(0, abs=2)


@pytest.mark.parametrize("degrees", [0, 100, -100])
def test_the_back_and_the_edge_of_a_sign_are_not_read(reader_at, degrees: float):
    assert reader_at(3, degrees).read_signs() == []


def test_a_sign_is_read_up_to_six_metres(reader_at):
    assert len(reader_at(0.2).read_signs()) == 1
    assert reader_at(-0.5).read_signs() == []


def test_what_is_read_does_not_depend_on_what_was_looked_for_before(reader_at):
    far, near = reader_at(0.5), reader_at(3)

    assert far.detect_from_RGB_image("box") == []
    assert len(far.read_signs()) == 1
    (found,) = near.detect_from_RGB_image("box")
    assert [sign.distance for sign in near.read_signs()] == [found.distance]


def test_things_without_words_are_found_after_signs_were_read(plans):
    plain, board = (
        plans.thing(name, 3, y, size=(0.6, 0.6, 1.0), degrees=180.0)
        for name, y in (("plain", -1), ("board", 1))
    )
    object.__setattr__(board, "text", "Library")
    site = plans.site(plans.corridor("c", -4, -2, 8, 2), plain, board)
    robot = SimulatedRobot(build_scene(site), Pose(0, 0, 0))

    assert [sign.text for sign in robot.read_signs()] == ["Library"]
    assert len(robot.detect_from_RGB_image("box")) == 2


def test_small_print_is_read_from_near_only(reader_at):
    words = "these are very many words for a board as small as this one"

    assert reader_at(1.0, size=(0.4, 0.02, 0.2), text=words).read_signs() == []
    assert len(reader_at(5.0, size=(0.4, 0.02, 0.2), text=words).read_signs()) == 1


def test_a_sign_that_is_half_outside_the_picture_is_not_read(reader_at):
    robot = reader_at(4.5, size=(3.6, 0.05, 0.4))

    assert [each.text for each in robot.camera_view().visible_texts(6.0)] == ["Library"]
    assert robot.read_signs() == []


def test_the_label_of_a_door_is_read(plans):
    site = plans.site(plans.corridor("c", 0, -1.5, 8, 1.5))
    line = LineString([(4.5, 1.5), (3.5, 1.5)])
    door = Door("d", line, None, "wood", "brown", "2347", "closed")
    object.__setattr__(site, "doors", (door,))
    robot = SimulatedRobot(build_scene(site), Pose(4, 0, math.pi / 2))

    assert [sign.text for sign in robot.read_signs()] == ["2347"]


def test_painted_signs_are_read_from_the_picture_as_they_are_written(plans):
    def sign(name: str, y: float, text: str, size):
        thing = plans.thing(
            name, 6, y, size=size, mount="wall", degrees=180, obstacle=False
        )
        object.__setattr__(thing, "category", "sign")
        object.__setattr__(thing, "text", text)
        return thing

    site = plans.site(
        plans.corridor("c", 0, -2, 6.2, 2),
        sign("library", 1.2, "Library", (1.0, 0.05, 0.4)),
        sign("room", 0.0, "2347", (0.2, 0.02, 0.15)),
        sign("where", -1.2, "Restrooms and Shop", (1.0, 0.05, 0.4)),
    )
    reader = Eyes(signs="ocr").sign_reader()
    robot = SimulatedRobot(build_scene(site), Pose(3, 0, 0), sign_reader=reader)

    signs = {each.text: each for each in robot.read_signs()}

    assert set(signs) == {"Library", "2347", "Restrooms and Shop"}
    assert signs["2347"].distance == pytest.approx(3.0, abs=0.3)
    assert (
        signs["Library"].bearing_deg
        > 10
        > -10
        > signs["Restrooms and Shop"].bearing_deg
    )
