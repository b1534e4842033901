"""Whether agents find doors, named places and things at the end of a way, and stop there.

Every numbered door, every place told by a sign, and every thing that there is once on its
floor is a destination, from two turns away, told by a plan that names the turns, the
destination and its side: `python -m benchmarks.arrival [--sample N]` (docs/lab/benches.md).
"""

import math
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
from shapely import LineString, Point, get_parts
from shapely.prepared import prep

from benchmarks.plan_walks import (
    PlanWalk,
    agents_of,
    buildings,
    by_floors,
    estimates,
    labels,
    parser_of,
    plan_instruction,
    share,
    walk_plans,
)
from memorymaze.basics.errors import SitePlanError
from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.basics.tables import Column, Table
from memorymaze.language.plans import Leg, RoutePlan
from memorymaze.robot.perception.matching import points_elsewhere
from memorymaze.runs.metrics.success import success_within
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.steps import SIDES
from memorymaze.texts.writing.things import NUMBER, Thing
from memorymaze.texts.writing.turning_point_graph import GraphWay, TurningPointGraph
from memorymaze.world.sites import Route, RouteTurn, Site

DISTANCES = (1.5, 3.0, 5.0)
"""Metres from the destination."""
ARRIVED = 3.0
CLEARANCE = 0.45
"""Metres from a way to walls and things."""
BESIDE = 4.0
"""Metres from a way within which a destination lies."""
LAST = (3.0, 40.0)
"""Metres from the last turn to the destination."""
BEFORE = 12.0
"""Metres before the first turn where a walk begins."""
PLAIN_TURN = (math.radians(45), math.radians(135))
TRIES = 4
"""Ways to a destination that are tried until one can be told plainly."""

DestinationKind = Literal["number", "sign", "thing"]
KINDS: Mapping[DestinationKind, str] = {
    "number": "numbered door",
    "sign": "place told by a sign",
    "thing": "thing",
}

Place = tuple[float, float]


class Destination(NamedTuple):
    """Something to be found."""

    kind: DestinationKind
    thing: Thing


@dataclass(frozen=True, slots=True)
class ArrivalCase:
    """A way to a destination, and what is said of it."""

    destination: Destination
    route: Route
    plan: RoutePlan


def destinations_of(site: Site) -> list[Destination]:
    """Return what can be told apart by its words: what there is once.

    Signs that point on, or hang over the way, stand at no place.
    """
    doors = {door.id: door for door in site.doors}
    marks = {mark.id: mark for mark in site.landmarks}
    found: list[Destination] = []
    for thing in TurningPointGraph(site).things:
        if thing.id in doors:
            label = doors[thing.id].label
            if label is not None and NUMBER.fullmatch(label):
                found.append(Destination("number", thing))
            elif label is not None and not thing.words.startswith("door to "):
                found.append(Destination("sign", _by_its_label(thing, label)))
        elif thing.kind == "object" and not thing.proper:
            found.append(Destination("thing", thing))
        elif thing.kind == "sign" and " that says " in thing.words:
            mark = marks[thing.id]
            if mark.mount != "ceiling" and not points_elsewhere(mark.text or ""):
                found.append(Destination("sign", thing))
    count = Counter(each.thing.words for each in found)
    written = [
        *((door.label, door.line.centroid) for door in site.doors),
        *((m.text, m.position) for m in site.landmarks if m.mount != "ceiling"),
    ]

    def is_written_elsewhere(thing: Thing) -> bool:
        # A room has another door, or a sign at it.
        words = thing.words.rpartition(" that says ")[2].casefold()
        return any(
            (text or "").casefold() == words
            and math.dist(thing.position, (spot.x, spot.y)) > ARRIVED
            for text, spot in written
        )

    return [
        each
        for each in found
        if count[each.thing.words] == 1 and not is_written_elsewhere(each.thing)
    ]


def _by_its_label(door: Thing, label: str) -> Thing:
    """Return a door with the name on it, where its words say only what a door it is."""
    is_said = label.casefold() in door.words.casefold()
    return door if is_said else replace(door, words=label)


class Approach(NamedTuple):
    """Two turns, and the stretch after them as far as it goes straight on."""

    start: Place
    corners: tuple[Place, Place]
    end: Place
    turns: tuple[RouteTurn, ...]


class _Turn(NamedTuple):
    at: str
    side: Literal["left", "right"]
    onward: GraphWay


