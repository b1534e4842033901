"""Instructions on the loop site, to be labelled."""

from collections.abc import Callable
from typing import Any

import pytest

from memorymaze.texts.corpus import Failure, Instruction
from memorymaze.texts.labels.labels import Label, text_stamp

REFERENCE = "route_r1_reference"


@pytest.fixture
def told() -> Callable[..., Instruction]:
    """Make an instruction on the loop site."""

    def make(name: str, **changes: Any) -> Instruction:
        fields: dict[str, Any] = {
            "id": name,
            "site": "loop",
            "route": "R1",
            "study": "onsite",
            "participant": name,
            "text": f"Turn right, says {name}.",
            "reference_route": REFERENCE,
        }
        return Instruction(**(fields | changes))

    return make


@pytest.fixture
def label() -> Callable[..., Label]:
    """Label an instruction of `told`: kinds of failures, and the way."""

    def make(
        annotator: str, instruction: str, *kinds: str, way: str = REFERENCE
    ) -> Label:
        failures = tuple(Failure(kind, "tp_nw", f"by {annotator}") for kind in kinds)
        stamp = text_stamp(f"Turn right, says {instruction}.")
        return Label(instruction, stamp, annotator, way, failures)

    return make
