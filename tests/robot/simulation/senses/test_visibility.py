import math
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pytest
from shapely import LineString, box
from tests.robot.simulation.conftest import PutRobot

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.perception import VisibleObject
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.senses.coverings import is_floor_piece
from memorymaze.robot.simulation.senses.sight_targets import describe_door
from memorymaze.world.sites import Site
from memorymaze.world.sites.records import Door

FOCAL_LENGTH = 320.0
LENS_HEIGHT = 1.25


def look(robot: SimulatedRobot, range_limit: float = 4.0) -> list[VisibleObject]:
    """See what stands about; the floor is there anyhow."""
    seen = robot.camera_view().visible_objects(range_limit)
    return [each for each in seen if not is_floor_piece(each.description)]


def floors(scene: Scene, put_robot: PutRobot, x: float) -> dict[str, float]:
    """Return metres to the nearest floor of each covering, seen from there to the east."""
    seen = put_robot(scene, x, 0).camera_view().visible_objects(4.0)
    nearest: dict[str, float] = {}
    for each in sorted(seen, key=lambda thing: thing.distance):
        nearest.setdefault(each.description.category, each.distance)
    return nearest


def kinds(things: list[VisibleObject]) -> list[str]:
    return sorted(thing.description.category for thing in things)


def hall_with(plans: Any, *things: Any) -> Scene:
    """A hall of 20 m by 20 m around the origin."""
    hall = plans.area("hall", box(-10, -10, 10, 10))
    return build_scene(plans.site(hall, *things, ceiling_height=4.0))


def test_thing_straight_ahead_is_measured_like_by_a_pinhole(
    plans: Any, put_robot: PutRobot
) -> None:
    crate = plans.thing("crate", 2.25, 0.0, size=(0.5, 0.5, 1.5))
    (seen,) = look(put_robot(hall_with(plans, crate), 0, 0))
    left, top, right, bottom = seen.box
    assert left == pytest.approx(320 - FOCAL_LENGTH * 0.25 / 2.0, abs=1)
    assert right == pytest.approx(320 + FOCAL_LENGTH * 0.25 / 2.0, abs=1)
    assert top == pytest.approx(240 - FOCAL_LENGTH * 0.25 / 2.0, abs=1)
    assert bottom == pytest.approx(240 + FOCAL_LENGTH * LENS_HEIGHT / 2.0, abs=1)
    assert seen.distance == pytest.approx(2.0, abs=0.05)
    assert seen.bearing == pytest.approx(0.0, abs=0.01)
    assert seen.visible_fraction == pytest.approx(1.0)
    assert seen.position == pytest.approx((2.25, 0.0))
    assert seen.length == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("x", "y", "seen"),
    [
        pytest.param(3.0, 0.0, True, id="ahead"),
        pytest.param(2.0, 1.5, True, id="inside the left edge"),
        pytest.param(2.0, -1.5, True, id="inside the right edge"),
        pytest.param(1.5, 2.5, False, id="outside the left edge"),
        pytest.param(1.5, -2.5, False, id="outside the right edge"),
        pytest.param(-2.0, 0.0, False, id="behind"),
        pytest.param(4.1, 0.0, True, id="nearest part within 4 m"),
        pytest.param(4.5, 0.0, False, id="nearest part beyond 4 m"),
    ],
)
def test_field_of_view_and_range_decide(
    plans: Any, put_robot: PutRobot, x: float, y: float, seen: bool
) -> None:
    crate = plans.thing("crate", x, y, size=(0.5, 0.5, 1.5))
    assert bool(look(put_robot(hall_with(plans, crate), 0, 0))) is seen


def test_bearing_is_left_positive_and_turns_with_the_robot(
    plans: Any, put_robot: PutRobot
) -> None:
    scene = hall_with(plans, plans.thing("crate", 2.0, 1.0))
    (ahead,) = look(put_robot(scene, 0, 0))
    (turned,) = look(put_robot(scene, 0, 0, 45))
    assert ahead.bearing == pytest.approx(math.atan2(1, 2), abs=0.05)
    assert turned.bearing == pytest.approx(math.atan2(1, 2) - math.pi / 4, abs=0.05)


def test_wall_corner_hides_what_is_round_it(plans: Any, put_robot: PutRobot) -> None:
    scene = build_scene(
        plans.site(
            plans.corridor("along", -10, -1, 1, 1),
            plans.corridor("across", -1, -1, 1, 10),
            plans.thing("crate", 0.0, 2.5),
        )
    )
    assert look(put_robot(scene, -2.5, 0, 45)) == []
    assert kinds(look(put_robot(scene, 0, 0, 90))) == ["box"]


