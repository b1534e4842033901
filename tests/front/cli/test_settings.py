"""The settings of runs, listed and written."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from memorymaze.runs.episodes.named_settings import SETTINGS
from memorymaze.runs.work.run_folder import read_run

Memorymaze = Callable[..., Any]


def test_every_setting_is_listed_as_it_is_given(memorymaze: Memorymaze) -> None:
    said = memorymaze("settings").out
    listed = re.findall(r"^  --(?:with )?([a-z-_]+)[ =]", said, flags=re.MULTILINE)
    assert sorted(name.replace("-", "_") for name in listed) == sorted(SETTINGS)
    assert "  --with retries=4\n        Further attempts where a server" in said
    assert "  --max-cost none\n" in said


def test_some_settings_are_listed_alone(memorymaze: Memorymaze) -> None:
    said = memorymaze("settings", "turning-points", "seed").out
    assert said.count("  --") == 2
    wrong = memorymaze("settings", "turning_pints")
    assert wrong.code == 2
    assert "did you mean 'turning_points'" in wrong.err


def test_the_settings_of_a_run_make_the_same_run(
    memorymaze: Memorymaze, tiny_files: list[str], tmp_path: Path
) -> None:
    command = ["evaluate", "--agent", "stop", *tiny_files, "--workers", "1"]
    command += ["--out", tmp_path / "run"]
    first = [*command, "--limit", "2", "--obstacles", "--with", "max_speed=0.8"]
    assert memorymaze(*first).code == 0
    file = tmp_path / "settings.toml"
    file.write_text(memorymaze("settings", "--of", tmp_path / "run").out, "utf-8")
    again = memorymaze(*command, "--settings", file, "--resume")
    assert again.code == 0, again.err
    other = memorymaze(*command, "--settings", file, "--seed", "5", "--resume")
    assert "seed: 0 there, 5 here" in other.err
    assert read_run(tmp_path / "run")[0].settings.limit == 2