class Approaches:
    """The ways of a site that have two plain turns and are free up to the second."""

    def __init__(self, site: Site) -> None:
        """Find them all."""
        self._graph = TurningPointGraph(site)
        self._floor = site.free_floor.buffer(-CLEARANCE)
        self._free = prep(self._floor.buffer(1e-6))
        self._all = [
            approach
            for point, ways in self._graph.ways.items()
            for way in ways
            for first in self._turns(point, way)
            for second in self._turns(first.at, first.onward)
            if (approach := self._approach(point, first, second)) is not None
        ]

    def _straight_on(self, point: str, way: GraphWay) -> Iterator[GraphWay]:
        """Yield a way from a turning point, and those that go straight on after it."""
        passed, onward = {point}, way
        while onward is not None and onward.end not in passed:
            yield onward
            if onward.end is None:
                return
            passed.add(onward.end)
            onward = self._graph.leaving(onward.end, onward.heading, None)

    def _turns(self, point: str, way: GraphWay) -> Iterator[_Turn]:
        """Yield the turns that one can make who goes straight on."""
        for each in self._straight_on(point, way):
            for side in SIDES if each.end else ():
                onward = self._graph.leaving(str(each.end), each.heading, side)
                if onward is not None:
                    yield _Turn(str(each.end), side, onward)

    def _approach(self, point: str, first: _Turn, second: _Turn) -> Approach | None:
        begin, corners = (
            self._middle(point),
            (self._middle(first.at), self._middle(second.at)),
        )
        before = LineString([corners[0], begin])
        start = before.interpolate(min(BEFORE, before.length))
        *_, beyond = self._straight_on(second.at, second.onward)
        end = self._middle(beyond.end) if beyond.end else beyond.line[-1]
        last = self._as_far_as_free(corners[1], end)
        turns = (RouteTurn(first.at, first.side), RouteTurn(second.at, second.side))
        places = [(round(start.x, 2), round(start.y, 2)), *corners, last]
        bends = [
            abs(turn_between(heading_to(*one), heading_to(*other)))
            for one, other in pairwise(pairwise(places))
        ]
        is_plain = all(PLAIN_TURN[0] < bend < PLAIN_TURN[1] for bend in bends)
        is_long = all(math.dist(*leg) >= LAST[0] for leg in pairwise(places))
        if is_plain and is_long and self._free.contains(LineString(places[:-1])):
            return Approach(places[0], corners, last, turns)
        return None

    def _middle(self, point: str) -> Place:
        centre = self._graph.points[point].polygon.centroid
        return centre.x, centre.y

    def routes_to(self, thing: Thing, rng: np.random.Generator) -> Iterator[Route]:
        """Yield some ways that end abreast of a thing in sight, in random order."""
        spot, found = Point(thing.position), 0
        for number in rng.permutation(len(self._all)):
            each = self._all[number]
            last = LineString([each.corners[1], each.end])
            along = last.project(spot)
            abreast = last.interpolate(along)
            line = LineString([each.start, *each.corners, abreast])
            if (
                LAST[0] <= along <= LAST[1]
                and abreast.distance(spot) <= BESIDE
                and spot.distance(Point(each.start)) >= 2 * ARRIVED
                and self._free.contains(line)
                and self._graph.sees(abreast, spot)
            ):
                yield Route(
                    id=f"to_{thing.id}_{found}",
                    line=line,
                    route=f"{thing.id}_{found}",
                    role="reference",
                    start_heading=heading_to(each.start, each.corners[0]),
                    goal=thing.words,
                    goal_landmark=thing.id,
                    length=line.length,
                    turns=each.turns,
                    note="",
                )
                found += 1
            if found == TRIES:
                return

    def up_to(self, route: Route, thing: Thing) -> Route:
        """Return a route that goes on to where one can stand before a thing."""
        *_, (x, y) = route.line.coords
        place = self._as_far_as_free((x, y), thing.position)
        if math.dist((x, y), place) < 0.3:
            return route
        line = LineString([*route.line.coords, place])
        return replace(route, line=line, length=line.length)

    def _as_far_as_free(self, start: Place, end: Place) -> Place:
        """Return how far one can go straight from a free place towards another."""
        origin = Point(start)
        for part in get_parts(LineString([start, end]).intersection(self._floor)):
            if part.distance(origin) < 0.05:
                x, y = max(part.coords, key=lambda each: math.dist(start, each))
                return x, y
        return start


