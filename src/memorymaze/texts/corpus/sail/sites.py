"""SAIL's mazes as site plans: halls of cells, their floors, pictures and furniture.

What a maze shows becomes landmarks, which cameras see: a covering on the floor of each
hall, a picture on both of its walls, and the piece of furniture in a corner of its node.
"""

import math
from collections.abc import Iterator
from itertools import pairwise

from shapely import LineString, Point, Polygon

from memorymaze.basics.geometry.pose import heading_to, turn_between, wrap_angle
from memorymaze.texts.corpus.sail.records import Maze, MazeCell, MazeHall
from memorymaze.world.sites.exits import shape_of
from memorymaze.world.sites.loading import check_sound
from memorymaze.world.sites.records import (
    Corridor,
    Exit,
    Landmark,
    Mount,
    PlanPart,
    Route,
    RouteTurn,
    Site,
    TurningPoint,
    parts_by_kind,
)

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
    site = Site(
        name=site_name(maze.name),
        title=f"SAIL {maze.name}",
        floor="0",
        ceiling_height=3.0,
        description=f"The maze {maze.name} of the SAIL corpus (MacMahon, Stankiewicz "
        f"and Kuipers 2006), with {EDGE:g} m from node to node and halls {HALL_WIDTH:g} m "
        "wide. Furniture stands in the north-east corner of its node.",
        anchor=None,
        **parts_by_kind(_Builder(maze).parts()),
        source=source,
    )
    check_sound(site)
    return site


class _Builder:
    def __init__(self, maze: Maze) -> None:
        self._maze = maze
        self._west = min(node.cell[0] for node in maze.nodes)
        self._south = max(node.cell[1] for node in maze.nodes)

    def place(self, cell: MazeCell) -> tuple[float, float]:
        """Return the middle of a node, metres; rows grow south, y grows north."""
        return (cell[0] - self._west) * EDGE, (self._south - cell[1]) * EDGE

    def parts(self) -> Iterator[PlanPart]:
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

    def _corridor(self, hall: MazeHall) -> Corridor:
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
        return Corridor(
            f"hall_{_between(hall)}",
            Polygon(corners),
            name=None,
            floor_material=hall.floor if floor is None else floor[2],
            wall_material="plaster",
        )

    def _looks(self, hall: MazeHall) -> Iterator[Landmark]:
        (ax, ay), (bx, by) = map(self.place, hall.ends)
        x, y = (ax + bx) / 2, (ay + by) / 2
        along = heading_to((ax, ay), (bx, by))
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
            across = along + side * math.pi / 2
            reach = HALL_WIDTH / 2 - 0.02
            yield _landmark(
                f"picture_{_between(hall)}_{'a' if side < 0 else 'b'}",
                (x + reach * math.cos(across), y + reach * math.sin(across)),
                (picture, None, None),
                (1.0, 0.04, 1.0),
                wrap_angle(along - side * math.pi / 2),
                mount="wall",
            )

    def _turning_point(self, cell: MazeCell) -> TurningPoint:
        x, y = self.place(cell)
        half = HALL_WIDTH / 2
        halls = {frozenset(hall.ends): hall for hall in self._maze.halls}
        exits = tuple(
            Exit(
                f"hall_{_between(halls[frozenset((cell, way))])}",
                heading_to((x, y), self.place(way)),
            )
            for way in self._maze.neighbours[cell]
        )
        corners = [
            (x - half, y - half),
            (x + half, y - half),
            (x + half, y + half),
            (x - half, y + half),
        ]
        return TurningPoint(
            f"node_{_word(cell)}",
            Polygon(corners),
            name=None,
            shape=shape_of(exits, areas=()),
            exits=exits,
        )

    def _furniture(self, cell: MazeCell, thing: str) -> Landmark:
        x, y = self.place(cell)
        category, name, size = THINGS.get(thing, (thing, None, (0.45, 0.45, 1.0)))
        return _landmark(
            f"{thing}_{_word(cell)}",
            (x + _CORNER, y + _CORNER),
            (category, None, name),
            size,
            math.radians(-135),
        )

    def _route(self, start: int, goal: int, way: list[MazeCell]) -> Route:
        line = [self.place(cell) for cell in way]
        headings = [heading_to(a, b) for a, b in pairwise(line)]
        turns = tuple(
            RouteTurn(f"node_{_word(cell)}", "left" if turn > 0 else "right")
            for cell, before, after in zip(
                way[1:], headings, headings[1:], strict=False
            )
            if (turn := turn_between(before, after))
        )
        last = frozenset(way[-2:])
        hall = next(h for h in self._maze.halls if frozenset(h.ends) == last)
        return Route(
            f"route_{start}_{goal}",
            LineString(line),
            route=route_name(start, goal),
            role="reference",
            start_heading=headings[0],
            goal=f"position {goal}",
            goal_landmark=f"floor_{_between(hall)}",
            length=EDGE * (len(way) - 1),
            turns=turns,
            note="A shortest way; instructions may tell another.",
        )


def _word(cell: MazeCell) -> str:
    return f"{cell[0]}_{cell[1]}".replace("-", "m")


def _between(hall: MazeHall) -> str:
    return "_".join(_word(cell) for cell in hall.ends)


def _landmark(
    identity: str,
    place: tuple[float, float],
    words: tuple[str, str | None, str | None],
    size: tuple[float, float, float],
    heading: float,
    mount: Mount = "floor",
) -> Landmark:
    category, color, name = words
    return Landmark(
        identity,
        Point(place),
        category,
        color,
        name,
        None,
        heading,
        size,
        mount,
        obstacle=False,
    )
