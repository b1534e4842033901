import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import pytest

from memorymaze.basics.errors import CommandError
from memorymaze.robot.api.control import DETECTION_RANGE
from memorymaze.robot.perception import ObjectDescription, TruthDetector, VisibleObject
from memorymaze.robot.perception.camera_view import Wanted


@dataclass
class StillView:
    """A view of given things that notes the range it was asked for."""

    things: Sequence[VisibleObject]
    asked: list[float] = field(default_factory=list[float])

    def visible_objects(
        self, range_limit: float, wanted: Wanted | None = None
    ) -> Sequence[VisibleObject]:
        self.asked.append(range_limit)
        return [
            thing
            for thing in self.things
            if thing.distance <= range_limit
            and (wanted is None or wanted(thing.description))
        ]


def seen(
    category: str, distance: float, x: float, color: str | None = None
) -> VisibleObject:
    return VisibleObject(
        description=ObjectDescription(category, color=color),
        position=(x, 0.0),
        length=0.9,
        box=(300.0, 200.0, 340.0, 280.0),
        distance=distance,
        bearing=math.pi / 6,
        visible_fraction=1.0,
    )


def test_nearest_comes_first_with_all_that_is_known() -> None:
    view = StillView([
        seen("door", 3.0, 5.0),
        seen("door", 1.0, 2.0),
        seen("sofa", 2, 9),
    ])
    far_first = TruthDetector().detect(view, "door")
    assert [found.distance for found in far_first] == [1.0, 3.0]
    nearest = far_first[0]
    assert nearest.label == "door"
    assert nearest.box == (300.0, 200.0, 340.0, 280.0)
    assert nearest.score == 1.0
    assert nearest.bearing_deg == pytest.approx(30)
    assert [found.track_id for found in far_first] == [1, 2]


def test_depth_sensor_drops_what_is_farther_than_four_metres() -> None:
    view = StillView([seen("door", 3.99, 4.0), seen("door", 4.01, 8.0)])
    assert len(TruthDetector().detect(view, "door")) == 1
    assert view.asked == [DETECTION_RANGE]


def test_thing_has_one_number_whatever_it_is_called() -> None:
    detector = TruthDetector()
    view = StillView([seen("door", 1.0, 1.0), seen("sofa", 2.0, 3.0, "red")])
    (couch,) = detector.detect(view, "couch")
    (red,) = detector.detect(view, "something red")
    (door,) = detector.detect(view, "door")
    assert couch.track_id == red.track_id != door.track_id


def test_endless_query_is_refused() -> None:
    with pytest.raises(CommandError, match="300 characters, got 301"):
        TruthDetector().detect(StillView([]), "x" * 301)


def test_range_must_be_positive() -> None:
    with pytest.raises(ValueError, match="greater than 0"):
        TruthDetector(range_limit=0)
