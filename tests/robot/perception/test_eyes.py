"""Detectors by name, as the command line and `run.json` have them."""

from pathlib import Path

import numpy as np
import pytest
from pydantic import TypeAdapter

from memorymaze.basics.errors import SettingsError
from memorymaze.robot.perception.detector import TruthDetector
from memorymaze.robot.perception.error_model import ErrorModel
from memorymaze.robot.perception.eyes import (
    TRUTH,
    DetectorSettings,
    Eyes,
    parse_detector,
)
from memorymaze.robot.perception.picture_detector import PictureDetector

SETTINGS = TypeAdapter(DetectorSettings)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("truth", TRUTH),
        ("truth:errors", DetectorSettings(errors=ErrorModel())),
        ("truth:miss=0.3, size=1", DetectorSettings(errors=ErrorModel(0.3, size=1))),
        (
            "grounding-dino",
            DetectorSettings(
                "grounding-dino", checkpoint="IDEA-Research/grounding-dino-tiny"
            ),
        ),
        (
            "grounding-dino:models/my dino,box_threshold=0.4,device=cpu,download=true",
            DetectorSettings(
                "grounding-dino",
                checkpoint="models/my dino",
                box_threshold=0.4,
                device="cpu",
                download=True,
            ),
        ),
        (
            "my/finder.py:Finder,url=http://localhost:8000/detect?a=1,timeout=5",
            DetectorSettings(
                "my/finder.py:Finder",
                options="url=http://localhost:8000/detect?a=1,timeout=5",
            ),
        ),
    ],
)
def test_a_detector_is_read_told_and_kept(text: str, meant: DetectorSettings):
    assert parse_detector(text) == meant
    assert parse_detector(str(meant)) == meant
    assert SETTINGS.validate_json(SETTINGS.dump_json(meant)) == meant


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "dino",
            "expected one of truth, grounding-dino, with .* or a finder of your own",
        ),
        ("grounding_dino", "did you mean 'grounding-dino'"),
        ("truth:misss=0.3", "did you mean 'miss'"),
        ("truth:heavy", "expected settings such as miss=0.1"),
        ("truth:miss=often", "truth miss: expected a number, got 'often'"),
        ("truth:miss=0.1,miss=0.2", "miss: given twice"),
        ("truth:miss=2", "miss: expected a number from 0 to 1"),
        ("grounding-dino:x,box_threshold=7", "box_threshold: expected a number from 0"),
        ("grounding-dino:x,box_threshold=nan", "box_threshold: expected a number, got"),
        ("grounding-dino:x,download=maybe", "download: expected true or false"),
        ("finder.py:", "or a finder of your own as module:Class"),
        (
            "remote:http://x/,timeout=5",
            "examples/remote_finder.py:RemoteFinder,url=http://x/,timeout=5$",
        ),
    ],
)
def test_what_is_no_detector_is_refused(text: str, said: str):
    with pytest.raises(SettingsError, match=said):
        parse_detector(text)


def test_the_default_loads_and_draws_nothing():
    eyes = Eyes()
    eyes.check()

    assert not eyes.need_pictures
    assert isinstance(eyes.detector_for(np.random.default_rng(0)), TruthDetector)


def test_a_model_is_loaded_once_and_each_episode_has_tracks_of_its_own(
    grounding_dino: Path, wall
):
    eyes = Eyes(parse_detector(f"grounding-dino:{grounding_dino},box_threshold=0"))
    eyes.check()
    first = eyes.detector_for(np.random.default_rng(0))
    second = eyes.detector_for(np.random.default_rng(0))

    assert isinstance(first, PictureDetector)
    assert eyes.need_pictures
    assert first.detect(wall(), "door") == second.detect(wall(), "door")
