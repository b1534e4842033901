import math
from collections.abc import Iterator

import numpy as np
import pytest

from memorymaze.errors import SettingsError
from memorymaze.geometry.pose import Pose
from memorymaze.pictures.rendering import (
    PanoramaCamera,
    PanoramaFrame,
    RenderedCamera,
    VisualScene,
)

POSE = Pose(6.0, 0.3, 0.4)


@pytest.fixture(scope="module")
def panorama(corridor_looks: VisualScene) -> Iterator[PanoramaFrame]:
    """One look all round in the corridor."""
    with PanoramaCamera(corridor_looks, 256) as camera:
        yield camera.frame(POSE)


def test_the_middle_shows_what_a_camera_ahead_shows(
    panorama: PanoramaFrame, corridor_looks: VisualScene
) -> None:
    with RenderedCamera(corridor_looks, 63, 63) as camera:
        ahead = camera.frame(POSE)
    assert panorama.distance[63:65, 127:129].mean() == pytest.approx(
        ahead.depth[31, 31], rel=0.03
    )
    assert panorama.instances[64, 128] == ahead.instances[31, 31]


@pytest.mark.parametrize("bearing_deg", [-135.0, -90.0, -20.0, 70.0, 170.0])
def test_a_column_looks_to_its_bearing(
    bearing_deg: float, panorama: PanoramaFrame, corridor_looks: VisualScene
) -> None:
    bearing = math.radians(bearing_deg)
    column = round((math.pi - bearing) / (2 * math.pi) * 256 - 0.5)
    with RenderedCamera(corridor_looks, 63, 63) as camera:
        there = camera.frame(Pose(POSE.x, POSE.y, POSE.heading + bearing))
    assert panorama.distance[64, column] == pytest.approx(
        float(there.depth[31, 31]), rel=0.06
    )


def test_straight_down_is_the_floor_and_up_the_ceiling(
    panorama: PanoramaFrame,
) -> None:
    down = panorama.instances[-1]
    up = panorama.instances[0]
    assert {panorama.objects[number].kind for number in down} == {"floor"}
    assert {panorama.objects[number].kind for number in up} == {"ceiling"}
    assert panorama.distance[-1] == pytest.approx(1.25, abs=0.01)


def test_seams_are_continuous(panorama: PanoramaFrame) -> None:
    picture = panorama.rgb.astype(int)
    steps = np.abs(np.diff(picture, axis=1, append=picture[:, :1])).mean(axis=(0, 2))
    # Columns where faces meet: 45, 135, 225, 315 degrees from the left; and the ends.
    seams = [31, 32, 95, 96, 159, 160, 223, 224, 255]
    others = np.delete(steps, seams)
    assert steps[seams].max() < 2 * np.quantile(others, 0.98)


@pytest.mark.parametrize("width", [7, 6, 255])
def test_a_width_without_meaning_is_refused(
    width: int, corridor_looks: VisualScene
) -> None:
    with pytest.raises(SettingsError, match="panorama: expected"):
        PanoramaCamera(corridor_looks, width)
