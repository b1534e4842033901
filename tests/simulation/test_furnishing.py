from dataclasses import replace
from typing import Any

import pytest
from shapely import LineString

from memorymaze.simulation.furnishing import door_solid, landmark_solid
from memorymaze.sites import Site
from memorymaze.sites.records import Door


@pytest.mark.parametrize(
    ("properties", "bottom"),
    [
        pytest.param({"mount": "floor"}, 0.0, id="floor"),
        pytest.param({"mount": "ceiling", "size": (1, 0.1, 0.4)}, 2.3, id="sign"),
        pytest.param({"mount": "ceiling", "size": (1, 1, 0.9)}, 2.1, id="too high"),
        pytest.param({"mount": "wall", "size": (1, 0.1, 1.0)}, 1.0, id="poster"),
        pytest.param({"mount": "wall", "size": (2, 0.1, 2.8)}, 0.1, id="window"),
        pytest.param({"mount": "wall", "obstacle": True}, 0.0, id="fountain"),
    ],
)
def test_things_hang_at_their_height(
    plans: Any, properties: dict[str, Any], bottom: float
) -> None:
    item = plans.thing("item", 5, 0.9, **{"obstacle": False, **properties})
    site = plans.site(plans.corridor("way", 0, -1, 10, 1), item)
    solid = landmark_solid(item, site)
    assert solid.position[2] - solid.half_size[2] == pytest.approx(bottom)


def test_a_sign_over_a_door_hangs_above_it(corridor_site: Site, plans: Any) -> None:
    door = Door("door", LineString([(4, 1), (5, 1)]), None, "wood", "", None, "closed")
    sign = plans.thing(
        "sign",
        *(4.5, 0.97),
        size=(0.6, 0.04, 0.2),
        mount="wall",
        degrees=-90,
        obstacle=False,
    )
    site = plans.site(plans.corridor("way", 0, -1, 10, 1), sign)
    solid = landmark_solid(sign, replace(site, doors=(door,)))
    assert solid.position[2] - solid.half_size[2] == pytest.approx(2.15)


def test_a_door_stands_a_little_out_of_its_wall(corridor_site: Site) -> None:
    door = corridor_site.doors[0]
    solid = door_solid(door, corridor_site)
    assert 0.01 <= solid.half_size[0] <= 0.02
    assert 2 * solid.half_size[1] == pytest.approx(door.line.length)
    assert solid.position[:2] == pytest.approx(door.line.centroid.coords[0])