@pytest.mark.parametrize(
    ("offset", "seen", "fraction"),
    [
        pytest.param(0.0, False, 0.0, id="behind the screen"),
        pytest.param(0.4, True, 0.4, id="looking out on one side"),
        pytest.param(0.15, False, 0.0, id="hardly looking out"),
        pytest.param(1.2, True, 1.0, id="beside it"),
    ],
)
def test_other_thing_hides_it(
    plans: Any, put_robot: PutRobot, offset: float, seen: bool, fraction: float
) -> None:
    screen = plans.thing("screen", 1.5, 0.0, size=(0.5, 0.1, 2.0))
    # Seen from the origin the screen covers it when both are centred.
    crate = replace(
        plans.thing("crate", 3.0, offset, size=(1.0, 0.1, 2.0)), category="crate"
    )
    found = [
        thing
        for thing in look(put_robot(hall_with(plans, screen, crate), 0, 0))
        if thing.description.category == "crate"
    ]
    assert bool(found) is seen
    if found:
        assert found[0].visible_fraction == pytest.approx(fraction, abs=0.1)


def test_thing_of_which_only_a_strip_looks_out_is_not_recognised(
    plans: Any, put_robot: PutRobot
) -> None:
    mural = replace(
        plans.thing("mural", 3.0, 0.0, size=(4.0, 0.1, 3.0)), category="mural"
    )
    screen = plans.thing("screen", 1.5, -0.18, size=(1.7, 0.1, 3.0))
    assert "mural" in kinds(look(put_robot(hall_with(plans, mural), 0, 0)))
    assert kinds(look(put_robot(hall_with(plans, mural, screen), 0, 0))) == ["box"]


@pytest.mark.parametrize(
    ("y", "seen"),
    [pytest.param(2.0, True, id="half"), pytest.param(2.75, False, id="an eighth")],
)
def test_thing_cut_off_by_the_edge_is_recognised_by_enough_of_it(
    plans: Any, put_robot: PutRobot, y: float, seen: bool
) -> None:
    panel = plans.thing("panel", 2.0, y, size=(2.0, 0.02, 1.0), degrees=180)
    assert bool(look(put_robot(hall_with(plans, panel), 0, 0))) is seen


@pytest.mark.parametrize(
    ("x", "seen"),
    [pytest.param(1.5, True, id="near"), pytest.param(3.0, False, id="far")],
)
def test_tiny_thing_is_recognised_from_near(
    plans: Any, put_robot: PutRobot, x: float, seen: bool
) -> None:
    switch = plans.thing(
        "switch", x, 0.0, size=(0.06, 0.06, 0.06), mount="wall", obstacle=False
    )
    assert bool(look(put_robot(hall_with(plans, switch), 0, 0))) is seen


def test_poster_is_not_seen_from_its_edge(plans: Any, put_robot: PutRobot) -> None:
    def posters(degrees: float) -> list[VisibleObject]:
        poster = plans.thing(
            "poster", 2.0, 0.0, size=(0.8, 0.02, 1.0), degrees=degrees, mount="wall"
        )
        return look(put_robot(hall_with(plans, poster), 0, 0))

    assert posters(90) == []
    assert len(posters(180)) == 1
    assert len(posters(120)) == 1


def test_hanging_sign_leaves_the_picture_when_one_comes_under_it(
    plans: Any, put_robot: PutRobot
) -> None:
    sign = plans.thing(
        "sign", 4.0, 0.0, size=(1.2, 0.1, 0.4), degrees=180, mount="ceiling",
        obstacle=False,
    )  # fmt: skip
    scene = hall_with(plans, sign)
    assert len(look(put_robot(scene, 1.0, 0))) == 1
    assert look(put_robot(scene, 3.5, 0)) == []


def drive_past(robot: SimulatedRobot, words: str) -> list[int]:
    found: list[int] = []
    while True:
        found += [each.track_id for each in robot.detect_from_RGB_image(words)]
        if robot.move_forward(0.5).reason != "done":
            return list(dict.fromkeys(found))


def test_four_equal_doors_count_four_and_stay_four_on_the_way_back(
    put_robot: PutRobot,
) -> None:
    robot = put_robot("corridor", 1, 0)
    there = drive_past(robot, "door")
    assert there == [1, 2, 3, 4]
    robot.turn("around")
    assert drive_past(robot, "doors") == [4, 3, 2, 1]


def test_two_doors_a_metre_apart_count_two(plans: Any, put_robot: PutRobot) -> None:
    doors = tuple(
        Door(
            f"door_{i}", LineString([(x, 1.5), (x + 0.9, 1.5)]), None, "wood", "brown",
            None, "closed",
        )
        for i, x in enumerate((4.0, 5.0))
    )  # fmt: skip
    site = replace(plans.site(plans.corridor("along", 0, -1.5, 12, 1.5)), doors=doors)
    robot = put_robot(build_scene(site), 1, 0)
    assert drive_past(robot, "door") == [1, 2]


