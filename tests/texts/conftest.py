"""Instructions and lines of files for the tests of this room."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from memorymaze.texts.corpus import Failure, Followers, Instruction


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


@pytest.fixture
def told() -> list[Instruction]:
    """Four texts on two tiny sites, in two splits, with all that a record can hold."""
    plain = Instruction(
        id="a-1",
        site="loop",
        route="R1",
        participant="a",
        text="Turn left, then stop.",
        reference_route="route_r1_reference",
    )
    return [
        plain,
        replace(
            plain,
            id="b-2",
            study="onsite",
            iteration=2,
            text='Um, "left"…\nthen, well, NA',
            failures=(Failure("missing_turn", "tp_1", "says one turn"),),
            original_text="Links,\tdann",
        ),
        replace(plain, id="c", split="dev", reference_route="route_r1_alternative"),
        replace(plain, id="d", site="t_junction", followers=Followers(True, 6, None)),
    ]
