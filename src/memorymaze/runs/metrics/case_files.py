"""Files of metric cases: an agent's path beside the reference path it is scored against.

Cases stand alone: what is wrong with one is said in its line and does not touch the
others.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, cast

from pydantic import BaseModel, Field, StrictStr, ValidationError

from memorymaze.basics.errors import CaseFileError, UndefinedMetricError, did_you_mean
from memorymaze.basics.input_files import mistakes, parse_json, read_text
from memorymaze.runs.metrics.graph import WeightedGraph
from memorymaze.runs.metrics.score import score_path

_Metres = Annotated[float, Field(strict=True, allow_inf_nan=False)]

CASE_LISTS = ("cases", "undefined_cases")
_KINDS: dict[type, str] = {
    dict: "an object",
    list: "a list",
    str: "a text",
    bool: "a boolean",
}


class _Case(BaseModel):
    id: StrictStr
    graph: StrictStr
    """Name of one of the file's graphs."""
    reference_path: list[StrictStr]
    """Node ids; the last is the goal."""
    agent_path: list[StrictStr]
    """Node ids."""
    threshold: _Metres
    """Success distance."""


class _Graph(BaseModel):
    nodes: dict[str, Any]
    """Coordinates by node id; they are not used, distances are those of edges."""
    edges: list[tuple[StrictStr, StrictStr, _Metres]]
    """Two node ids and a length in metres."""


def score_cases(path: str | Path) -> Iterator[dict[str, Any]]:
    """Yield a record for each case of a file: its id and the eight metrics.

    A case whose metrics are undefined has its id and `error`.
    """
    content = _read(path)
    graphs = _Graphs(content["graphs"])
    for name in CASE_LISTS:
        for index, case in enumerate(content.get(name, [])):
            yield _scored(f"{name}[{index}]", case, graphs)


def _read(path: str | Path) -> dict[str, Any]:
    """Return the content of a file of cases, checked as far as all cases need it."""
    try:
        content = parse_json(read_text(path, CaseFileError))
    except ValueError as error:
        raise CaseFileError(f"{path}: {error}") from None
    if not isinstance(content, dict):
        raise CaseFileError(
            f"{path}: expected a JSON object with `graphs` and `cases`, got "
            f"{_kind(content)}"
        )
    members = cast(dict[str, Any], content)
    for name, kind in (("graphs", dict), ("cases", list), ("undefined_cases", list)):
        if name not in members and name != "undefined_cases":
            raise CaseFileError(f"{path}: expected a member `{name}`, found none")
        if name in members and not isinstance(members[name], kind):
            raise CaseFileError(
                f"{path}: expected `{name}` to be {_KINDS[kind]}, got "
                f"{_kind(members[name])}"
            )
    if not any(members.get(name) for name in CASE_LISTS):
        raise CaseFileError(f"{path}: expected at least one case, found none")
    return members


def _kind(value: object) -> str:
    return "null" if value is None else _KINDS.get(type(value), "a number")


def _scored(place: str, case: object, graphs: "_Graphs") -> dict[str, Any]:
    known = cast(dict[str, Any], case) if isinstance(case, dict) else {}
    line: dict[str, Any] = {"id": known.get("id")}
    try:
        record = _Case.model_validate(case)
        graph = graphs.graph(record.graph)
        values = score_path(
            graph, record.reference_path, record.agent_path, record.threshold
        )
    except ValidationError as error:
        return line | {"error": _first_problem(place, error)}
    except (CaseFileError, UndefinedMetricError) as error:
        return line | {"error": str(error)}
    return line | values.as_dict()


class _Graphs:
    """The graphs of a file, each checked and built when a case first needs it."""

    def __init__(self, records: dict[str, Any]) -> None:
        self._records = records
        self._built: dict[str, WeightedGraph | CaseFileError] = {}

    def graph(self, name: str) -> WeightedGraph:
        """Return a graph."""
        if name not in self._built:
            self._built[name] = self._build(name)
        built = self._built[name]
        if isinstance(built, CaseFileError):
            raise built
        return built

    def _build(self, name: str) -> WeightedGraph | CaseFileError:
        if name not in self._records:
            hint = did_you_mean(name, self._records)
            return CaseFileError(f"unknown graph {name!r}{hint}")
        try:
            record = _Graph.model_validate(self._records[name])
            return WeightedGraph(record.nodes, record.edges)
        except ValidationError as error:
            return CaseFileError(_first_problem(f"graphs[{name!r}]", error))
        except UndefinedMetricError as error:
            return CaseFileError(f"graphs[{name!r}]: {error}")


def _first_problem(place: str, error: ValidationError) -> str:
    where, said = next(mistakes(error))
    return f"{place}{where and '.'}{where}: {said}"