def arrival_cases(site: Site, sample: int | None, seed: int) -> list[ArrivalCase]:
    """Return a way to every destination of a site that has one, or to so many a kind."""
    rng = np.random.default_rng([seed, *site.name.encode()])
    approaches = Approaches(site)
    there = destinations_of(site)
    there = [there[number] for number in rng.permutation(len(there))]
    ways = [(each, [*approaches.routes_to(each.thing, rng)]) for each in there]
    routes = tuple(route for _, found in ways for route in found)
    graph = TurningPointGraph(replace(site, routes=(*site.routes, *routes)))
    found: list[ArrivalCase] = []
    count: Counter[str] = Counter()
    for destination, candidates in ways:
        if sample is not None and count[destination.kind] >= sample:
            continue
        for route in candidates:
            plan = plain_plan(RouteFacts(graph, route))
            if plan is not None:
                whole = approaches.up_to(route, destination.thing)
                found.append(ArrivalCase(destination, whole, plan))
                count[destination.kind] += 1
                break
    return found


def plain_plan(facts: RouteFacts) -> RoutePlan | None:
    """Return what a short right description says; None where there is none.

    Of a leg how far it is and where to turn, of the destination its name and side.
    """
    try:
        if not facts.is_right(facts.plan):
            return None
    except SitePlanError:
        return None
    said = facts.plan.said
    legs = (
        Leg(
            leg.turn,
            length=leg.length
            and replace(leg.length, metres=float(round(leg.length.metres))),
            mentions=tuple(each for each in leg.mentions if each.place == "turn"),
        )
        for leg in said.legs
    )
    arrival = replace(said.arrival, length=None, mentions=(), passings=())
    return RoutePlan(legs=tuple(legs), arrival=arrival)


def with_ways(site: Site, cases: Sequence[ArrivalCase], folder: Path) -> Site:
    """Return a site with the ways of cases, and write its plan."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{site.name}.geojson"
    routes = (*site.routes, *(case.route for case in cases))
    whole = replace(site, routes=routes, source=str(path))
    whole.save(path)
    return whole


def arrival_row(kind: str, walks: Sequence[PlanWalk]) -> dict[str, object]:
    """Return what is told of walks to destinations of a kind."""
    values: dict[str, list[float]] = {
        f"sr_{distance:g}": [
            success_within(
                each.result.spd, distance, is_stopped=each.result.stopped_by == "agent"
            )
            for each in walks
        ]
        for distance in DISTANCES
    }
    values["false"] = [float(each.result.is_false_arrival) for each in walks]
    values["passed"] = [
        float(each.result.oracle_success and each.result.spd >= ARRIVED)
        for each in walks
    ]
    values["turns"] = [float(each.result.turns_in_order == 1) for each in walks]
    units = [each.result.instruction_id for each in walks]
    return {"kind": kind, "n": len(walks), **estimates(values, units)}


def arrival_table(rows: Sequence[Mapping[str, object]]) -> Table:
    return Table(
        "Arrival at destinations two turns away, told by plans",
        (
            Column("kind", "Destination", role="group"),
            *labels(rows),
            Column("n", "n"),
            *(share(f"sr_{d:g}", f"{d:g} m", "higher") for d in DISTANCES),
            share("false", "False", "lower"),
            share("passed", "Passed", "lower"),
            Column("turns", "Turns", digits=2),
        ),
        tuple(rows),
        notes=(
            "1.5 m to 5 m: success by distance. False: said that it arrived (stopped by itself, without a note that it gave "
            "up) 3 m or more away. Passed: was nearer than 3 m and ended farther away. "
            "Turns: took both turns of the way. Intervals: 95 %, destinations drawn again.",
        ),
        name="arrival",
    )


def main() -> int:
    parser = parser_of("arrival", "so many destinations of each kind on each site")
    options = parser.parse_args()
    sites = buildings(options)
    cases = {
        name: arrival_cases(site, options.sample, options.seed)
        for name, site in sites.items()
    }
    whole = {
        name: with_ways(site, cases[name], options.out / "plans")
        for name, site in sites.items()
    }
    kinds: dict[str, DestinationKind] = {}
    told = []
    for name, of_site in cases.items():
        for case in of_site:
            case_id = f"{name}-{case.destination.thing.id}"
            kinds[case_id] = case.destination.kind
            told.append(plan_instruction(case_id, whole[name], case.route, case.plan))
    counts = Counter(kinds.values())
    print(f"{len(told)} destinations: {dict(counts)}", file=sys.stderr)
    rows: list[dict[str, object]] = []
    for agent in agents_of(options):
        walks = walk_plans(agent, told, whole, options)
        for floors, part in by_floors(walks).items():
            told_of = {"floors": floors, "agent": agent.name}
            for kind, heading in KINDS.items():
                of_kind = [walk for name, walk in part.items() if kinds[name] == kind]
                rows.append(told_of | arrival_row(heading, of_kind))
            rows.append(told_of | arrival_row("all", list(part.values())))
    rows.sort(key=lambda row: [*KINDS.values(), "all"].index(str(row["kind"])))
    print(arrival_table(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
