"""A simulated robot that goes from viewpoint to viewpoint of a graph, and looks all round."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from shapely import Point

from memorymaze.basics.errors import EpisodeOver
from memorymaze.basics.geometry.pose import Pose, heading_to, turn_between, wrap_angle
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.robot.api.control import MoveResult
from memorymaze.robot.api.viewpoints import (
    EIGHT_DIRECTIONS,
    Journey,
    Outlook,
    Panorama,
    SeenThing,
    WayOn,
)
from memorymaze.robot.perception.camera_view import ObjectDescription, VisibleObject
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.scene_sentences import (
    PlaceSurface,
    SceneView,
    summary_sentence,
    thing_words,
    view_sentence,
)
from memorymaze.robot.simulation.senses.coverings import is_floor_piece
from memorymaze.world.sites.navigation_graph import NavigationGraph, Viewpoint

THERE = 0.05
"""Metres from a viewpoint within which the robot is on it."""
TEMPLATES = "templates"
"""What describes the looks of this module."""
THINGS_WITHIN = 3.0
"""Metres; farther things are not told with angle and distance."""
SEEN_WITHIN = 10.0
"""Metres; farther things are not named in a sentence."""
LOOKS_AHEAD = tuple(math.radians(each) for each in (0, -10, 10, -20, 20))
"""How open a direction is is measured along these rays, from its middle."""
WIDTH_MEASURED_AT = 2.0
"""Metres ahead, where the width of a way is measured."""


class ViewpointWalk:
    """One episode on a navigation graph; implements `ViewpointRobot`.

    Collisions, budgets and people count as in any walk. Looking costs no time, as with
    a camera that sees all round.
    """

    def __init__(
        self,
        robot: SimulatedRobot,
        graph: NavigationGraph,
        look: Callable[[Viewpoint], Panorama] | None = None,
    ) -> None:
        """Drive the robot to the viewpoint nearest to it that it can go straight to.

        `look` describes what is seen from a viewpoint; None for templates filled with
        what the camera truly sees.
        """
        self._robot = robot
        self._graph = graph
        self._look = look or self._by_templates
        self._viewpoints = {each.id: each for each in graph.viewpoints}
        self._start_heading = robot.pose.heading
        self._here = self._nearest()
        if math.dist(self._here[1:], robot.pose[:2]) > THERE:
            self._drive_to(self._here)

    @property
    def viewpoint(self) -> str:
        """See `ViewpointRobot.viewpoint`."""
        return self._here.id

    @property
    def start_heading(self) -> float:
        """See `ViewpointRobot.start_heading`."""
        return self._start_heading

    def ways_on(self) -> tuple[WayOn, ...]:
        """See `ViewpointRobot.ways_on`; the nearest first."""
        here = self._here
        ways = [
            WayOn(
                there.id,
                heading_to(here[1:], there[1:]),
                math.dist(here[1:], there[1:]),
            )
            for there in self._graph.neighbours[here.id]
        ]
        return tuple(sorted(ways, key=lambda way: (way.distance, way.viewpoint)))

    def look_around(self) -> Panorama:
        """See `ViewpointRobot.look_around`."""
        return self._look(self._here)

    def go_to(self, viewpoint: str) -> Journey:
        """See `ViewpointRobot.go_to`."""
        there = self._viewpoints.get(viewpoint)
        if there is None:
            return Journey("unknown", 0.0, "")
        if there not in self._graph.neighbours[self._here.id]:
            return Journey("not_adjacent", 0.0, "")
        gone = self._drive_to(there)
        if gone.reason == "done":
            self._here = there
            return Journey("arrived", gone.distance, "")
        back = self._drive_to(self._here)
        return Journey("blocked", gone.distance + back.distance, gone.reason)

    def _drive_to(self, there: Viewpoint) -> MoveResult:
        """Drive straight to a viewpoint."""
        result = self._robot.follow([there[1:]])
        if result.reason == "budget":
            raise EpisodeOver("budget")
        return result

    def _nearest(self) -> Viewpoint:
        pose = self._robot.pose
        clearance = self._robot.scene.clearance
        ordered = sorted(
            self._graph.viewpoints, key=lambda each: math.dist(pose[:2], each[1:])
        )
        return next(
            (
                each
                for each in ordered
                if clearance.is_free([pose[:2], each[1:]], ROBOT_RADIUS)
            ),
            ordered[0],
        )

    def _by_templates(self, viewpoint: Viewpoint) -> Panorama:
        return look_around(self._robot, viewpoint.x, viewpoint.y)


@dataclass(frozen=True, slots=True)
class _Sighting:
    heading: float
    """Radians."""
    seen: VisibleObject


def sector_headings() -> tuple[float, ...]:
    """Return the middles of the eight directions: north, then clockwise; radians."""
    step = 2 * math.pi / EIGHT_DIRECTIONS
    return tuple(
        wrap_angle(math.pi / 2 - number * step) for number in range(EIGHT_DIRECTIONS)
    )


def look_around(robot: SimulatedRobot, x: float, y: float) -> Panorama:
    """Return what is seen from a place, with people and things where they are now.

    The camera looks in eight directions, while its robot stays where it is. A thing
    that several looks show is told once, in the direction of its middle.
    """
    headings = sector_headings()
    sightings = _sightings(robot, x, y, headings)
    sectors: list[list[_Sighting]] = [[] for _ in headings]
    for each in sightings:
        nearest = min(
            range(EIGHT_DIRECTIONS),
            key=lambda k: abs(turn_between(headings[k], each.heading)),
        )
        sectors[nearest].append(each)
    views = [
        _view(robot.scene, x, y, heading, seen)
        for heading, seen in zip(headings, sectors, strict=True)
    ]
    outlooks = tuple(
        Outlook(heading, view_sentence(view), _within_reach(seen))
        for heading, view, seen in zip(headings, views, sectors, strict=True)
    )
    everything = sorted(
        chain.from_iterable(sectors), key=lambda each: each.seen.distance
    )
    summary = summary_sentence(
        views,
        _surface(robot.scene, x, y),
        [each.seen.description for each in everything],
    )
    return Panorama(outlooks, summary, TEMPLATES)


def _sightings(
    robot: SimulatedRobot, x: float, y: float, headings: Sequence[float]
) -> list[_Sighting]:
    """Return each thing seen once: as the look shows it that has it most central.

    Boards that are seen from behind have no words.
    """
    best: dict[tuple[object, ...], tuple[float, _Sighting]] = {}
    for heading in headings:
        camera = robot.camera_view_from(Pose(x, y, heading))
        turned_away = {
            (each.bearer.description, each.bearer.position)
            for each in camera.visible_texts(SEEN_WITHIN)
            if each.facing > math.pi / 2
        }
        for seen in camera.visible_objects(SEEN_WITHIN, _is_thing):
            which = (seen.description, seen.position)
            aside = abs(seen.bearing)
            if which in turned_away:
                wordless = replace(seen.description, text=None)
                seen = replace(seen, description=wordless)
            if which not in best or aside < best[which][0]:
                there = _Sighting(wrap_angle(heading + seen.bearing), seen)
                best[which] = (aside, there)
    return sorted((each for _, each in best.values()), key=lambda s: s.seen.distance)


def _is_thing(description: ObjectDescription) -> bool:
    """Tell whether it is no floor: of that `PlaceSurface` tells."""
    return not is_floor_piece(description)


def _within_reach(sightings: Sequence[_Sighting]) -> tuple[SeenThing, ...]:
    return tuple(
        SeenThing(thing_words(each.seen.description), each.heading, each.seen.distance)
        for each in sightings
        if each.seen.distance <= THINGS_WITHIN
    )


def _view(
    scene: Scene, x: float, y: float, heading: float, seen: Sequence[_Sighting]
) -> SceneView:
    rays = [wrap_angle(heading + aside) for aside in LOOKS_AHEAD]
    depths = [_to_wall(scene, x, y, ray) for ray in rays]
    depth = max(depths)
    ray = rays[depths.index(depth)]
    ahead = min(WIDTH_MEASURED_AT, depth / 2)
    ux, uy = math.cos(ray), math.sin(ray)
    px, py = x + ahead * ux, y + ahead * uy
    width = sum(_to_wall(scene, px, py, ray + side * math.pi / 2) for side in (-1, 1))
    return SceneView(
        depth=depth,
        width=width,
        surface=_surface(scene, px, py),
        things=tuple((each.seen.description, each.seen.distance) for each in seen),
    )


def _to_wall(scene: Scene, x: float, y: float, heading: float) -> float:
    """Return metres to the first wall; 0 where there is no floor."""
    crossings = scene.clearance.wall_crossings(
        (x, y), (math.cos(heading), math.sin(heading))
    )
    return crossings[0] if crossings else 0.0


def _surface(scene: Scene, x: float, y: float) -> PlaceSurface:
    """Return what floor and walls are made of at or nearest to a place."""
    here = Point(x, y)
    part = min(
        (*scene.site.corridors, *scene.site.areas),
        key=lambda each: each.polygon.distance(here),
    )
    return PlaceSurface(part.floor_material, part.wall_material)
