"""Centre lines of a floor's ways: its skeleton where walls run along each other, straight."""

import math
from collections import Counter, defaultdict
from dataclasses import dataclass
from itertools import pairwise

import networkx as nx
import numpy as np
from shapely import (
    LineString,
    MultiPolygon,
    Point,
    Polygon,
    get_coordinates,
    is_valid_reason,
)

from memorymaze.basics.geometry.points import XY, FloatArray
from memorymaze.world.importing.imported import CentreLine
from memorymaze.world.importing.skeleton import branches, floor_skeleton
from memorymaze.world.sites.floor_rules import CORRIDOR_WIDTHS

NARROWEST = 0.2
"""Metres; on a floor that is narrower everywhere there is no way."""
WIDEST = CORRIDOR_WIDTHS[1]
"""Metres; what is wider is an open area."""
PARALLEL = 0.9
"""Least ratio of width to twice the distance of the nearest wall between parallel walls."""
WIDENING = 1.5
"""Times its width that a way may be wider over a short stretch."""
OPEN_RATIO = 2.0
"""Where lines meet, a place so many times wider than each of them is an open area."""
MEETING_RATIO = 1.6
"""Half widths of the open floor, at most, where ways of one width meet."""
NEAR = 0.5
"""Widths between two meetings that are one place."""
SHORTEST = 1.5
"""Metres that a way is long at least; and it is as long as wide."""
DEAD_END = 0.75
"""Times its width that the skeleton of a dead end is long, which stops before its wall."""
ALONE = 2.5
"""Times its width that a way is long which meets no other; else it is a room."""
STRAIGHT = 0.3
"""Half widths that the skeleton may stray from a straight line."""
FARTHEST_MEETING = 6.0
"""Half widths apart that lines end at most which meet at one place."""
SMOOTH = 0.15
"""Half widths that a line may stray from a straight one once ways are joined."""
SAME_WIDTH = 1.3
"""Ratio of two widths that still are one way's."""


@dataclass
class _Run:
    """A stretch of the skeleton between parallel walls."""

    nodes: list[int]
    points: FloatArray
    width: float
    corners: list[XY]
    """Its line, straightened, from the first to the last node."""
    zones: list[int | None]
    """At its two ends: pieces of the skeleton between ways; None for an open area."""

    @property
    def length(self) -> float:
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())

    def turned_round(self) -> "_Run":
        return _Run(
            self.nodes[::-1],
            self.points[::-1],
            self.width,
            self.corners[::-1],
            self.zones[::-1],
        )

    def followed_by(self, other: "_Run") -> "_Run":
        """Return both as one, which begins at the start of the first."""
        lengths = self.length, other.length
        corners = LineString([*self.corners, *other.corners[1:]])
        width = float(np.average([self.width, other.width], weights=lengths))
        return _Run(
            self.nodes + other.nodes,
            np.concatenate([self.points, other.points]),
            width,
            [(x, y) for x, y in corners.simplify(SMOOTH * width / 2).coords],
            [self.zones[0], other.zones[1]],
        )


def centre_lines(floor: Polygon | MultiPolygon) -> list[CentreLine]:
    """Return the lines along the middle of a floor's ways, each with its width.

    Lines that meet share an end. One that leads into an open area ends where that begins,
    one that leads nowhere ends at the wall. A floor without ways, such as one hall, has none.
    """
    if floor.is_empty or not floor.is_valid:
        raise ValueError(f"expected a valid floor, got: {is_valid_reason(floor)}")
    if floor.buffer(-NARROWEST / 2).is_empty:
        return []
    skeleton = floor_skeleton(floor)
    runs = _runs(skeleton, floor)
    _meet(runs, skeleton, floor)
    lines = [
        CentreLine(tuple((round(x, 3), round(y, 3)) for x, y in run.corners), run.width)
        for run in _joined(runs)
    ]
    ends = Counter(end for line in lines for end in (line.points[0], line.points[-1]))
    return [line for line in lines if _is_way(line, ends)]


