"""A robot for programs to drive that lives nowhere."""

from collections.abc import Callable
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
