"""Finders of one's own: found by name, made with options, and held to what they give."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.robot.perception import own_finders

from memorymaze.basics.errors import DetectorError, SettingsError
from memorymaze.robot.perception.eyes import Eyes, parse_detector

MODULE = own_finders.__name__


def eyes_of(detector: str) -> Eyes:
    return Eyes(parse_detector(detector))


def test_it_is_made_once_with_its_options_and_serves_all_episodes(
    wall: Callable[..., Any],
) -> None:
    own_finders.made.clear()
    eyes = eyes_of(f"{MODULE}:Middle,score=0.5")
    eyes.check()
    for _ in range(2):
        detector = eyes.detector_for(np.random.default_rng(0))
        [found] = detector.detect(wall(), "red chair")
        assert (found.label, found.score, found.track_id) == ("red chair", 0.5, 1)
        assert all(type(number) is float for number in (*found.box, found.score))
    assert len(own_finders.made) == 1
    assert eyes.need_pictures


def test_it_is_found_in_a_file(wall: Callable[..., Any]) -> None:
    eyes = eyes_of(f"{Path(own_finders.__file__)}:Middle")
    [found] = eyes.detector_for(np.random.default_rng(0)).detect(wall(), "door")
    assert found.distance == pytest.approx(3.0)


@pytest.mark.parametrize(
    ("detector", "says"),
    [
        ("nowhere.py:Finder", "'nowhere.py' cannot be imported.*no such file"),
        (f"{MODULE}:Nobody", "nothing of this name"),
        (
            f"{MODULE}:Middle,scor=1",
            "NAME is one of score, broken.*did you mean 'score'",
        ),
        (f"{MODULE}:Middle,score=high", "score: expected a number"),
        (f"{MODULE}:Blind,score=1", "has no options to set"),
        (f"{MODULE}:Gone", r"cannot be made \(OSError: no weights"),
        (f"{MODULE}:Mute", r"expected a finder with `find\(rgb, query\)`, got Mute"),
    ],
)
def test_what_cannot_be_had_is_said_before_a_run(detector: str, says: str) -> None:
    with pytest.raises(SettingsError, match=says):
        eyes_of(detector).check()


@pytest.mark.parametrize(
    ("finder", "says"),
    [
        ("Middle,broken=true", "failed on 'door' (RuntimeError: out of memory"),
        ("Middle,score=80", "a score from 0 to 1, got 'door' and 80.0 (own_finders.py"),
        ("Turned", "left, top, right, bottom in pixels, got [60, 40, 20, 10]"),
        ("Tuples", "expected find to return FoundBox, got ((1, 2, 3, 4)"),
    ],
)
def test_what_it_does_amiss_is_a_fault_of_the_detector(
    wall: Callable[..., Any], finder: str, says: str
) -> None:
    detector = eyes_of(f"{MODULE}:{finder}").detector_for(np.random.default_rng(0))
    with pytest.raises(DetectorError, match=re.escape(says)):
        detector.detect(wall(), "door")