def _runs(skeleton: "nx.Graph[int]", floor: Polygon | MultiPolygon) -> list[_Run]:
    """Return the ways of a skeleton, and take them out of it."""
    found = [
        _run_along(skeleton, nodes)
        for way in list(branches(skeleton))
        for nodes in _between_parallel_walls(skeleton, way)
    ]
    ending = {node for node in skeleton if skeleton.degree(node) == 1}
    for run in found:
        skeleton.remove_edges_from(pairwise(run.nodes))
    radius_at = {
        node: max(skeleton.nodes[each]["radius"] for each in part)
        for part in nx.connected_components(skeleton)
        for node in part
    }
    runs: list[_Run] = []
    for run in found:
        ends = {run.nodes[0], run.nodes[-1]}
        least = (DEAD_END if ends & ending else 1.0) * run.width
        beside = max(radius_at[node] for node in ends)
        if run.length >= max(SHORTEST, least):
            runs.append(run)
        elif beside <= MEETING_RATIO * run.width / 2 and not ends & ending:
            # Two ways meet a third near each other: at one place, if very near.
            if run.length >= NEAR * run.width:
                runs.append(run)
            else:
                nx.add_path(skeleton, run.nodes)
    zone_of = {
        node: number
        for number, part in enumerate(nx.connected_components(skeleton))
        for node in part
    }
    for run in runs:
        run.zones = [zone_of[run.nodes[0]], zone_of[run.nodes[-1]]]
        run.corners = _straightened(run.points, run.width)
        if not floor.covers(LineString(run.corners)):
            bent = LineString(run.points).simplify(SMOOTH * run.width / 2)
            run.corners = [(x, y) for x, y in bent.coords]
    return runs


def _run_along(skeleton: "nx.Graph[int]", nodes: list[int]) -> _Run:
    seen = [skeleton.nodes[node] for node in nodes]
    points = np.array([(node["x"], node["y"]) for node in seen])
    width = 2 * float(np.median([node["radius"] for node in seen]))
    return _Run(nodes, points, width, [], [None, None])


def _between_parallel_walls(
    skeleton: "nx.Graph[int]", way: list[int]
) -> list[list[int]]:
    """Return the stretches of a branch that are ways, over doors and small bays."""
    steps = [skeleton.edges[step] for step in pairwise(way)]
    lengths = np.array([step["length"] for step in steps])
    nodes = np.array([skeleton.nodes[node]["radius"] for node in way])
    radii = (nodes[1:] + nodes[:-1]) / 2
    is_way = np.array([step["parallel"] >= PARALLEL for step in steps])
    is_way &= radii <= WIDEST / 2
    changes = np.flatnonzero(np.diff(is_way, prepend=False, append=False))
    stretches = changes.reshape(-1, 2).tolist()
    long = [
        (first, after)
        for first, after in stretches
        if lengths[first:after].sum() >= np.median(radii[first:after])
    ]
    joined: list[tuple[int, int]] = []
    for first, after in long or stretches:
        if joined:
            begin, end = joined[-1]
            sizes = np.median(radii[begin:end]), np.median(radii[first:after])
            widest = max(radii[end:first], default=0.0)
            apart = lengths[end:first].sum()
            if max(sizes) <= SAME_WIDTH * min(sizes) and (
                widest <= 1.05 * max(sizes)
                or (widest <= WIDENING * max(sizes) and apart <= 4 * max(sizes))
            ):
                joined[-1] = (begin, after)
                continue
        joined.append((first, after))
    return [way[first : after + 1] for first, after in joined]


def _meet(
    runs: list[_Run], skeleton: "nx.Graph[int]", floor: Polygon | MultiPolygon
) -> None:
    """Move the ends of ways to where they meet, to the wall, or leave them."""
    ends: defaultdict[int | None, list[tuple[_Run, int]]] = defaultdict(list)
    for run in runs:
        for end in (0, -1):
            ends[run.zones[end]].append((run, end))
    for number, part in enumerate(nx.connected_components(skeleton)):
        meeting = ends[number]
        if not meeting:
            continue
        half = max(run.width for run, _ in meeting) / 2
        radius = max(skeleton.nodes[node]["radius"] for node in part)
        places = [run.corners[end] for run, end in meeting]
        apart = max(math.dist(a, b) for a in places for b in places)
        if radius > OPEN_RATIO * half or apart > FARTHEST_MEETING * half:
            for run, end in meeting:
                run.zones[end] = None
        elif len(meeting) == 1:
            run, end = meeting[0]
            run.corners[end] = _at_wall(run, end, floor)
        else:
            place = _meeting_place(meeting, radius)
            for run, end in meeting:
                tip, behind = run.corners[end], run.corners[1 if end == 0 else -2]
                if floor.covers(LineString([behind, place])):
                    run.corners[end] = place
                elif floor.covers(LineString([tip, place])):
                    run.corners.insert(0 if end == 0 else len(run.corners), place)
                else:
                    run.zones[end] = None


def _meeting_place(meeting: list[tuple[_Run, int]], radius: float) -> XY:
    """Return the place nearest to all lines, but none far from where they end."""
    ends = np.array([run.corners[end] for run, end in meeting])
    behind = np.array([run.corners[1 if end == 0 else -2] for run, end in meeting])
    middle = ends.mean(axis=0)
    ahead = (ends - behind) / np.linalg.norm(ends - behind, axis=1)[:, None]
    across = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
    # Long lines are known best. Lines in line say nothing on where along them; the
    # middle then does, weakly.
    lengths = np.linalg.norm(ends - behind, axis=1)
    rows = np.concatenate([across * lengths[:, None], 0.05 * np.eye(2)])
    goals = np.concatenate([(across * ends).sum(axis=1) * lengths, 0.05 * middle])
    place = np.linalg.lstsq(rows, goals, rcond=None)[0]
    if math.dist(place, middle) > 2 * radius:
        place = middle
    return (float(place[0]), float(place[1]))


