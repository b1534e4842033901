from pathlib import Path

import numpy as np
import pytest

from memorymaze.errors import SettingsError
from memorymaze.evaluation.arena import Arena
from memorymaze.evaluation.eyes import looks_of_run
from memorymaze.evaluation.settings import RunSettings
from memorymaze.instructions import load_corpus
from memorymaze.simulation import SimulationSettings


def test_runs_without_cameras_do_not_depend_on_looks() -> None:
    assert looks_of_run(frozenset(), RunSettings()) is None
    assert looks_of_run(frozenset({"answers"}), RunSettings()) is None


def test_runs_with_cameras_say_what_these_show() -> None:
    assert looks_of_run(frozenset({"camera"}), RunSettings()) == "own"
    assert looks_of_run(frozenset(), RunSettings(signs="ocr")) == "own"


def test_looks_that_are_not_there_are_refused_before_the_run() -> None:
    with pytest.raises(SettingsError, match="memorymaze sites models"):
        looks_of_run(frozenset({"camera"}), RunSettings(looks="models"))


def test_the_cameras_of_a_run_show_the_looks_of_its_settings(
    tiny_instructions: Path, tiny_sites_folder: Path
) -> None:
    corpus = load_corpus([tiny_instructions], sites=tiny_sites_folder)
    first = corpus.episodes[0]
    arena = Arena(corpus.sites[first.instruction.site], looks="models")
    robot = arena.robot(
        first, SimulationSettings(), np.random.default_rng(0), on_event=lambda _: None
    )
    with pytest.raises(SettingsError, match="memorymaze sites models"):
        robot.camera_picture(32, 24)
