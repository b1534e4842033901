from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.input_files import FileStamp, stamp_file
from memorymaze.robot.perception.error_model import ErrorModel
from memorymaze.robot.perception.eyes import DetectorSettings
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.settings import (
    Difference,
    RunDefinition,
    RunSettings,
    Shard,
    differences,
)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        pytest.param({"seed": -1}, "seed: expected a whole number", id="seed"),
        pytest.param({"seed": 0.5}, "got 0.5", id="half a seed"),
        pytest.param({"limit": 0}, "limit: expected", id="limit"),
        pytest.param({"success_distance": 0.0}, "more than 0 metres", id="distance"),
        pytest.param({"success_distance": float("nan")}, "got nan", id="nan"),
        pytest.param({"signs": "OCR"}, "one of truth, ocr; got 'OCR'", id="signs"),
    ],
)
def test_a_value_without_meaning_is_refused(
    settings: RunDefinition, changes: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        replace(settings, **changes)


@pytest.mark.parametrize(
    ("name", "text", "meant"),
    [
        ("seed", "7", 7),
        ("time_budget", "none", None),
        ("shard", "2/8", Shard(2, 8)),
        ("detector", "truth:errors", DetectorSettings(errors=ErrorModel())),
        ("signs", "ocr", "ocr"),
    ],
)
def test_settings_may_be_given_as_texts(name: str, text: str, meant: object) -> None:
    assert getattr(with_choices(RunSettings(), {name: text}), name) == meant


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("seed", "x", "setting seed: expected a whole number, got 'x'"),
        ("signs", "OCR", "setting signs: expected truth or ocr, got 'OCR'"),
        ("turning_points", "map", "expected annotated or lidar, got 'map'"),
        ("sede", "1", "did you mean 'seed'"),
    ],
)
def test_a_text_that_is_no_such_setting_is_refused(
    name: str, text: str, said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        with_choices(RunSettings(), {name: text})


def test_a_run_has_a_time_budget_that_its_file_can_hold(
    settings: RunDefinition,
) -> None:
    endless = replace(settings.simulation, time_budget=float("inf"))
    with pytest.raises(SettingsError, match="time budget: expected a finite number"):
        replace(settings, simulation=endless)


def test_a_time_budget_that_a_run_would_not_keep_is_refused() -> None:
    asked = SimulationSettings(time_budget=3, call_budget=50)
    with pytest.raises(SettingsError, match="got 3; give time_budget of RunSettings"):
        RunSettings(simulation=asked)
    kept = RunSettings(simulation=SimulationSettings(call_budget=50), time_budget=3)
    assert kept.simulation.call_budget == 50


def test_equal_settings_do_not_differ(settings: RunDefinition) -> None:
    assert differences(settings, replace(settings)) == []


def test_a_budget_given_in_seconds_differs_from_that_of_each_way(
    settings: RunDefinition,
) -> None:
    by_way = replace(settings, time_budget=None, budget_by="way")
    longest = settings.simulation.time_budget
    [difference] = differences(by_way, replace(by_way, time_budget=longest))
    assert str(difference) == f"time_budget: None there, {longest} here"


def test_one_more_site_is_a_difference(settings: RunDefinition) -> None:
    more = replace(settings, sites=(*settings.sites, FileStamp("annex", "ff")))
    assert differences(settings, more) == [
        Difference("site", "site annex", there=None, here="ff")
    ]


def test_a_stamp_depends_on_the_content_of_a_file(tmp_path: Path) -> None:
    path = tmp_path / "some.jsonl"
    path.write_bytes(b"one")
    first = stamp_file(path)
    path.write_bytes(b"two")
    assert first.name == stamp_file(path).name == "some.jsonl"
    assert first.sha256 != stamp_file(path).sha256


def test_files_of_one_name_are_told_apart(settings: RunDefinition) -> None:
    pair = (FileStamp("some.jsonl", "1"), FileStamp("some.jsonl", "2"))
    other = (FileStamp("some.jsonl", "3"), FileStamp("some.jsonl", "2"))
    [found] = differences(
        replace(settings, instructions=pair), replace(settings, instructions=other)
    )
    assert str(found) == "instructions[0]: 'some.jsonl 1' there, 'some.jsonl 3' here"


def test_an_agents_options_are_compared_by_name(settings: RunDefinition) -> None:
    def with_options(*pairs: tuple[str, str]) -> RunDefinition:
        return replace(settings, agent=replace(settings.agent, options=pairs))

    some = with_options(("max_tokens", "9"), ("seed", "1"))
    assert differences(some, with_options(("seed", "1"), ("max-tokens", "9"))) == []
    assert differences(some, with_options(("max_tokens", "8"))) == [
        Difference("agent option", "agent.options.max_tokens", "9", "8"),
        Difference("agent option", "agent.options.seed", "1", None),
    ]
