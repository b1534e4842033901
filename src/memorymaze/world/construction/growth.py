"""Side corridors and links beyond a recipe, as buildings get them over the years."""

import math

import numpy as np
from shapely import LineString, Point

from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.world.construction.layout import Layout, Street, WingFrame
from memorymaze.world.construction.pieces import drawn_between, frame_on
from memorymaze.world.construction.skeleton import Skeleton

SHORTEST, LONGEST_BLIND, LONGEST_LINK = 6.5, 12.0, 34.0
"""Metres."""
FROM_OTHERS = 5.0
"""Metres from a new corridor to streets that it does not meet."""
FROM_NODES = 6.0
"""Metres along a street from where it meets another to where a new corridor begins."""
FROM_HALLS = 3.0
"""Metres from a new corridor to halls."""
IN_LINE = math.radians(165)
"""Two legs at least so far apart are one street."""
TRIES = 12
"""Places looked at for each corridor."""
AT_JUNCTIONS = 0.4
"""Share of them that face a corridor across a street."""
STEEPEST = math.radians(55)
"""The least angle at which a link meets a street."""


def grow(layout: Layout, rng: np.random.Generator, wanted: int) -> None:
    """Add so many corridors that end blind or link two streets, where there is room."""
    skeleton = Skeleton(layout)
    for _ in range(TRIES * wanted):
        facing = _facing(layout, skeleton)
        if facing and rng.random() < AT_JUNCTIONS:
            street, frame = facing[rng.integers(len(facing))]
        else:
            street = layout.streets[rng.integers(len(layout.streets))]
            along = drawn_between(rng, 0.0, LineString(street.points).length - 0.1)
            side = 90.0 if rng.random() < 0.5 else -90.0
            frame = frame_on(street.points, along).moved(0, 0, side)
        new = _corridor(layout, skeleton, street, frame, rng)
        if new is not None:
            layout.streets.append(new)
            skeleton = Skeleton(layout)
            wanted -= 1
            if not wanted:
                return


def _facing(layout: Layout, skeleton: Skeleton) -> list[tuple[Street, WingFrame]]:
    """Return where a corridor could begin opposite one that meets a street."""
    found: list[tuple[Street, WingFrame]] = []
    for node in skeleton.graph:
        legs = skeleton.legs(node)
        for leg in legs if len(legs) == 3 else ():
            through = [each.heading for each in legs if each is not leg]
            if abs(turn_between(*through)) > IN_LINE and leg.street is not None:
                frame = WingFrame(
                    skeleton.places[node], math.degrees(leg.heading) + 180
                )
                found.append((layout.streets[leg.street], frame))
    return found


def _corridor(
    layout: Layout,
    skeleton: Skeleton,
    street: Street,
    frame: WingFrame,
    rng: np.random.Generator,
) -> Street | None:
    """Return a link up to the street ahead or a blind corridor, or that neither fits."""
    lines = [LineString(each.points) for each in layout.streets]
    ahead = LineString([frame.at(0.5), frame.at(LONGEST_LINK)])
    hits = [line.intersection(ahead) for line in lines]
    met = [Point(frame.origin).distance(hit) for hit in hits if not hit.is_empty]
    meets = bool(met)
    reach = min(met) if met else drawn_between(rng, SHORTEST, LONGEST_BLIND)
    if reach < SHORTEST:
        return None
    end = frame.at(reach)
    new = LineString([frame.at(0.0), end])
    # A link comes near two streets at its ends; a blind corridor keeps away ahead too.
    stop = reach - FROM_OTHERS + 0.5 if meets else reach + FROM_OTHERS - 1.0
    kept = LineString([frame.at(FROM_OTHERS), frame.at(max(stop, FROM_OTHERS + 0.5))])
    crowded = any(line.distance(kept) < FROM_OTHERS - 0.6 for line in lines) or any(
        hall.polygon.distance(new) < FROM_HALLS for hall in layout.halls
    )
    node = skeleton.node_at(frame.origin)
    at_junction = node is not None and skeleton.graph.degree[node] == 3
    near = any(
        math.dist(place, each) < FROM_NODES
        for place in ((frame.origin, end) if meets else (frame.origin,))
        for number, each in enumerate(skeleton.places)
        if not (at_junction and number == node)
    )
    if crowded or near or (meets and not _is_steep(frame, lines, end)):
        return None
    width = drawn_between(rng, 1.9, min(2.6, street.width))
    return Street(
        (frame.origin, end),
        width,
        street.program,
        street.zone,
        rooms="both" if street.rooms == "both" else "none",
        signed=meets,
    )


def _is_steep(
    frame: WingFrame, lines: list[LineString], end: tuple[float, float]
) -> bool:
    """Return whether a link meets the street at its end at a wide angle."""
    met = min(lines, key=lambda line: line.distance(Point(end)))
    along = met.project(Point(end))
    before = met.interpolate(max(along - 0.5, 0.0))
    after = met.interpolate(min(along + 0.5, met.length))
    heading = heading_to((before.x, before.y), (after.x, after.y))
    turn = abs(turn_between(math.radians(frame.heading_deg), heading))
    return STEEPEST < turn < math.pi - STEEPEST
