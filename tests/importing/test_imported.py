import math

import pytest

from memorymaze.importing.imported import LocalFrame
from memorymaze.sites.records import Anchor


def test_a_minute_of_latitude_is_a_sea_mile():
    # The international sea mile, 1852 m, is that minute at 44.2 degrees.
    frame = LocalFrame(Anchor(44.2, 8.0, 0.0))
    assert frame.metres(8.0, 44.2 + 1 / 60) == (0.0, pytest.approx(1852, abs=0.5))


def test_a_degree_of_longitude_shrinks_towards_the_poles():
    east, north = LocalFrame(Anchor(60.0, 10.0, 0.0)).metres(10.001, 60.0)
    assert (east, north) == (pytest.approx(55.80, abs=0.01), 0.0)


def test_the_bearing_turns_north_away_from_y():
    frame = LocalFrame(Anchor(50.0, 0.0, math.radians(90)))
    x, y = frame.metres(0.0, 50.001)
    assert (x, y) == (pytest.approx(-111.23, abs=0.02), pytest.approx(0.0, abs=1e-9))


def test_a_frame_is_in_the_middle_of_what_it_is_around():
    frame = LocalFrame.around([(10.0, 50.0), (10.002, 50.001), (10.001, 50.004)])
    assert frame.plan_anchor() == {
        "latitude": 50.002, "longitude": 10.001, "bearing_deg": 0.0,
    }  # fmt: skip
