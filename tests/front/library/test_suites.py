"""Several runs into one folder, and their tables, as a file says."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.front.cli.main import run_command_line
from memorymaze.front.library.suites import read_suite
from memorymaze.runs.episodes.agent_catalogue import choose_agent
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.runs.work.run_folder import read_run

PROJECT = Path(__file__).parents[3]
SHIPPED = sorted((PROJECT / "examples" / "suites").glob("*.toml"))

SUITE = """
tables = ["II", "compare"]

[defaults]
instructions = {texts}
sites = {sites}
limit = 4

[[runs]]
name = "nowhere"
agent = "stop"

[[runs]]
name = "perfect"
agent = "oracle"
seed = 3
obstacles = "none"

[absent]
nobody = "ask somebody"
"""


@pytest.fixture
def suite(
    tiny_sites_folder: Path, tiny_instructions: Path, tmp_path: Path
) -> Callable[[str], Path]:
    """Write a suite on the tiny sites, with more beneath."""

    def write(more: str = "") -> Path:
        text = SUITE.format(
            texts=json.dumps(str(tiny_instructions)),
            sites=json.dumps(str(tiny_sites_folder)),
        )
        path = tmp_path / "suite.toml"
        path.write_text(text + more, encoding="utf-8")
        return path

    return write


def run(path: Path, out: Path, *options: str) -> int:
    return run_command_line([
        *("evaluate", "--suite", str(path), "--out", str(out), "--workers", "1"),
        *options,
    ])


def test_a_suite_runs_into_one_folder_and_shows_its_tables(
    suite: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    assert run(suite(), out) == 0
    said = capsys.readouterr().out
    assert "nobody (not recorded)" in said
    assert "perfect" in said
    settings = {
        name: read_run(out / name)[0].settings for name in ("nowhere", "perfect")
    }
    assert {name: each.limit for name, each in settings.items()} == {
        "nowhere": 4,
        "perfect": 4,
    }
    assert {name: each.seed for name, each in settings.items()} == {
        "nowhere": 0,
        "perfect": 3,
    }
    tables = {each.name for each in out.glob("*.csv")}
    assert tables == {"II.csv", "compare.csv"}
    lines = (out / "perfect" / "episodes.jsonl").read_bytes()
    assert run(suite(), out) == 1
    assert "add --resume" in capsys.readouterr().err
    assert run(suite(), out, "--resume") == 0
    assert (out / "perfect" / "episodes.jsonl").read_bytes() == lines


def test_the_command_line_wins_over_a_suite(
    suite: Callable[..., Path], tmp_path: Path
) -> None:
    assert (
        run(suite(), tmp_path / "out", "--limit", "2", "--with", "wheel_noise=0") == 0
    )
    _, results = read_run(tmp_path / "out" / "perfect")
    assert len(results) == 2


def test_a_run_that_fails_does_not_lose_the_others(
    suite: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = '\n[[runs]]\nname = "broken"\nagent = "nobody.py:Nobody"\n'
    path = suite()
    text = path.read_text("utf-8").replace("\n[[runs]]", broken + "\n[[runs]]", 1)
    path.write_text(text, encoding="utf-8")
    assert run(path, tmp_path / "out") == 1
    said = capsys.readouterr()
    assert "memorymaze: run broken: " in said.err
    assert "oracle" in said.out
    assert len(read_run(tmp_path / "out" / "perfect")[1]) == 4


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('agent = "oracle"', "agent = 3", r":15: field 'runs\[1\].agent': expected"),
        ('name = "perfect"', 'name = "nowhere"', "expected names that differ"),
        (
            'name = "perfect"',
            'name = "guide v2"',
            r"'runs\[1\].name': expected letters, digits, _ and -, got 'guide v2'",
        ),
        ('tables = ["II", "compare"]', 'tables = ["IV"]', ":2: .*got 'IV'"),
        ("seed = 3", "sed = 3", ":16: sed: expected the name of a setting.*'seed'"),
        ("seed = 3", 'seed = "x"', ":16: seed: expected a whole number, got 'x'"),
        ("limit = 4", "limit = 4\nspeed = 1", ":8: speed: expected the name"),
        ("[absent]", "[absentees]", ":19: .*'absent'"),
    ],
)
def test_what_a_suite_says_wrong_is_told_with_its_line(
    suite: Callable[..., Path], old: str, new: str, said: str
) -> None:
    path = suite()
    path.write_text(path.read_text("utf-8").replace(old, new), encoding="utf-8")
    with pytest.raises(SettingsError, match=said):
        read_suite(path)


def test_a_suite_says_which_agents_run(
    suite: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(suite(), tmp_path / "out", "--set", "x=1") == 2
    assert "--set: stands in the file of a suite" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_every_shipped_suite_has_agents_with_such_options(path: Path) -> None:
    read = read_suite(path)
    chosen: list[Any] = [
        choose_agent(AgentSettings(each.agent, each.options)) for each in read.runs
    ]
    assert len(chosen) >= 8
    asked = [each.answered_in for each in read.runs if each.answered_in is not None]
    assert all(answers.is_file() for answers in asked)


@pytest.mark.proof
def test_texts_are_those_that_a_file_answers_and_only_who_asks_is_given_a_model(
    tmp_path: Path,
) -> None:
    recorded = PROJECT / "examples" / "recorded"
    path = tmp_path / "suite.toml"
    path.write_text(
        'tables = ["II"]\n[defaults]\nlimit = 1\n'
        f"instructions = {{answered_in = {json.dumps(str(recorded / 'navgpt.jsonl'))}}}\n"
        '[[runs]]\nname = "stop"\nagent = "stop"\n'
        '[[runs]]\nname = "asks"\nagent = "code_generation"\n',
        encoding="utf-8",
    )
    answers = recorded / "programs_without_parser.jsonl"
    assert run(path, tmp_path / "out", "--replay", str(answers)) == 0
    written = (tmp_path / "out" / "texts-navgpt.jsonl").read_text("utf-8").splitlines()
    texts = [json.loads(line) for line in written]
    assert len({(each["study"], each["site"], each["route"]) for each in texts}) == 12
    models = {
        name: read_run(tmp_path / "out" / name)[0].settings.agent.language_model
        for name in ("stop", "asks")
    }
    assert models["stop"].replay is None
    assert models["asks"].replay == str(answers)


def test_runs_on_other_texts_have_the_texts_they_share_in_common_under_a_limit(
    suite: Callable[..., Path], tiny_instructions: Path, tmp_path: Path
) -> None:
    lines = tiny_instructions.read_text("utf-8").splitlines()
    at_the_end = [line for line in lines if '"corridor"' in line][-1]
    (tmp_path / "few.jsonl").write_text(f"{at_the_end}\n", encoding="utf-8")
    few = '\n[[runs]]\nname = "few"\nagent = "stop"\ninstructions = "few.jsonl"\n'
    path = suite()
    text = path.read_text("utf-8").replace("\n[absent]", few + "\n[absent]")
    path.write_text(text, encoding="utf-8")
    out = tmp_path / "out"
    assert run(path, out, "--limit", "2") == 0
    followed = {
        name: {each.episode_id for each in read_run(out / name)[1]}
        for name in ("nowhere", "perfect", "few")
    }
    assert followed["nowhere"] == followed["perfect"] > followed["few"]
    assert (len(followed["nowhere"]), len(followed["few"])) == (2, 1)
    assert ",few," in (out / "compare.csv").read_text("utf-8")
