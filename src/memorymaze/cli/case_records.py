"""Records of a file of metric cases, checked one by one."""

from typing import Annotated, Any

from pydantic import BaseModel, Field, StrictStr, ValidationError

from memorymaze.errors import CaseFileError, UndefinedMetricError, did_you_mean
from memorymaze.metrics.graph import NavigationGraph

Metres = Annotated[float, Field(strict=True, allow_inf_nan=False)]

SHOWN = 40
"""Characters of a wrong value that a message shows."""


class CaseRecord(BaseModel):
    """An agent's path beside the reference path it is scored against."""

    id: StrictStr
    graph: StrictStr
    """Name of one of the file's graphs."""
    reference_path: list[StrictStr]
    """Node ids; the last is the goal."""
    agent_path: list[StrictStr]
    """Node ids."""
    threshold: Metres
    """Success distance."""


class GraphRecord(BaseModel):
    """An undirected graph."""

    nodes: dict[str, Any]
    """Coordinates by node id; they are not used, distances are those of edges."""
    edges: list[tuple[StrictStr, StrictStr, Metres]]
    """Two node ids and a length in metres."""


class Graphs:
    """The graphs of a file, each checked and built when a case first needs it."""

    def __init__(self, records: dict[str, Any]) -> None:
        """Take the file's graphs by name, as JSON gave them."""
        self._records = records
        self._built: dict[str, NavigationGraph | CaseFileError] = {}

    def graph(self, name: str) -> NavigationGraph:
        """Return a graph.

        Raises:
            CaseFileError: There is none of this name, or it is wrong.
        """
        if name not in self._built:
            self._built[name] = self._build(name)
        built = self._built[name]
        if isinstance(built, CaseFileError):
            raise built
        return built

    def _build(self, name: str) -> NavigationGraph | CaseFileError:
        if name not in self._records:
            hint = did_you_mean(name, self._records)
            return CaseFileError(f"unknown graph {name!r}{hint}")
        try:
            record = GraphRecord.model_validate(self._records[name])
            return NavigationGraph(record.nodes, record.edges)
        except ValidationError as error:
            return CaseFileError(_first_problem(f"graphs[{name!r}]", error))
        except UndefinedMetricError as error:
            return CaseFileError(f"graphs[{name!r}]: {error}")


def read_case(place: str, case: object) -> CaseRecord:
    """Return a checked case.

    Raises:
        CaseFileError: Something is missing or of the wrong kind.
    """
    try:
        return CaseRecord.model_validate(case)
    except ValidationError as error:
        raise CaseFileError(_first_problem(place, error)) from None


def _first_problem(place: str, error: ValidationError) -> str:
    problem = error.errors(include_url=False)[0]
    steps = [
        f"[{part}]" if isinstance(part, int) else f".{part}" for part in problem["loc"]
    ]
    if problem["type"] == "missing":
        return f"{place}{''.join(steps[:-1])}: expected a member `{problem['loc'][-1]}`"
    if problem["type"] == "model_type":
        return f"{place}: expected an object"
    given = repr(problem["input"])
    shown = given if len(given) <= SHOWN else given[:SHOWN] + "..."
    return f"{place}{''.join(steps)}: {problem['msg'].lower()}, got {shown}"
