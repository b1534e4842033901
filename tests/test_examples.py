"""The worked examples in docstrings are true, and the metrics have some."""

import doctest
import pkgutil
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest

import memorymaze


def has_examples(module: str) -> bool:
    spec = find_spec(module)
    assert spec is not None
    assert spec.origin is not None
    return ">>> " in Path(spec.origin).read_text(encoding="utf-8")


# Those of the control API are pieces of programs, which tests/language runs.
MODULES = [
    each.name
    for each in pkgutil.walk_packages(memorymaze.__path__, "memorymaze.")
    if has_examples(each.name)
    and each.name not in {"memorymaze.robot.api.control", "memorymaze.robot.api.asking"}
]


@pytest.mark.parametrize("module", MODULES)
def test_examples_in_docstrings_are_true(module: str) -> None:
    outcome = doctest.testmod(import_module(module))
    assert outcome.failed == 0
    assert outcome.attempted > 0


@pytest.mark.parametrize(
    "family", ["aggregate", "efficiency", "fidelity", "success", "turns"]
)
def test_every_family_of_metrics_has_examples(family: str) -> None:
    assert f"memorymaze.runs.metrics.{family}" in MODULES
