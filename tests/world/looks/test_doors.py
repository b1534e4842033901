from itertools import product

import numpy as np
import pytest
from shapely import LineString

from memorymaze.world.looks.doors import DOOR_STYLES, is_seen_through, model_for_door
from memorymaze.world.sites.records import Door
from memorymaze.world.sites.solids import DOOR_HEIGHT, DOOR_PROUD


def door(style: str, width: float = 0.9, **properties: str | None) -> Door:
    return Door(
        id="d",
        line=LineString([(0, 0), (0, width)]),
        room=None,
        style=style,
        color=properties.get("color", "brown") or "",
        label=properties.get("label"),
        state="open" if properties.get("state") == "open" else "closed",
    )


@pytest.mark.parametrize(
    ("style", "width", "state"),
    list(product(DOOR_STYLES, (0.9, 1.8), ("closed", "open"))),
)
def test_every_style_fills_its_doorway(style: str, width: float, state: str) -> None:
    made = model_for_door(door(style, width, state=state, label="Room 12"))
    low, high = made.bounds()
    assert low[1] < -width / 2 < width / 2 < high[1]
    assert low[2] == pytest.approx(0.0, abs=0.01)
    assert DOOR_HEIGHT < high[2] < DOOR_HEIGHT + 0.4
    for part in made.parts:
        assert part.faces.max() < len(part.vertices)
        assert part.normals is not None
        assert np.linalg.norm(part.normals, axis=1) == pytest.approx(1.0, abs=1e-3)
        if part.material.texture is not None:
            assert part.uv is not None


@pytest.mark.parametrize("style", sorted(DOOR_STYLES))
def test_closed_leaves_stand_where_the_physics_has_them(style: str) -> None:
    made = model_for_door(door(style))
    front = [
        part.vertices[np.abs(part.vertices[:, 0] - DOOR_PROUD) < 0.006]
        for part in made.parts
    ]
    covered = np.concatenate(front)
    assert np.ptp(covered[:, 1]) > 0.85
    assert np.ptp(covered[:, 2]) > 2.0


def test_a_label_is_a_picture_and_without_one_there_is_none() -> None:
    def pictures(made: Door) -> int:
        return sum(
            part.material.texture is not None for part in model_for_door(made).parts
        )

    plain = door("steel", color="grey")
    labelled = door("steel", color="grey", label="Pump Room")
    assert pictures(labelled) == pictures(plain) + 1


def test_restrooms_show_a_pictogram_over_the_word() -> None:
    def label_height(text: str) -> float:
        parts = model_for_door(door("steel", color="grey", label=text)).parts
        label = next(part for part in parts if part.material.texture is not None)
        return float(np.ptp(label.vertices[:, 2]))

    assert label_height("Women") > 2 * label_height("Store")


@pytest.mark.parametrize(
    ("style", "state", "seen_through"),
    [
        ("wood", "closed", False),
        ("wood", "open", True),
        ("glass", "closed", True),
        ("automatic_glass", "closed", True),
        ("elevator", "closed", False),
    ],
)
def test_glass_and_open_doors_are_seen_through(
    style: str, state: str, seen_through: bool
) -> None:
    made = door(style, state=state)
    assert is_seen_through(made) == seen_through
    clear = [part for part in model_for_door(made).parts if part.material.rgba[3] < 0.9]
    assert bool(clear) == seen_through
