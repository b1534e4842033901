"""What pages tell to type is understood, and the page on the command line has every verb."""

import argparse
import re
import shlex
import subprocess
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path

import pytest

from memorymaze.front.cli.main import command_line

PROJECT = Path(__file__).parents[1]
PAGES = (PROJECT / "README.md", *sorted((PROJECT / "docs").glob("*.md")))
COMMAND = re.compile(r"^ {4,}memorymaze ((?:.*\\\n)*.*)$", re.MULTILINE)


def commands_of(page: Path) -> list[list[str]]:
    """What stands behind `memorymaze`, without comments and what a shell does after it."""
    found = COMMAND.findall(page.read_text(encoding="utf-8"))
    words = [shlex.split(each.replace("\\\n", " "), comments=True) for each in found]
    ends = {"|", "&&", ">", "&"}
    return [list(takewhile(lambda word: word not in ends, each)) for each in words]


def verbs_of(parser: argparse.ArgumentParser) -> Iterator[tuple[str, ...]]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for name, below in action.choices.items():
                yield from [(name, *verbs) for verbs in verbs_of(below)] or [(name,)]


def parsers_of(parser: argparse.ArgumentParser) -> Iterator[argparse.ArgumentParser]:
    yield parser
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for below in action.choices.values():
                yield from parsers_of(below)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_command_of_a_page_is_one(
    page: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong: list[str] = []
    for command in commands_of(page):
        try:
            command_line().parse_args(command)
        except SystemExit as stop:
            if stop.code:
                wrong.append(f"{shlex.join(command)}: {capsys.readouterr().err}")
    assert wrong == []


def test_the_page_of_the_command_line_has_every_verb() -> None:
    told = commands_of(PROJECT / "docs" / "command_line.md")
    begun = {tuple(each[:words]) for each in told for words in (1, 2)}
    assert [verb for verb in verbs_of(command_line()) if verb not in begun] == []


def test_the_example_of_every_help_is_a_command(
    capsys: pytest.CaptureFixture[str],
) -> None:
    wrong: list[str] = []
    for parser in parsers_of(command_line()):
        example = (parser.epilog or "").removeprefix("example: ").partition(" (")[0]
        for command in example.split(" && "):
            program, *words = shlex.split(command)
            try:
                assert program == "memorymaze"
                command_line().parse_args(words)
            except SystemExit as stop:
                wrong.append(f"{command}: {stop.code} {capsys.readouterr().err}")
    assert wrong == []


def test_settings_of_the_second_table_are_for_the_run_asked_and_the_one_replayed() -> (
    None
):
    given = ["MODEL=m", "SETTINGS=--with inference_time=2"]
    told = subprocess.run(
        ["make", "--dry-run", "table-two", *given],
        cwd=PROJECT,
        capture_output=True,
        text=True,
        check=True,
    )
    runs = [line for line in told.stdout.splitlines() if " --suite " in line]
    assert ["--record" in line for line in runs] == [True, False]
    assert all("--with inference_time=2 " in line for line in runs)
