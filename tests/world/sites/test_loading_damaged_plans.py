"""Whatever is done to a plan, it loads or gives one clear error."""

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import SitePlanError
from memorymaze.world.sites import Site, find_site_problems, load_site

NUMBERS = st.one_of(
    st.floats(),
    st.integers(-(10**40), 10**40),
    st.sampled_from([0, -1, 0.001, 1e-9, 1e308, 90, 1_000_000_000]),
)
WORDS = st.one_of(
    st.text(st.characters(), max_size=5),
    st.sampled_from(["corridor", "area", "box", "tp_sw", "R2", "reference", "Polygon"]),
)
VALUES = st.recursive(
    st.one_of(st.none(), st.booleans(), NUMBERS, WORDS),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4), st.dictionaries(WORDS, inner, max_size=2)
    ),
    max_leaves=6,
)


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("plans") / "corrupted.geojson"


def _places(value: Any, place: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Return the ways to every member and item inside a document."""
    keys: Any = ()
    if isinstance(value, dict):
        keys = value.keys()
    elif isinstance(value, list):
        keys = range(len(value))
    inner = [found for key in keys for found in _places(value[key], (*place, key))]
    return [*([place] if place else []), *inner]


def _loads_or_fails_clearly(path: Path) -> None:
    problems = find_site_problems(path)
    lines = [problem.line() for problem in problems]
    assert not any("\n" in line for line in lines)
    assert "".join(lines).encode()
    outcome = _loaded_or_refused(path)
    if isinstance(outcome, Site):
        assert outcome.free_floor.area > 0
    else:
        assert outcome.startswith(f"{path}: ")
        assert "\n" not in outcome
        assert any(problem.severity == "error" for problem in problems)


def _loaded_or_refused(path: Path) -> Site | str:
    try:
        return load_site(path)
    except SitePlanError as error:
        return str(error)


@given(data=st.data())
def test_a_plan_with_changed_members_loads_or_fails_clearly(
    data: st.DataObject, plan_texts: dict[str, str], path: Path
):
    plan = json.loads(plan_texts[data.draw(st.sampled_from(["loop", "t_junction"]))])
    for _ in range(data.draw(st.integers(1, 3))):
        *steps, last = data.draw(st.sampled_from(_places(plan)))
        target = plan
        for step in steps:
            target = target[step]
        match data.draw(st.sampled_from(["replace", "shift", "remove", "double"])):
            case "shift" if isinstance(target[last], float | int):
                target[last] += data.draw(st.sampled_from([0.001, -0.3, 1, -5]))
            case "remove" if isinstance(target, dict) or len(target) > 1:
                del target[last]
            case "double" if isinstance(target, list):
                target.append(target[last])
            case _:
                target[last] = data.draw(VALUES)
    path.write_text(json.dumps(plan), encoding="utf-8")
    _loads_or_fails_clearly(path)


@given(cut=st.floats(0, 1), at=st.floats(0, 1), noise=st.binary(min_size=1, max_size=6))
def test_a_plan_with_changed_bytes_loads_or_fails_clearly(
    cut: float, at: float, noise: bytes, plan_texts: dict[str, str], path: Path
):
    text = plan_texts["corridor"].encode()
    place = int(at * len(text))
    content = text[:place] + noise + text[place + len(noise) :]
    path.write_bytes(content[: max(1, int(cut * len(content)))])
    _loads_or_fails_clearly(path)
    path.write_bytes(content)
    _loads_or_fails_clearly(path)
