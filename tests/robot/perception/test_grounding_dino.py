"""Real architectures with random weights: loading, reading words, boxes, thresholds."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.robot.perception.grounding_dino import ZeroShotFinder
from memorymaze.robot.perception.picture_detector import PictureDetector
from memorymaze.testing import check_object_finder

RGB = np.random.default_rng(0).integers(0, 255, (480, 640, 3), dtype=np.uint8)


def test_boxes_are_pixels_of_the_picture_with_labels_of_the_words_asked_for(
    grounding_dino: Path,
):
    finder = ZeroShotFinder(str(grounding_dino), box_threshold=0, text_threshold=0)

    found = finder.find(RGB, "Red door.")

    assert len(found) == 12
    for each in found:
        assert 0 <= each.score <= 1
        assert each.label == "red door"
        left, top, right, bottom = each.box
        assert left < right
        assert top < bottom
    assert max(each.box[2] for each in found) > 320
    assert max(each.box[3] for each in found) > 240


def test_boxes_below_the_threshold_are_left_out(grounding_dino: Path):
    everything = ZeroShotFinder(str(grounding_dino), box_threshold=0)
    scores = sorted(each.score for each in everything.find(RGB, "chair"))

    some = everything.with_thresholds(scores[6] - 1e-6, 0.25).find(RGB, "chair")

    assert sorted(each.score for each in some) == scores[6:]


def test_words_below_the_text_threshold_are_no_part_of_the_label(grounding_dino: Path):
    finder = ZeroShotFinder(str(grounding_dino), box_threshold=0, text_threshold=0.5)

    labels = {each.label for each in finder.find(RGB, "red door chair")}

    assert len(labels) > 1
    assert all(set(each.split()) <= {"red", "door", "chair"} for each in labels)


def test_a_model_of_another_family_reads_labels(owl_vit: Path):
    finder = ZeroShotFinder(str(owl_vit), box_threshold=0.4)

    found = finder.find(RGB, "vending machine")

    assert 0 < len(found) < 16
    assert {each.label for each in found} == {"vending machine"}


def test_detections_have_distance_and_direction(grounding_dino: Path, wall):
    finder = ZeroShotFinder(str(grounding_dino), box_threshold=0)

    found = PictureDetector(finder).detect(wall(), "door")

    assert found
    assert all(3.0 <= each.distance <= 4.0 for each in found)
    assert [each.distance for each in found] == sorted(e.distance for e in found)


def test_words_without_a_letter_find_nothing(grounding_dino: Path):
    assert ZeroShotFinder(str(grounding_dino)).find(RGB, " . ") == []


def test_a_checkpoint_that_is_not_there_is_not_fetched(monkeypatch):
    monkeypatch.setenv("HF_HUB_OFFLINE", "1")
    finder = ZeroShotFinder("someone/some-detector")

    with pytest.raises(SettingsError, match=r"'someone/some-detector': it is not on"):
        finder.check()


def test_a_folder_that_is_not_there_is_named(tmp_path: Path):
    with pytest.raises(SettingsError, match="no such folder"):
        ZeroShotFinder(str(tmp_path / "nothing")).check()


def test_a_folder_without_weights_is_refused(grounding_dino: Path, tmp_path: Path):
    folder = tmp_path / "half"
    shutil.copytree(grounding_dino, folder)
    (folder / "model.safetensors").unlink()

    with pytest.raises(SettingsError, match="no checkpoint that can be loaded"):
        ZeroShotFinder(str(folder)).check()


def test_a_model_for_something_else_is_refused(grounding_dino: Path, tmp_path: Path):
    folder = tmp_path / "language"
    shutil.copytree(grounding_dino, folder)
    config = {"model_type": "bert", "architectures": ["BertModel"]}
    (folder / "config.json").write_text(json.dumps(config), encoding="utf-8")

    with pytest.raises(SettingsError, match="zero-shot object detection checkpoint"):
        ZeroShotFinder(str(folder)).check()


def test_a_device_that_is_not_there_is_refused(grounding_dino: Path):
    with pytest.raises(SettingsError, match="device 'gpu' cannot be used here"):
        ZeroShotFinder(str(grounding_dino), device="gpu").check()


@pytest.mark.parametrize("checkpoint", ["grounding_dino", "owl_vit"])
def test_both_kinds_keep_the_contract_of_finders(
    checkpoint: str, request: pytest.FixtureRequest
):
    folder = request.getfixturevalue(checkpoint)
    check_object_finder(ZeroShotFinder(str(folder), box_threshold=0.0), RGB)
