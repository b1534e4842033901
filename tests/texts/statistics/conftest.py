"""Instructions for the tests of this room."""

from collections.abc import Callable
from typing import Any

import pytest

from memorymaze.texts.corpus import Instruction


@pytest.fixture
def told() -> Callable[..., Instruction]:
    """Make an instruction on the loop site."""

    def make(text: str, **changes: Any) -> Instruction:
        fields: dict[str, Any] = {
            "id": f"a-{abs(hash(text))}",
            "site": "loop",
            "route": "R1",
            "participant": "a",
            "text": text,
            "reference_route": "route_r1_reference",
        }
        return Instruction(**(fields | changes))

    return make
