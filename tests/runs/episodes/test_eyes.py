"""Runs with other eyes: chosen by name, kept in `run.json`, told above tables."""

from pathlib import Path

import numpy as np
import pytest

from memorymaze.basics.errors import DetectorError, SettingsError
from memorymaze.robot.perception.error_model import ErrorModel
from memorymaze.robot.perception.eyes import (
    TRUTH,
    DetectorSettings,
    parse_detector,
)
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.arena import Arena, looks_of_run
from memorymaze.runs.episodes.in_words import sense_notes
from memorymaze.runs.episodes.navigation import navigate
from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.episodes.trace_entries import CallEntry
from memorymaze.texts.corpus import load_corpus
from memorymaze.world.sites import Site


class Looker:
    """Looks for doors while it walks ahead."""

    name = "looker"

    def follow(self, instruction, robot, journal, rng) -> None:
        for _ in range(12):
            robot.detect_from_RGB_image("door")
            robot.read_signs()
            robot.move_forward(1.0)


@pytest.fixture
def walk(corridor_site: Site):
    """Let the looker walk with some detector; returns the episode's run."""

    def run(detector: DetectorSettings, seed: int = 0):
        route = corridor_site.find_route("R1")
        settings = RunSettings(seed=seed, detector=detector)
        return navigate(corridor_site, route, "Go.", Looker(), settings)

    return run


def looks(run) -> list[object]:
    return [entry.result for entry in run.trace if isinstance(entry, CallEntry)]


def test_mistakes_depend_on_the_seed_alone_and_leave_the_wheels_alone(walk):
    wrong = DetectorSettings(errors=ErrorModel(miss=0.5, phantoms=0.5))

    assert looks(walk(wrong)) == looks(walk(wrong))
    assert looks(walk(wrong)) != looks(walk(wrong, seed=1))
    assert looks(walk(wrong)) != looks(walk(TRUTH))
    assert walk(wrong).trajectory == walk(TRUTH).trajectory


def test_a_detector_that_fails_is_not_the_agents_crash(
    corridor_site, walk, monkeypatch
):
    def fail(self, view, query):
        raise DetectorError("detector at http://x answered 503")

    monkeypatch.setattr(
        "memorymaze.robot.perception.detector.TruthDetector.detect", fail
    )
    result = walk(TRUTH).result

    assert result.stopped_by == "model_error"
    assert "answered 503" in result.error


def test_eyes_that_cannot_be_had_are_found_out_before_the_run(tmp_path: Path):
    missing = DetectorSettings("grounding-dino", checkpoint=str(tmp_path / "none"))

    with pytest.raises(SettingsError, match="no such folder"):
        plan_run(AgentSettings("stop"), settings=RunSettings(detector=missing))


def test_notes_say_which_eyes_a_run_had():
    plan = plan_run(AgentSettings("stop"), settings=RunSettings(limit=1))
    assert not [*sense_notes(plan.settings, [])]

    wrong = plan_run(
        AgentSettings("stop"),
        settings=RunSettings(limit=1, detector=parse_detector("truth:miss=0.3")),
    )
    [note] = sense_notes(wrong.settings, [])
    assert "DETECTOR truth:miss=0.3" in note


def test_episodes_without_eyes_of_their_own_know_the_truth(corridor_site: Site):
    arena = Arena(corridor_site)

    assert arena.eyes.detector == TRUTH
    assert arena.eyes.signs == "truth"


def test_tables_name_the_eyes_beside_the_method(tmp_path: Path):
    from memorymaze.runs.tables import load_runs
    from memorymaze.runs.work.driver import run_plan

    plan = plan_run(
        AgentSettings("stop"),
        settings=RunSettings(limit=1, detector=parse_detector("truth:errors")),
    )
    run_plan(plan, tmp_path / "run", workers=1)

    [run] = load_runs([tmp_path / "run"])
    assert run.label == "stop, detector with mistakes"
    assert run.record.settings.detector == plan.settings.detector


def test_runs_without_cameras_do_not_depend_on_looks() -> None:
    guide, oracle = AgentSettings("guide"), AgentSettings("oracle")
    assert looks_of_run(guide, frozenset(), RunSettings()) is None
    assert looks_of_run(oracle, frozenset({"answers"}), RunSettings()) is None


def test_runs_with_cameras_say_what_these_show() -> None:
    own, guide = AgentSettings("mine.py:Mine"), AgentSettings("guide")
    assert looks_of_run(own, frozenset({"camera"}), RunSettings()) == "own"
    assert looks_of_run(guide, frozenset(), RunSettings(signs="ocr")) == "own"


def test_an_agent_of_ones_own_that_declares_nothing_may_look_too() -> None:
    own = AgentSettings("mine.py:Mine")
    assert looks_of_run(own, frozenset(), RunSettings()) == "own"
    assert looks_of_run(own, frozenset({"steps"}), RunSettings()) is None


def test_looks_that_are_not_there_are_refused_before_the_run() -> None:
    with pytest.raises(SettingsError, match=r"got 'old\.glb', which is no file here"):
        looks_of_run(
            AgentSettings("navid"), frozenset({"camera"}), RunSettings(looks="old.glb")
        )


def test_the_cameras_of_a_run_show_the_looks_of_its_settings(
    tiny_instructions: Path, tiny_sites_folder: Path
) -> None:
    corpus = load_corpus([tiny_instructions], sites=tiny_sites_folder)
    first = corpus.episodes[0]
    arena = Arena(corpus.sites[first.instruction.site], looks="old.glb")
    robot = arena.robot(
        first, SimulationSettings(), np.random.default_rng(0), on_event=lambda _: None
    )
    with pytest.raises(SettingsError, match=r"got 'old\.glb', which is no file here"):
        robot.camera_picture(32, 24)
