"""SAIL's mazes as site plans: halls of cells, their floors, pictures and furniture.

What a maze shows becomes landmarks, which cameras see: a covering on the floor of each
hall, a picture on both of its walls, and the piece of furniture in a corner of its node.
"""

import json
import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from memorymaze.instructions.sail.records import Maze, MazeCell, MazeHall
from memorymaze.sites import Site
from memorymaze.sites.loading import sound_site
from memorymaze.sites.plan_writing import Feature, feature
from memorymaze.sites.reading import understand_plan

EDGE = 4.0
"""Metres from node to node."""
HALL_WIDTH = 2.0
"""Metres."""

FLOORS: dict[str, tuple[str, str | None, str]] = {
    "blue": ("ceramic tile floor", "blue", "tile"),
    "brick": ("brick floor", "red", "tile"),
    "concrete": ("concrete floor", "grey", "concrete"),
    "flower": ("flowered carpet floor", "pink", "carpet"),
    "grass": ("grass carpet floor", "green", "carpet"),
    "gravel": ("stone floor", "black", "tile"),
    "wood": ("wooden floor", "brown", "wood"),
    "yellow": ("octagon tile floor", "yellow", "tile"),
}
"""By SAIL's word: category and colour of the covering, and the plan's material."""
PICTURES = {
    "butterfly": "picture of a butterfly",
    "fish": "picture of a fish",
    "tower": "picture of the eiffel tower",
}
THINGS: dict[str, tuple[str, str | None, tuple[float, float, float]]] = {
    "chair": ("chair", None, (0.45, 0.45, 0.9)),
    "sofa": ("sofa", "bench", (0.5, 0.4, 0.8)),
    "barstool": ("bar stool", None, (0.4, 0.4, 0.8)),
    "lamp": ("lamp", None, (0.35, 0.35, 1.6)),
    "easel": ("easel", "painting", (0.5, 0.4, 1.5)),
    "hatrack": ("hat rack", None, (0.4, 0.4, 1.7)),
}
"""By SAIL's word: category, what else people call it, and size."""

_CORNER = 0.72
"""Metres from the middle of a node to its furniture, east and north."""
_SHAPES = {1: "dead_end", 3: "t_junction", 4: "crossing"}


def site_name(maze: str) -> str:
    """Return the name of a maze's site."""
    return f"sail_{maze.lower()}"


def route_name(start: int, goal: int) -> str:
    """Return the name of the route between two positions."""
    return f"{start}-{goal}"


def maze_site(maze: Maze, source: str = "") -> Site:
    """Return the site of a maze.

    Args:
        maze: What to build.
        source: Path of the file that tells of the maze, for messages and fingerprints.

    Raises:
        SitePlanError: It does not make a sound plan, as one with too many nodes.
    """
    # JSON has lists where the plan has tuples.
    plan = json.loads(json.dumps(maze_plan(maze)))
    return sound_site(understand_plan(plan), source)


def maze_plan(maze: Maze) -> dict[str, Any]:
    """Return the plan of a maze, in the format of `docs/site_plans.md`."""
    return {
        "type": "FeatureCollection",
        "name": site_name(maze.name),
        "title": f"SAIL {maze.name}",
        "floor": "0",
        "ceiling_height_m": 3.0,
        "anchor": None,
        "description": f"The maze {maze.name} of the SAIL corpus (MacMahon, Stankiewicz "
        f"and Kuipers 2006), with {EDGE:g} m from node to node and halls {HALL_WIDTH:g} m "
        "wide. Furniture stands in the north-east corner of its node.",
        "features": list(_Builder(maze).features()),
    }