@pytest.mark.parametrize(
    ("style", "category", "material"),
    [
        ("wood", "door", "wood"),
        ("glass", "door", "glass"),
        ("steel", "door", "steel"),
        ("automatic_glass", "automatic door", "glass"),
        ("elevator", "elevator door", "steel"),
        ("fire", "fire door", "steel"),
    ],
)
def test_door_is_described_by_style_room_and_label(
    corridor_site: Site, style: str, category: str, material: str
) -> None:
    door = replace(corridor_site.doors[0], style=style, label="Lab 7")
    description = describe_door(door, corridor_site)
    room = next((r for r in corridor_site.rooms if r.id == door.room), None)
    assert description.category == category
    assert description.material == material
    assert description.color == door.color
    assert description.text == "Lab 7"
    assert description.name == (room.name if room else None)


def test_view_agrees_with_a_ray_for_every_pixel_block(
    builtin_sites: dict[str, Site],
) -> None:
    site = builtin_sites["museum_7f"]
    scene = build_scene(site)
    overlaps: list[float] = []
    for route in site.routes[:2]:
        for share in (0.1, 0.3, 0.5, 0.7, 0.9):
            place = route.line.interpolate(share, normalized=True)
            for heading in (0.3, 1.9, 3.4, 5.0):
                robot = SimulatedRobot(scene, Pose(place.x, place.y, heading))
                blocks = seen_blocks(scene, robot)
                for thing in look(robot):
                    found = blocks.get(thing.position)
                    assert found is not None, thing
                    overlaps.append(overlap(found, thing.box))
    assert len(overlaps) > 20
    assert np.mean(overlaps) > 0.85
    assert min(overlaps) > 0.4


BLOCK = 4.0
Box = tuple[float, float, float, float]


def seen_blocks(scene: Scene, robot: SimulatedRobot) -> dict[tuple[float, float], Box]:
    """Cast a ray per block of pixels; return the box of each thing by its middle."""
    robot.camera_view()
    data = robot._body.base.data
    lens = data.cam("eye")
    u, v = (
        grid.ravel()
        for grid in np.meshgrid(
            np.arange(BLOCK / 2, 640, BLOCK), np.arange(BLOCK / 2, 480, BLOCK)
        )
    )
    directions = np.stack([u - 320, 240 - v, np.full(u.size, -FOCAL_LENGTH)], axis=1)
    directions /= np.linalg.norm(directions, axis=1)[:, np.newaxis]
    geoms = np.full(u.size, -1, dtype=np.int32)
    mujoco.mj_multiRay(
        scene.model,
        data,
        np.array(lens.xpos),
        (directions @ lens.xmat.reshape(3, 3).T).ravel(),
        np.array([1, 1, 1, 1, 1, 0], dtype=np.uint8),
        True,
        -1,
        geoms,
        np.zeros(u.size),
        None,
        u.size,
        20.0,
    )
    found: dict[tuple[float, float], Box] = {}
    for geom in np.unique(geoms[geoms >= 0]).tolist():
        hit = geoms == geom
        x, y, _ = scene.model.geom_pos[geom].tolist()
        half = BLOCK / 2
        found[x, y] = (
            float(u[hit].min() - half),
            float(v[hit].min() - half),
            float(u[hit].max() + half),
            float(v[hit].max() + half),
        )
    return found


def overlap(first: Box, second: Box) -> float:
    a, b = box(*first), box(*second)
    return float(a.intersection(b).area / a.union(b).area)


def test_a_floor_is_seen_by_its_covering_from_where_it_comes_into_the_picture(
    plans: Any, put_robot: PutRobot
) -> None:
    tiles = plans.area("hall", box(-10, -2, 0, 2))
    carpet = replace(plans.area("lounge", box(0, -2, 10, 2)), floor_material="carpet")
    scene = build_scene(plans.site(tiles, carpet))
    near = floors(scene, put_robot, -2.0)
    assert near["carpet floor"] > near["tile floor"]
    assert near["carpet floor"] == pytest.approx(math.hypot(2.0, LENS_HEIGHT), abs=0.1)
    assert set(floors(scene, put_robot, -8.0)) == {"tile floor"}
    assert set(floors(scene, put_robot, 2.0)) == {"carpet floor"}


def test_a_floor_behind_a_wall_is_not_seen(plans: Any, put_robot: PutRobot) -> None:
    tiles = plans.area("hall", box(-10, -2, 0, 2))
    carpet = replace(plans.area("lounge", box(0.5, -2, 10, 2)), floor_material="carpet")
    way_round = plans.area("way round", box(-10, 2, 10, 3))
    scene = build_scene(plans.site(tiles, carpet, way_round))
    assert set(floors(scene, put_robot, -2.5)) == {"tile floor"}


def test_a_covering_among_the_landmarks_is_seen_in_place_of_the_floor(
    plans: Any, put_robot: PutRobot
) -> None:
    rug = replace(
        plans.thing("rug", 2.5, 0.0, size=(2.0, 2.0, 0.01)),
        category="flowered carpet floor",
        obstacle=False,
    )
    seen = floors(hall_with(plans, rug), put_robot, 0.0)
    assert set(seen) == {"flowered carpet floor"}
