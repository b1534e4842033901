from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.errors import SettingsError
from memorymaze.evaluation.settings import RunDefinition, differences
from memorymaze.input_files import FileStamp, stamp_file


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        pytest.param({"seed": -1}, "seed: expected a whole number", id="seed"),
        pytest.param({"seed": 0.5}, "got 0.5", id="half a seed"),
        pytest.param({"limit": 0}, "limit: expected", id="limit"),
        pytest.param({"success_distance": 0.0}, "more than 0 metres", id="distance"),
        pytest.param({"success_distance": float("nan")}, "got nan", id="nan"),
    ],
)
def test_a_value_without_meaning_is_refused(
    settings: RunDefinition, changes: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        replace(settings, **changes)


def test_a_run_has_a_time_budget_that_its_file_can_hold(
    settings: RunDefinition,
) -> None:
    endless = replace(settings.simulation, time_budget=float("inf"))
    with pytest.raises(SettingsError, match="time budget: expected a finite number"):
        replace(settings, simulation=endless)


def test_equal_settings_do_not_differ(settings: RunDefinition) -> None:
    assert differences(settings, replace(settings)) == []


def test_one_more_site_is_a_difference(settings: RunDefinition) -> None:
    more = replace(settings, sites=(*settings.sites, FileStamp("annex", "ff")))
    assert differences(settings, more) == ["sites[1]: None there, 'annex ff' here"]


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
    assert differences(
        replace(settings, instructions=pair), replace(settings, instructions=other)
    ) == ["instructions[0]: 'some.jsonl 1' there, 'some.jsonl 3' here"]


def test_an_agents_options_are_compared_by_name(settings: RunDefinition) -> None:
    def with_options(*pairs: tuple[str, str]) -> RunDefinition:
        return replace(settings, agent=replace(settings.agent, options=pairs))

    some = with_options(("max_tokens", "9"), ("seed", "1"))
    assert differences(some, with_options(("seed", "1"), ("max-tokens", "9"))) == []
    assert differences(some, with_options(("max_tokens", "8"))) == [
        "agent.options.max_tokens: '9' there, '8' here",
        "agent.options.seed: '1' there, None here",
    ]
