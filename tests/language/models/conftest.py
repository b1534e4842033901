"""A robot for programs to drive that lives nowhere."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture
def make_robot(make_paper_robot: Callable[..., Any]) -> Callable[..., Any]:
    """Makes robots that record their calls."""
    return make_paper_robot


@pytest.fixture
def robot(make_paper_robot: Callable[..., Any]) -> Any:
    """A robot that records its calls."""
    return make_paper_robot()


@pytest.fixture
def file(tmp_path: Path) -> Callable[..., Path]:
    """Write records, or lines, to a file."""

    def write(*records: Any, name: str = "answers.jsonl") -> Path:
        path = tmp_path / name
        lines = [r if isinstance(r, str) else json.dumps(r) for r in records]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return path

    return write
