"""Plans as data, to be changed and written back."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Plan = dict[str, Any]


@pytest.fixture(scope="session")
def plan_texts(tiny_sites_folder: Path) -> dict[str, str]:
    """Contents of the tiny plans by name."""
    return {
        path.stem: path.read_text(encoding="utf-8")
        for path in sorted(tiny_sites_folder.glob("*.geojson"))
    }


@pytest.fixture
def plan(plan_texts: dict[str, str]) -> Callable[[str], Plan]:
    """Return a fresh copy of a tiny plan as parsed JSON."""
    return lambda name: json.loads(plan_texts[name])


@pytest.fixture
def write_plan(tmp_path: Path) -> Callable[..., Path]:
    """Write a plan to a file and return the path."""

    def write(content: Plan, stem: str = "changed") -> Path:
        path = tmp_path / f"{stem}.geojson"
        path.write_text(json.dumps(content), encoding="utf-8")
        return path

    return write


@pytest.fixture
def changed(
    plan: Callable[[str], Plan], write_plan: Callable[..., Path]
) -> Callable[[str, str, dict[str, Any]], Path]:
    """Change a tiny plan, write it under its own name, and return the path.

    Changes are values by dotted path inside the feature, or inside the plan where the
    feature is `-`; `...` removes a member.
    """

    def write(name: str, feature: str, changes: dict[str, Any]) -> Path:
        content = plan(name)
        for dotted, value in changes.items():
            target = content if feature == "-" else _feature(content, feature)
            *steps, last = (
                int(step) if step.isdecimal() else step for step in dotted.split(".")
            )
            for step in steps:
                target = target[step]
            if value is ...:
                del target[last]
            else:
                target[last] = value
        return write_plan(content, name)

    return write


@pytest.fixture
def enlarged(
    plan: Callable[[str], Plan], write_plan: Callable[..., Path]
) -> Callable[[str, float], Path]:
    """Write a tiny plan with all its positions multiplied, and return the path."""

    def write(name: str, factor: float) -> Path:
        content = plan(name)
        for feature in content["features"]:
            geometry = feature["geometry"]
            geometry["coordinates"] = _times(geometry["coordinates"], factor)
        return write_plan(content, name)

    return write


def _times(coordinates: Any, factor: float) -> Any:
    if isinstance(coordinates, list):
        return [_times(each, factor) for each in coordinates]
    return coordinates * factor


def _feature(content: Plan, identity: str) -> Plan:
    return next(each for each in content["features"] if each["id"] == identity)
