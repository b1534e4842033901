"""What works where nothing but the package itself was installed, without any extra."""

import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from memorymaze.front.library.doctor import EXTRAS

Done = subprocess.CompletedProcess[str]
BasicInstall = Callable[..., Done]
BASIC = """
import sys
from importlib.machinery import PathFinder
from memorymaze.front.cli.main import run_command_line


class Basic(PathFinder):
    @classmethod
    def find_spec(cls, name, path=None, target=None):
        if name.partition(".")[0] in {extras}:
            return None
        return super().find_spec(name, path, target)


sys.meta_path = [Basic if each is PathFinder else each for each in sys.meta_path]
for command in {commands}:
    if code := run_command_line(command):
        sys.exit(code)
"""
PACKAGES = {package for _, packages, _ in EXTRAS for package in packages}


@pytest.fixture
def basic_install(tmp_path: Path) -> BasicInstall:
    """Run commands, one after the other, where no package of an extra can be found."""

    def run(*commands: Sequence[str | Path]) -> Done:
        typed = [list(map(str, command)) for command in commands]
        program = BASIC.format(extras=PACKAGES, commands=typed)
        return subprocess.run(
            [sys.executable, "-c", program],
            cwd=tmp_path,
            capture_output=True,
            text=True,
        )

    return run


def test_runs_tables_reports_walks_and_statistics_need_no_extra(
    basic_install: BasicInstall,
    tiny_files: list[str],
    tiny_instructions: Path,
    tiny_sites_folder: Path,
    tmp_path: Path,
) -> None:
    plan = tiny_sites_folder / "corridor.geojson"
    limits = ["--limit", "1", "--workers", "1"]
    done = basic_install(
        ["evaluate", "--agent", "guide", *tiny_files, *limits, "--out", "run"],
        ["table", "run", "--table", "both", "--format", "csv"],
        ["report", "run", "--out", "report"],
        ["navigate", plan, "R1", "Go straight ahead.", "--out", "walk"],
        ["sites", "check", plan],
        ["instructions", "stats", tiny_instructions, "--sites", tiny_sites_folder],
        ["doctor"],
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "report" / "index.html").is_file()
    assert done.stdout.count("missing  extra ") == len(EXTRAS)


@pytest.mark.parametrize(
    ("command", "package", "extra"),
    [
        ("sites film museum_5f R1 --out R1.mp4", "av", "video"),
        ("instructions export --format parquet --out out", "pyarrow", "tables"),
        ("instructions export --format hub --out out", "pyarrow", "tables"),
        ("instructions check texts.parquet", "pyarrow", "tables"),
        ("dataset make --frames --out out", "av", "tables,video"),
    ],
)
def test_what_needs_an_extra_says_what_to_install_and_makes_nothing(
    basic_install: BasicInstall, command: str, package: str, extra: str, tmp_path: Path
) -> None:
    (tmp_path / "texts.parquet").touch()
    done = basic_install(command.split())
    assert (done.returncode, done.stdout) == (2, "")
    assert f"the package {package} is not installed; type: " in done.stderr
    assert f"[{extra}]" in done.stderr
    assert [each.name for each in tmp_path.iterdir()] == ["texts.parquet"]
