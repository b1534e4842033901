"""Instruction lines for the tests of this room."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture
def line() -> Callable[..., dict[str, Any]]:
    """Make one right line of an instruction file on the loop site."""

    def make(**changes: Any) -> dict[str, Any]:
        record: dict[str, Any] = {
            "id": "a-1",
            "site": "loop",
            "route": "R1",
            "study": "online",
            "iteration": 1,
            "participant": "a",
            "text": "Turn left, then stop.",
            "reference_route": "route_r1_reference",
            "failures": [],
            "source": "human",
            "language": "en",
            "split": "test",
        }
        return record | changes

    return make


@pytest.fixture
def instruction_file(tmp_path: Path) -> Callable[..., Path]:
    """Write records (or raw lines) to an instruction file."""

    def write(*lines: dict[str, Any] | str, name: str = "some.jsonl") -> Path:
        path = tmp_path / name
        texts = [one if isinstance(one, str) else json.dumps(one) for one in lines]
        path.write_text("\n".join(texts) + "\n", encoding="utf-8")
        return path

    return write
