"""Mistakes of the detector that knows the truth: as often as said, and repeatable."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.perception.camera_view import (
    ObjectDescription,
    VisibleObject,
    Wanted,
)
from memorymaze.robot.perception.detector import TruthDetector
from memorymaze.robot.perception.error_model import ErrorModel, ErrorSource

REFERENCE = VisibleObject(
    description=ObjectDescription("door"),
    position=(2.0, 0.0),
    length=0.9,
    box=(300.0, 200.0, 364.0, 264.0),
    distance=2.0,
    bearing=0.0,
    visible_fraction=1.0,
)
FAULTLESS = ErrorModel(miss=0, confusion=0, phantoms=0)


class View:
    """Things seen from a place."""

    def __init__(self, *things: VisibleObject, pose: Pose | None = None) -> None:
        self.things = things
        self.pose = pose or Pose(0, 0, 0)

    def visible_objects(self, range_limit: float, wanted: Wanted | None = None):
        return [
            thing
            for thing in self.things
            if thing.distance <= range_limit
            and (wanted is None or wanted(thing.description))
        ]


def detector(model: ErrorModel, seed: int = 0) -> TruthDetector:
    return TruthDetector(errors=ErrorSource(model, np.random.default_rng(seed)))


def places(count: int) -> list[Pose]:
    return [Pose(number, 0, 0) for number in range(count)]


def test_the_reference_thing_is_missed_as_often_as_said():
    watcher = detector(replace(FAULTLESS, miss=0.3))

    seen = [
        len(watcher.detect(View(REFERENCE, pose=pose), "door")) for pose in places(1000)
    ]

    assert sum(seen) == pytest.approx(700, abs=50)


def test_log_odds_of_a_miss_grow_as_documented():
    model = ErrorModel(miss=0.1, size=0.7, distance=0.5, occlusion=3)
    hard = replace(
        REFERENCE, box=(300, 200, 332, 232), distance=3.0, visible_fraction=0.5
    )

    odds = model.miss_probability(hard) / (1 - model.miss_probability(hard))

    assert model.miss_probability(REFERENCE) == pytest.approx(0.1)
    assert math.log(odds) == pytest.approx(math.log(1 / 9) + 0.7 + 0.5 + 1.5)


@given(
    side=st.floats(9, 400),
    distance=st.floats(0.2, 4),
    fraction=st.floats(0.25, 1),
    worse=st.sampled_from(["smaller", "farther", "hidden"]),
)
def test_what_is_smaller_farther_or_more_hidden_is_mistaken_more_often(
    side: float, distance: float, fraction: float, worse: str
):
    thing = replace(
        REFERENCE,
        box=(0, 0, side, side),
        distance=distance,
        visible_fraction=fraction,
    )
    harder = {
        "smaller": replace(thing, box=(0, 0, side / 2, side)),
        "farther": replace(thing, distance=distance + 0.5),
        "hidden": replace(thing, visible_fraction=fraction / 2),
    }[worse]
    model = ErrorModel()

    assert model.miss_probability(harder) > model.miss_probability(thing)
    assert model.confusion_probability(harder) > model.confusion_probability(thing)


def test_another_thing_is_taken_for_the_one_asked_for():
    sofa = replace(REFERENCE, description=ObjectDescription("sofa"))
    watcher = detector(replace(FAULTLESS, confusion=1))

    [found] = watcher.detect(View(sofa), "red door")

    assert (found.label, found.box, found.distance) == ("red door", sofa.box, 2.0)
    assert 0.5 <= found.score < 0.8


def test_phantoms_come_as_often_as_said_within_picture_and_range():
    watcher = detector(replace(FAULTLESS, phantoms=0.5))

    looks = [watcher.detect(View(pose=pose), "door") for pose in places(1000)]

    assert sum(map(len, looks)) == pytest.approx(500, abs=60)
    for each in (found for look in looks for found in look):
        left, top, right, bottom = each.box
        assert 0 <= left < right <= 640
        assert 0 <= top < bottom <= 480
        assert 0.5 <= each.distance <= 4
        assert abs(each.bearing_deg) <= 45


def test_asking_again_from_the_same_place_repeats_the_mistakes():
    model = ErrorModel(miss=0.5, confusion=0.5, phantoms=1)
    sofa = replace(REFERENCE, description=ObjectDescription("sofa"), position=(3, 1))
    watcher = detector(model)
    for pose in places(20):
        view = View(REFERENCE, sofa, pose=pose)
        first = watcher.detect(view, "door")
        watcher.detect(view, "sofa")

        assert watcher.detect(view, "door") == first


def test_the_same_seed_makes_the_same_mistakes_and_another_seed_others():
    def walk(seed: int):
        watcher = detector(ErrorModel(miss=0.5, phantoms=0.5), seed)
        return [
            watcher.detect(View(REFERENCE, pose=pose), "door") for pose in places(50)
        ]

    assert walk(1) == walk(1)
    assert walk(1) != walk(2)


def test_a_model_without_mistakes_finds_what_the_detector_without_a_model_finds():
    sofa = replace(REFERENCE, description=ObjectDescription("sofa"), distance=1.0)
    view = View(REFERENCE, sofa)

    assert detector(FAULTLESS).detect(
        view, "furniture or door"
    ) == TruthDetector().detect(view, "furniture or door")


@pytest.mark.parametrize(
    "change",
    [{"miss": 1.1}, {"confusion": -0.1}, {"phantoms": math.nan}, {"size": math.inf}],
)
def test_values_without_meaning_are_refused(change: dict[str, float]):
    [name] = change
    make: Callable[..., ErrorModel] = ErrorModel
    with pytest.raises(SettingsError, match=f"detector setting {name}: expected"):
        make(**change)
