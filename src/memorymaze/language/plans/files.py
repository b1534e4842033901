"""Route plans as JSON: one plan as a record, many as lines of a file.

Every key that is null, false, 0 or empty is left out when written, and may be left out
of what is read; `legs`, `arrival`, and the `kind` and `place` of a thing are always
written. A thing read without them is an object somewhere along the stretch.
"""

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path
from typing import Any, cast

from pydantic import TypeAdapter, ValidationError

from memorymaze.basics.errors import PlanFileError, did_you_mean
from memorymaze.basics.input_files import PROBLEMS_SHOWN, parse_json, read_text
from memorymaze.language.plans.records import Passing, RoutePlan

ALWAYS = frozenset({"legs", "arrival", "kind", "place"})
"""Keys that are written even where they have their default."""
KEYS = {"from_": "from"}
"""Keys of fields whose names are words of Python."""


@cache
def _checker() -> TypeAdapter[RoutePlan]:
    return TypeAdapter(RoutePlan)


def parse_plan(record: object, where: str) -> RoutePlan:
    """Return the plan that a JSON record holds.

    Args:
        record: What JSON gave.
        where: What it comes from, for the message.

    Raises:
        PlanFileError: It is no plan; names each field, what was expected and what came.
    """
    try:
        return _checker().validate_json(json.dumps(record))
    except ValidationError as error:
        raise PlanFileError(f"{where}: {_explained(error)}") from None


def plan_record(plan: RoutePlan) -> dict[str, Any]:
    """Return the JSON record of a plan, which `parse_plan` reads back."""
    return _record(plan)


def load_plans(path: str | Path) -> dict[str, RoutePlan]:
    """Read a file of plans, one `{"id": …, "plan": {…}}` a line.

    Returns:
        Plans by the ids of the instructions that they were read from, in order.

    Raises:
        PlanFileError: It cannot be read, or a line is no plan or repeats an id.
    """
    plans: dict[str, RoutePlan] = {}
    lines = read_text(path, PlanFileError).splitlines()
    for number, line in enumerate(lines, start=1):
        where = f"{path}:{number}"
        if not line.strip():
            continue
        try:
            record = parse_json(line)
        except ValueError as error:
            raise PlanFileError(f"{where}: {error}") from None
        if not isinstance(record, dict) or set(cast(Any, record)) != {"id", "plan"}:
            raise PlanFileError(
                f'{where}: expected a record {{"id": …, "plan": …}}, got {line[:60]}'
            )
        name, plan = cast(dict[str, Any], record).values()
        if not isinstance(name, str) or not name.strip() or name in plans:
            raise PlanFileError(
                f"{where}: field 'id': expected a non-empty text that no line above "
                f"has, got {name!r}"
            )
        plans[name] = parse_plan(plan, f"{where}: plan of {name}")
    return plans


def plan_lines(plans: Mapping[str, RoutePlan]) -> str:
    """Return the content of a file of plans, by the ids of their instructions."""
    return "".join(
        json.dumps({"id": name, "plan": plan_record(plan)}, ensure_ascii=False) + "\n"
        for name, plan in plans.items()
    )


def _record(value: object) -> dict[str, Any]:
    record: dict[str, Any] = {}
    for field in fields(cast(Any, value)):
        content = getattr(value, field.name)
        if content != field.default or field.name in ALWAYS:
            record[KEYS.get(field.name, field.name)] = _plain(content)
    if isinstance(value, Passing) and not record:
        record["count"] = None
    return record


def _plain(value: object) -> object:
    if isinstance(value, tuple):
        return [_plain(each) for each in cast(tuple[object, ...], value)]
    if is_dataclass(value):
        return _record(value)
    if isinstance(value, float) and value.is_integer():
        return int(value)
    return value


def _explained(error: ValidationError) -> str:
    """Return what is wrong, one part for each field, the first few in full."""
    problems = [dict(each) for each in error.errors()]
    told = [_one_explained(each) for each in problems[:PROBLEMS_SHOWN]]
    more = len(problems) - PROBLEMS_SHOWN
    return "; ".join([*told, *([f"and {more} more"] if more > 0 else [])])


def _one_explained(problem: dict[str, Any]) -> str:
    *parents, name = problem["loc"] or ("",)
    place = ".".join(str(each) for each in problem["loc"])
    field = f"field {place!r}: " if place else ""
    if problem["type"] == "unexpected_keyword_argument":
        known = _keys_at(parents)
        return (
            f"{field}expected one of {', '.join(known)}, got {name!r}"
            f"{did_you_mean(name, known)}"
        )
    if problem["type"] == "json_invalid":
        # JSON it is: Python read it, which takes what no file could hold.
        return f"expected whole characters, and fewer brackets, got {problem['msg']}"
    if problem["type"] == "missing":
        return f"{field}expected it, got nothing"
    expected = (
        problem["msg"].removeprefix("Value error, ").removeprefix("Input should ")
    )
    got = json.dumps(problem["input"], ensure_ascii=False, default=repr)
    return f"{field}expected it to {expected}, got {got[:60]}"


def _keys_at(parents: list[str | int]) -> list[str]:
    """Return the keys of the record at a place."""
    schema = _checker().json_schema()
    here: dict[str, Any] = schema
    for step in parents:
        here = here["items"] if isinstance(step, int) else here["properties"][step]
        options = [here, *here.get("anyOf", ())]
        found = next((each for each in options if "$ref" in each), None)
        if found is not None:
            here = schema["$defs"][found["$ref"].rpartition("/")[2]]
    return list(here["properties"])
