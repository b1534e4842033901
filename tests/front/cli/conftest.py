"""The command line in this process, and files for it."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from memorymaze.front.cli.main import run_command_line


class Said(NamedTuple):
    """What a command left."""

    code: int
    out: str
    err: str


@pytest.fixture
def memorymaze(capsys: pytest.CaptureFixture[str]) -> Callable[..., Said]:
    """Run a command; say its exit code, stdout and stderr."""

    def run(*arguments: str | Path) -> Said:
        try:
            code = run_command_line([str(argument) for argument in arguments])
        except SystemExit as left:
            code = int(left.code or 0)
        return Said(code, *capsys.readouterr())

    return run