def _at_wall(run: _Run, end: int, floor: Polygon | MultiPolygon) -> XY:
    """Return where a line that leads nowhere meets the wall ahead."""
    tip = np.array(run.corners[end])
    ahead = tip - run.corners[1 if end == 0 else -2]
    far = tip + ahead / np.linalg.norm(ahead) * 2 * run.width
    free = LineString([tip, far]).intersection(floor)
    pieces = [piece for piece in getattr(free, "geoms", [free]) if not piece.is_empty]
    first = min(pieces, key=Point(tip).distance, default=None)
    reached = (
        tip
        if first is None
        else max(get_coordinates(first), key=lambda place: math.dist(place, tip))
    )
    return (float(reached[0]), float(reached[1]))


def _straightened(points: FloatArray, width: float) -> list[XY]:
    """Return the corners of straight lines along a stretch of skeleton."""
    rough = get_coordinates(LineString(points).simplify(STRAIGHT * width / 2))
    marks = [0]
    for corner in rough[1:]:
        later = np.linalg.norm(points[marks[-1] + 1 :] - corner, axis=1)
        marks.append(marks[-1] + 1 + int(later.argmin()))
    pieces = list(pairwise(marks))
    # Where a way bends, the skeleton cuts the corner.
    long = [
        (first, last)
        for first, last in pieces
        if math.dist(points[first], points[last]) >= width
    ]
    pieces = long or pieces
    fits = [_fitted(points[first : last + 1], width) for first, last in pieces]
    corners = [_onto(fits[0], points[0])]
    for (before, after), ((_, last), (first, _)) in zip(
        pairwise(fits), pairwise(pieces), strict=True
    ):
        corners.append(_crossing(before, after, points[(last + first) // 2], width))
    return [*corners, _onto(fits[-1], points[-1])]


def _fitted(points: FloatArray, width: float) -> tuple[FloatArray, FloatArray]:
    """Return a place on the line along points and its direction.

    Near its ends, where ways meet or bend, the skeleton leaves the middle.
    """
    along = np.concatenate([
        [0.0],
        np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)),
    ])
    inner = points[(along >= width / 2) & (along <= along[-1] - width / 2)]
    if len(inner) < 3 or math.dist(inner[0], inner[-1]) < width / 2:
        inner = points[[0, -1]]
    middle = inner.mean(axis=0)
    direction = np.linalg.svd(inner - middle)[2][0]
    return middle, direction


def _onto(line: tuple[FloatArray, FloatArray], place: FloatArray) -> XY:
    middle, direction = line
    x, y = middle + direction * float((place - middle) @ direction)
    return (float(x), float(y))


def _crossing(
    line: tuple[FloatArray, FloatArray],
    other: tuple[FloatArray, FloatArray],
    near: FloatArray,
    width: float,
) -> XY:
    """Return where two lines cross, or the place itself where they do so far from it."""
    towards = np.stack([line[1], -other[1]], axis=1)
    if abs(np.linalg.det(towards)) > 0.1:
        x, y = line[0] + line[1] * np.linalg.solve(towards, other[0] - line[0])[0]
        if math.dist((x, y), near) < width:
            return (float(x), float(y))
    return (float(near[0]), float(near[1]))


def _joined(runs: list[_Run]) -> list[_Run]:
    """Return the ways, those that go on in just one other of their width made one."""
    ends: defaultdict[int, list[_Run]] = defaultdict(list)
    for run in runs:
        for zone in run.zones:
            if zone is not None:
                ends[zone].append(run)
    whole = list(runs)
    for zone, meeting in ends.items():
        if len(meeting) != 2 or meeting[0] is meeting[1]:
            continue
        first, second = meeting
        if max(first.width, second.width) > SAME_WIDTH * min(first.width, second.width):
            continue
        one = (first if first.zones[1] == zone else first.turned_round()).followed_by(
            second if second.zones[0] == zone else second.turned_round()
        )
        whole = [run for run in whole if run is not first and run is not second]
        whole.append(one)
        for other in (one.zones[0], one.zones[1]):
            if other is not None:
                ends[other] = [
                    one if run is first or run is second else run for run in ends[other]
                ]
    return whole


def _is_way(line: CentreLine, ends: Counter[XY]) -> bool:
    """Tell whether a line meets another or is long for its width; else it is a room's."""
    meets = ends[line.points[0]] > 1 or ends[line.points[-1]] > 1
    return meets or LineString(line.points).length >= ALONE * line.width