class _Builder:
    def __init__(self, maze: Maze) -> None:
        self._maze = maze
        self._west = min(node.cell[0] for node in maze.nodes)
        self._south = max(node.cell[1] for node in maze.nodes)

    def place(self, cell: MazeCell) -> tuple[float, float]:
        """Return the middle of a node, metres; rows grow south, y grows north."""
        return (cell[0] - self._west) * EDGE, (self._south - cell[1]) * EDGE

    def features(self) -> Iterator[Feature]:
        for hall in self._maze.halls:
            yield self._corridor(hall)
            yield from self._looks(hall)
        for node in self._maze.nodes:
            if self._maze.neighbours[node.cell]:
                yield self._turning_point(node.cell)
            if node.thing is not None:
                yield self._furniture(node.cell, node.thing)
        for start, first in self._maze.positions.items():
            for goal, last in self._maze.positions.items():
                way = self._maze.shortest_way(first, last)
                if way is not None and len(way) > 1:
                    yield self._route(start, goal, way)

    def _corridor(self, hall: MazeHall) -> Feature:
        (ax, ay), (bx, by) = map(self.place, hall.ends)
        half = HALL_WIDTH / 2
        dx, dy = (bx - ax) / EDGE * half, (by - ay) / EDGE * half
        corners = [
            (ax - dy, ay + dx),
            (ax + dy, ay - dx),
            (bx + dy, by - dx),
            (bx - dy, by + dx),
        ]
        floor = FLOORS.get(hall.floor)
        return _polygon(
            f"hall_{_between(hall)}",
            "corridor",
            corners,
            name=None,
            floor_material=hall.floor if floor is None else floor[2],
            wall_material="plaster",
        )

    def _looks(self, hall: MazeHall) -> Iterator[Feature]:
        (ax, ay), (bx, by) = map(self.place, hall.ends)
        x, y = (ax + bx) / 2, (ay + by) / 2
        along = math.degrees(math.atan2(by - ay, bx - ax)) % 360
        category, color, _ = FLOORS.get(hall.floor, (f"{hall.floor} floor", None, ""))
        length = EDGE - HALL_WIDTH
        yield _landmark(
            f"floor_{_between(hall)}",
            (x, y),
            (category, color, None),
            (HALL_WIDTH, length, 0.01),
            along,
        )
        picture = PICTURES.get(hall.wall, f"picture of a {hall.wall}")
        for side in (-1, 1):
            across = math.radians(along + 90 * side)
            reach = HALL_WIDTH / 2 - 0.02
            yield _landmark(
                f"picture_{_between(hall)}_{'a' if side < 0 else 'b'}",
                (x + reach * math.cos(across), y + reach * math.sin(across)),
                (picture, None, None),
                (1.0, 0.04, 1.0),
                (along - 90 * side) % 360,
                mount="wall",
            )

    def _turning_point(self, cell: MazeCell) -> Feature:
        x, y = self.place(cell)
        half = HALL_WIDTH / 2
        ways = self._maze.neighbours[cell]
        ends = [self.place(each) for each in ways]
        straight = len(ways) == 2 and ends[0][0] + ends[1][0] == 2 * x
        straight = straight and ends[0][1] + ends[1][1] == 2 * y
        shape = "opening" if straight else _SHAPES.get(len(ways), "corner")
        halls = {frozenset(hall.ends): hall for hall in self._maze.halls}
        exits = [
            {
                "to": f"hall_{_between(halls[frozenset((cell, way))])}",
                "heading_deg": math.degrees(math.atan2(end[1] - y, end[0] - x)) % 360,
            }
            for way, end in zip(ways, ends, strict=True)
        ]
        corners = [
            (x - half, y - half),
            (x + half, y - half),
            (x + half, y + half),
            (x - half, y + half),
        ]
        return _polygon(
            f"node_{_word(cell)}",
            "turning_point",
            corners,
            name=None,
            shape=shape,
            exits=exits,
        )

    def _furniture(self, cell: MazeCell, thing: str) -> Feature:
        x, y = self.place(cell)
        category, name, size = THINGS.get(thing, (thing, None, (0.45, 0.45, 1.0)))
        return _landmark(
            f"{thing}_{_word(cell)}",
            (x + _CORNER, y + _CORNER),
            (category, None, name),
            size,
            225.0,
        )

    def _route(self, start: int, goal: int, way: list[MazeCell]) -> Feature:
        line = [self.place(cell) for cell in way]
        headings = [
            math.degrees(math.atan2(b[1] - a[1], b[0] - a[0]))
            for a, b in pairwise(line)
        ]
        turns: list[dict[str, str]] = []
        for at in range(1, len(headings)):
            change = (headings[at] - headings[at - 1]) % 360
            if change:
                side = "left" if change < 180 else "right"
                turns.append({"at": f"node_{_word(way[at])}", "direction": side})
        last = frozenset(way[-2:])
        hall = next(h for h in self._maze.halls if frozenset(h.ends) == last)
        return feature(
            f"route_{start}_{goal}",
            "route",
            {"type": "LineString", "coordinates": line},
            route=route_name(start, goal),
            role="reference",
            start_heading_deg=headings[0] % 360,
            goal=f"position {goal}",
            goal_landmark=f"floor_{_between(hall)}",
            length_m=EDGE * (len(way) - 1),
            turns=turns,
            note="A shortest way; instructions may tell another.",
        )


def _word(cell: MazeCell) -> str:
    return f"{cell[0]}_{cell[1]}".replace("-", "m")


def _between(hall: MazeHall) -> str:
    return "_".join(_word(cell) for cell in hall.ends)


def _polygon(
    identity: str, kind: str, corners: list[tuple[float, float]], **properties: object
) -> Feature:
    ring = [*corners, corners[0]]
    geometry: dict[str, object] = {"type": "Polygon", "coordinates": [ring]}
    return feature(identity, kind, geometry, **properties)


def _landmark(
    identity: str,
    place: tuple[float, float],
    words: tuple[str, str | None, str | None],
    size: tuple[float, float, float],
    heading_deg: float,
    mount: str = "floor",
) -> Feature:
    category, color, name = words
    return feature(
        identity,
        "landmark",
        {"type": "Point", "coordinates": place},
        category=category,
        color=color,
        name=name,
        text=None,
        heading_deg=heading_deg,
        size_m=size,
        mount=mount,
        obstacle=False,
    )
