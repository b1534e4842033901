"""Room-to-Room (R2R) files: paths on navigation graphs, several texts for each.

Format: Anderson et al. 2018, "Vision-and-Language Navigation" (CVPR).
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import (
    BaseModel,
    Field,
    FiniteFloat,
    TypeAdapter,
)

from memorymaze.basics.errors import InstructionFileError
from memorymaze.basics.geometry.polyline import resample
from memorymaze.texts.corpus.record_format import instruction_record
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.exchange.foreign_files import (
    OWN_FIELD,
    Unlabelled,
    by_split,
    own_or_new,
    read_as,
    site_called,
    split_of,
    write_json,
)
from memorymaze.world.sites.navigation_graph import (
    NavigationGraph,
    Viewpoint,
    navigation_graph,
)
from memorymaze.world.sites.records import Route, Site

STEP = 0.5
"""Metres between the places of the line that are compared with viewpoints."""
CHANGE = 0.05
"""Square metres that going on to the next viewpoint costs, so that none is visited for
nothing."""

Paths = Mapping[tuple[str, ...], list[tuple[Site, Route]]]


class _Item(BaseModel):
    path_id: int | str
    scan: str
    path: Annotated[list[str], Field(min_length=1)]
    instructions: Annotated[list[str], Field(min_length=1)]
    memorymaze: list[dict[str, Any]] | None = None
    heading: FiniteFloat = 0.0


_ITEMS = TypeAdapter(list[_Item])


def write_r2r(
    folder: str | Path, instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> list[Path]:
    """Write `R2R_SPLIT.json` for each split, and the graphs in `connectivity/`.

    One item is one reference route; its `instructions` are all that describe it. A
    path is the walk on the site's navigation graph that stays nearest to the route.
    What R2R has no place for is kept in the field `memorymaze`, one record per text.

    Args:
        folder: Where; made if need be.
        instructions: Whose sites and routes exist.
        sites: Sites by name.

    Returns:
        The files written.

    Raises:
        InstructionFileError: A file cannot be written.
    """
    folder = Path(folder)
    chosen = list(instructions)
    names = sorted({each.site for each in chosen})
    graphs = {name: navigation_graph(sites[name]) for name in names}
    files: list[Path] = []
    number = 0
    for split, members in by_split(chosen).items():
        groups: dict[tuple[str, str], list[Instruction]] = {}
        for each in members:
            groups.setdefault((each.site, each.reference_route), []).append(each)
        items: list[dict[str, Any]] = []
        for (site, route), group in groups.items():
            number += 1
            items.append(
                _item(number, graphs[site], sites[site].find_route(route), group)
            )
        files.append(folder / f"R2R_{split}.json")
        write_json(files[-1], items)
    for name, graph in graphs.items():
        files.append(folder / "connectivity" / f"{name}_connectivity.json")
        write_json(files[-1], graph.connectivity())
    return files


def read_r2r(
    paths: Sequence[str | Path],
    sites: Mapping[str, Site],
    labels: Unlabelled | None = None,
) -> list[Instruction]:
    """Read R2R files whose scans are sites and whose paths are routes of them.

    Args:
        paths: `R2R_SPLIT.json` files; also gzipped.
        sites: Sites by name.
        labels: For files that `write_r2r` has not written.

    Raises:
        InstructionFileError: A file is not in the format, a path is no route of its
            site, or labels are needed and not given.
    """
    routes = _routes_by_path(sites)
    read: list[Instruction] = []
    for path in map(Path, paths):
        for item in read_as(_ITEMS, path, "R2R items"):
            read += _instructions(item, path, sites, routes, labels)
    return read


def _item(
    number: int, graph: NavigationGraph, route: Route, group: list[Instruction]
) -> dict[str, Any]:
    path = viewpoints_along(graph, route.line.coords)
    return {
        "path_id": number,
        "scan": graph.site,
        "heading": _clockwise_from_north(route.start_heading),
        "path": [each.id for each in path],
        "distance": sum(math.dist(one[1:], two[1:]) for one, two in pairwise(path)),
        "instructions": [each.text for each in group],
        OWN_FIELD: [instruction_record(each) for each in group],
    }


def _routes_by_path(sites: Mapping[str, Site]) -> Paths:
    routes: dict[tuple[str, ...], list[tuple[Site, Route]]] = {}
    for site in sites.values():
        graph = navigation_graph(site)
        for route in site.routes:
            path = viewpoints_along(graph, route.line.coords)
            key = (site.name, *(each.id for each in path))
            routes.setdefault(key, []).append((site, route))
    return routes


def _instructions(
    item: _Item,
    path: Path,
    sites: Mapping[str, Site],
    routes: Paths,
    labels: Unlabelled | None,
) -> list[Instruction]:
    place = f"{path}: path_id {item.path_id}"
    site = site_called(item.scan, sites, place)
    kept = item.memorymaze or [None] * len(item.instructions)
    if len(kept) != len(item.instructions):
        raise InstructionFileError(
            f"{place}: expected {len(item.instructions)} records in field "
            f"{OWN_FIELD!r}, one per instruction, got {len(kept)}"
        )
    found = routes.get((item.scan, *item.path))
    if found is None:
        known = ", ".join(route.id for route in site.routes)
        raise InstructionFileError(
            f"{place}: expected the path of a route of {item.scan} ({known}) on its "
            "navigation graph, got another; add the route to the plan"
        )
    return [
        own_or_new(
            mine,
            text,
            found,
            new_id=f"{item.path_id}_{number}",
            split=split_of(path),
            labels=labels,
            place=f"{place}, instruction {number}",
        )
        for number, (mine, text) in enumerate(zip(kept, item.instructions, strict=True))
    ]


def _clockwise_from_north(heading: float) -> float:
    return (math.pi / 2 - heading) % (2 * math.pi)


def viewpoints_along(graph: NavigationGraph, line: ArrayLike) -> tuple[Viewpoint, ...]:
    """Return the viewpoints that a walk along a line visits, in order.

    Of all walks on the graph it is the one that stays nearest to the line all along:
    the least sum of squared distances between places on the line, in order, and the
    viewpoint that one is at (map matching by dynamic programming). There is at least
    one; neighbours in the result are neighbours in the graph.
    """
    places = np.array([(each.x, each.y) for each in graph.viewpoints])
    samples = resample(line, STEP)
    apart = ((samples[:, None, :] - places[None, :, :]) ** 2).sum(axis=2)
    arrivals = _arrivals(graph)
    cost = apart[0]
    came_from: list[NDArray[np.intp]] = []
    for row in apart[1:]:
        candidates = np.where(arrivals, cost[:, None] + CHANGE, np.inf)
        np.fill_diagonal(candidates, cost)
        came_from.append(candidates.argmin(axis=0))
        cost = candidates.min(axis=0) + row
    at = int(cost.argmin())
    visited = [at]
    for before in reversed(came_from):
        at = int(before[at])
        visited.append(at)
    visited.reverse()
    changes = [there for here, there in pairwise(visited) if here != there]
    return tuple(graph.viewpoints[index] for index in [visited[0], *changes])


def _arrivals(graph: NavigationGraph) -> NDArray[np.bool_]:
    """Return whether one can go from the row's viewpoint to the column's."""
    joined = np.zeros((len(graph.viewpoints),) * 2, dtype=bool)
    for first, second in graph.edges:
        joined[first, second] = joined[second, first] = True
    return joined
