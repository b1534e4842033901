"""Every setting by its name, on the command line and in files."""

from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.front.cli.agent_options import agent_settings, episode_settings
from memorymaze.front.cli.main import command_line
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.named_settings import (
    SETTINGS,
    model_settings,
    read_settings,
    run_settings,
    settings_file,
)
from memorymaze.runs.episodes.settings import RunDefinition, RunSettings

OTHERS = {
    "ask": "2",
    "base_url": "http://localhost:1/v1",
    "budget_by": "longest",
    "call_budget": "50",
    "control_period": "0.1",
    "detection_range": "40",
    "detector": "truth:errors",
    "grammar": "vllm",
    "inference_time": "start=0.5,prompt=2000,reply=60",
    "isolate": "true",
    "limit": "6",
    "looks": "own",
    "max_acceleration": "1.25",
    "max_cost": "5",
    "max_requests": "3",
    "max_speed": "0.8",
    "max_tokens_total": "1000",
    "max_turn_acceleration": "3",
    "max_turn_rate": "1.5",
    "model": "gpt-4o-mini",
    "motion": "kinematic",
    "noise": "heavy,lidar_range_noise=0.02",
    "obstacles": "heavy,seed=3,kinds=cart+suitcase",
    "passers_by": "wrong",
    "price": "0.15,0.6",
    "record": "replies.store",
    "replay": "earlier replies.store",
    "request_timeout": "30",
    "retries": "0",
    "robot": "examples/own_robot.py:in_site",
    "rolling_speed": "0.25",
    "sampling_period": "0.5",
    "second_telling": "true",
    "seed": "7",
    "shard": "2/8",
    "signs": "ocr",
    "split": "held_out",
    "stuck_limit": "20",
    "success_distance": "2.5",
    "threads": "2",
    "time_budget": "90",
    "turning_points": "lidar",
    "wall_limit": "60",
    "wheel_noise": "0.02",
}
"""Another value than the default for every setting."""


def test_every_setting_has_another_value_here() -> None:
    assert OTHERS.keys() == SETTINGS.keys()


def _read(*arguments: str) -> tuple[RunSettings, ModelSettings]:
    options = command_line().parse_args([
        *("evaluate", "--agent", "code_generation", *arguments)
    ])
    run = episode_settings(options, RunSettings())
    return run, agent_settings(options).language_model


def _value(settings: tuple[RunSettings, ModelSettings], name: str) -> object:
    run, model = settings
    owners = {ModelSettings: model, SimulationSettings: run.simulation}
    return getattr(owners.get(SETTINGS[name], run), name)


NEEDED = {"passers_by": "ask", "max_cost": "price"}
"""What cannot be said alone."""


@pytest.mark.parametrize("name", OTHERS)
def test_every_setting_is_given_by_its_name_or_in_a_file(
    name: str, tmp_path: Path
) -> None:
    names = [name, *filter(None, [NEEDED.get(name)])]
    pairs = [part for each in names for part in ("--with", f"{each}={OTHERS[each]}")]
    by_name = _read(*pairs)
    assert _value(by_name, name) != _value(_read(), name)
    file = tmp_path / "settings.toml"
    lines = [f'{each.replace("_", "-")} = "{OTHERS[each]}"\n' for each in names]
    file.write_text("".join(lines), encoding="utf-8")
    assert _read("--settings", str(file)) == by_name


def test_numbers_and_truth_need_no_quotes_in_a_file(tmp_path: Path) -> None:
    file = tmp_path / "settings.toml"
    file.write_text(
        "limit = 6\nisolate = true\nprice = [0.15, 0.6]\n", encoding="utf-8"
    )
    run, model = _read("--settings", str(file))
    assert (run.limit, run.isolate, str(model.price)) == (6, True, "0.15,0.6")


def test_the_command_line_wins_over_a_file(tmp_path: Path) -> None:
    file = tmp_path / "settings.toml"
    file.write_text(
        'seed = 1\nobstacles = "heavy"\nmax_speed = 0.5\n', encoding="utf-8"
    )
    options = ["--settings", str(file), "--seed", "2", "--with", "obstacles=none"]
    run, _ = _read(*options)
    assert (run.seed, run.obstacles, run.simulation.max_speed) == (2, None, 0.5)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("max_sped = 1", ":2: max_sped: expected the name of a setting.*'max_speed'"),
        ("max_speed = 'fast'", ":2: max_speed: expected a number, got 'fast'"),
        ("max_speed = -1", ":2: robot setting max_speed: expected a number greater"),
        ("success-distance = 0", ":2: success distance: expected more than 0 metres"),
        ("obstacles = 'few'", ":2: obstacles: expected a level"),
        ("retries = -1", ":2: retries: expected a whole number of at least 0"),
        ("limit = {a = 1}", ":2: limit: expected a text, a number, true or false"),
        ("limit 1", "expected TOML, got a mistake: .*line 2"),
    ],
)
def test_what_a_file_says_wrong_is_told_with_its_line(
    text: str, said: str, tmp_path: Path
) -> None:
    file = tmp_path / "settings.toml"
    file.write_text(f"# of the laboratory\n{text}\n", encoding="utf-8")
    with pytest.raises(SettingsError, match=said) as caught:
        _read("--settings", str(file))
    assert str(caught.value).startswith(str(file))


def test_the_settings_of_a_run_are_a_file_that_gives_the_same(
    settings: RunDefinition, tmp_path: Path
) -> None:
    given_all = _read(
        *(
            part
            for name, text in OTHERS.items()
            if name not in {"motion", "robot"}  # refused beside obstacles
            for part in ("--with", f"{name}={text}")
        )
    )
    for each, model in (given_all, (settings, settings.agent.language_model)):
        file = tmp_path / "settings.toml"
        file.write_text(settings_file(each, model), encoding="utf-8")
        given = read_settings(str(file))
        plain = RunSettings()
        again = run_settings(plain, given)
        for name, owner in SETTINGS.items():
            if owner is RunSettings:
                assert getattr(again, name) == getattr(each, name)
        # What the time budget of the simulation is, a run works out.
        budget = plain.simulation.time_budget
        assert again.simulation == replace(each.simulation, time_budget=budget)
        assert model_settings(given) == model
