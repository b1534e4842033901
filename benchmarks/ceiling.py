"""What reading allows: every plan followed in the mind, on the true map of its site.

For each shipped text: does the likeliest place to end lie within 3 m of the goal, and does
the heaviest alignment that ends there take the turns of the route?
`python -m benchmarks.ceiling` (docs/lab/benches.md). With `--list` also the texts without an
error that mean something else, and what: by that one finds wrong plans without reading any.

A true map is the sketch map as one would have it who walked every way of a site. The ways
are those that a robot takes that goes straight on, things and views come from looks of its
camera.
"""

import argparse
import math
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import mujoco
import numpy as np
import shapely
from numpy.typing import NDArray

from benchmarks.plan_walks import estimates, share
from benchmarks.reading import recorded_plans
from memorymaze.agents.agent import Journal
from memorymaze.agents.guide.alignments import AssumedStart, Segment
from memorymaze.agents.guide.arriving import SAME_PLACE, Arrivals, Ending
from memorymaze.agents.guide.belief import Belief
from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.agents.guide.recognising import Recognition
from memorymaze.agents.guide.search import SHORT_OF_THE_END
from memorymaze.agents.guide.starts import starts_ahead
from memorymaze.agents.guide.things import Things
from memorymaze.agents.plan_readers import GrammarReader
from memorymaze.agents.walking.approaching import BEYOND_SIGN, CLOSE, OPENS
from memorymaze.agents.walking.floor_map import (
    Crossing,
    FloorMap,
    Point,
    Sighting,
    Stretch,
)
from memorymaze.agents.walking.outlooks import outlook_of
from memorymaze.agents.walking.walker import AHEAD, STRIDE
from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.basics.tables import Column, Table
from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading import ANY_FLOOR
from memorymaze.robot.api.control import DETECTION_RANGE
from memorymaze.robot.perception.camera_view import (
    ObjectDescription,
    VisibleObject,
    place_at_bearing,
)
from memorymaze.robot.perception.detector import LONGEST_QUERY
from memorymaze.robot.perception.matching import (
    MATCH_THRESHOLD,
    match_score,
    points_elsewhere,
)
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.robot.simulation.senses.visibility import camera_elsewhere
from memorymaze.runs.episodes.sampling import sample
from memorymaze.runs.metrics.success import SUCCESS_DISTANCE
from memorymaze.texts.corpus import Episode, load_corpus
from memorymaze.texts.corpus.records import DEVELOPED, HELD_OUT, is_of_split
from memorymaze.texts.writing.route_facts import RouteFacts
from memorymaze.texts.writing.turning_point_graph import TurningPointGraph
from memorymaze.world.sites import Route, Site

HALVES = {HELD_OUT: "other half", DEVELOPED: "development half"}
STEP = 0.1
"""Metres between the places of a way that are asked for turning points."""
SHORTEST = 0.5
"""Metres; a way that ends sooner leads nowhere."""
LIGHT = 1e-4
"""Share below which an ending is not asked whether its place is the likeliest."""

Thing = tuple[ObjectDescription, Point]
"""What there is to see, and where."""


class Look(NamedTuple):
    """What the camera sees from a pose, the things with the numbers of their tracks."""

    pose: Pose
    seen: tuple[tuple[int, VisibleObject], ...]


@dataclass(frozen=True, slots=True)
class TrueWay:
    """What a robot walks that leaves a crossing by an exit, in the building's frame."""

    start: int
    exit: int
    end: int | None
    """Number of the turning point it leads to; None for the end of a way."""
    last: Point
    """Where it ends, or comes into the turning point."""
    arrival: float
    length: float
    looks: tuple[Look, ...]
    """The first is from in the crossing."""


class TrueMaps:
    """The whole map of a site, as who sets out from some start would draw it."""

    def __init__(self, site: Site) -> None:
        """Walk all ways of a site in the mind."""
        self.numbers = {
            point.id: number for number, point in enumerate(site.turning_points, 1)
        }
        """Of turning points, by id."""
        self._points = dict(enumerate(site.turning_points, 1))
        self._middles = {
            number: (point.polygon.centroid.x, point.polygon.centroid.y)
            for number, point in self._points.items()
        }
        self._scene = build_scene(site)
        self._now = mujoco.MjData(self._scene.model)
        mujoco.mj_forward(self._scene.model, self._now)
        self._tracks: dict[Thing, int] = {}

    @property
    def pointing_signs(self) -> set[int]:
        """Tracks of the signs that say where a place is, and are not there."""
        return {
            track
            for (thing, _), track in self._tracks.items()
            if points_elsewhere(thing.text or "")
        }

    def crossing_at(self, x: float, y: float) -> int:
        """Return the number of the turning point at a place; 0 where there is none."""
        return int(self._crossings_at(np.array([x]), np.array([y]))[0])

    def floor_map(self, start: Pose, phrases: Iterable[str]) -> FloorMap:
        """Return the map, with these phrases looked for everywhere.

        It is in the frame of the start: its origin is there, and its heading is 0.
        """
        wanted = tuple(dict.fromkeys(phrases))
        floor = FloorMap()
        ways = list(self._ways)
        if self.crossing_at(start.x, start.y):
            del floor.crossings[0]
        else:
            floor.crossings[0].add_exit(math.pi)
            ways = [*self._ways_from_start(start), *ways]
        for number, point in self._points.items():
            place = in_frame(start, self._middles[number])
            exits = [wrap_angle(each.heading - start.heading) for each in point.exits]
            floor.crossings[number] = Crossing(number, place, exits)
        for way in ways:
            self._add_way(floor, start, way, frozenset(wanted))
        scores = self._scores(wanted)
        for way in ways:
            for number, look in enumerate(way.looks):
                seen = list(_sightings(look, scores, start, (way.start, way.exit)))
                if number == 0:
                    floor.note_view(way.start, way.exit, wanted, seen)
                for each in seen:
                    floor.note(each)
        return floor

    def _add_way(
        self, floor: FloorMap, start: Pose, way: TrueWay, asked: frozenset[str]
    ) -> None:
        if way.length < SHORTEST:
            floor.crossings[way.start].closed.add(way.exit)
            return
        known = floor.stretches.get((way.start, way.exit))
        if known is not None:
            floor.stretches[way.start, way.exit] = replace(known, asked=asked)
            return
        end = way.end
        if end is None:
            end = floor.new_dead_end(in_frame(start, way.last)).number
        arrival = wrap_angle(way.arrival - start.heading)
        floor.add_stretch(Stretch(way.start, way.exit, end, arrival, way.length, asked))

    def _scores(self, phrases: Iterable[str]) -> dict[int, list[tuple[str, float]]]:
        """Return the phrases that fit each thing, with their scores, by track."""
        found: dict[int, list[tuple[str, float]]] = {}
        for (thing, _), track in self._tracks.items():
            for phrase in phrases:
                score = match_score(phrase, thing)
                if score >= MATCH_THRESHOLD:
                    found.setdefault(track, []).append((phrase, score))
        return found

    # -- ways

    @cached_property
    def _ways(self) -> tuple[TrueWay, ...]:
        return tuple(
            self._way(number, exit, self._middles[number], leaving.heading, leaving.to)
            for number, point in self._points.items()
            for exit, leaving in enumerate(point.exits)
        )

    def _ways_from_start(self, start: Pose) -> Iterator[TrueWay]:
        for exit, heading in enumerate((start.heading, start.heading + math.pi)):
            yield self._way(0, exit, (start.x, start.y), wrap_angle(heading), None)

    def _way(
        self, start: int, exit: int, place: Point, heading: float, to: str | None
    ) -> TrueWay:
        """Go straight on to the next turning point, or to the end, and look."""
        straight = self._scene.straight_ways.way(place, heading, towards=to)
        line = shapely.LineString(straight.points)
        along = np.arange(0.0, straight.halt + STEP, STEP).clip(max=straight.halt)
        x, y = shapely.get_coordinates(shapely.line_interpolate_point(line, along)).T
        crossings = self._crossings_at(x, y)
        come = np.flatnonzero((crossings > 0) & (crossings != start))
        last = int(come[0]) if len(come) else len(along) - 1
        end = int(crossings[last]) if len(come) else None
        length = float(along[last])
        if end is not None:
            length += math.dist((x[last], y[last]), self._middles[end])
        elif crossings[last] == start > 0:
            length = 0.0
        ends = np.cumsum([math.dist(*piece) for piece in pairwise(straight.points)])
        pieces = np.searchsorted(ends[:-1], along)
        courses = [straight.courses[piece] for piece in pieces]
        looks = tuple(
            self._look(Pose(float(x[each]), float(y[each]), courses[each]))
            for each in range(0, last + 1, round(STRIDE / STEP))
        )
        there = float(x[last]), float(y[last])
        return TrueWay(start, exit, end, there, courses[last], length, looks)

    def _crossings_at(
        self, x: NDArray[np.float64], y: NDArray[np.float64]
    ) -> NDArray[np.int64]:
        """Return the numbers of the turning points at places, of several the nearest."""
        numbers = np.zeros(len(x), dtype=np.int64)
        least = np.full(len(x), np.inf)
        for number, point in self._points.items():
            middle = self._middles[number]
            distance = np.hypot(x - middle[0], y - middle[1])
            here = shapely.intersects_xy(point.polygon, x, y) & (distance < least)
            numbers[here], least[here] = number, distance[here]
        return numbers

    def _look(self, pose: Pose) -> Look:
        camera = camera_elsewhere(self._scene, self._now, pose)
        seen = camera.visible_objects(DETECTION_RANGE)
        return Look(pose, tuple((self._track(each), each) for each in seen))

    def _track(self, seen: VisibleObject) -> int:
        thing = seen.description, seen.position
        return self._tracks.setdefault(thing, len(self._tracks))


def in_frame(start: Pose, place: Point) -> Point:
    """Return a place of the building in the frame of a start."""
    dx, dy = place[0] - start.x, place[1] - start.y
    ux, uy = math.cos(start.heading), math.sin(start.heading)
    return dx * ux + dy * uy, dy * ux - dx * uy


def _sightings(
    look: Look,
    scores: Mapping[int, Sequence[tuple[str, float]]],
    start: Pose,
    stretch: tuple[int, int],
) -> Iterator[Sighting]:
    """Yield what fits a phrase in a look, as a walker notes it."""
    for track, seen in look.seen:
        for phrase, score in scores.get(track, ()):
            ahead = abs(seen.bearing) < AHEAD
            side = "ahead" if ahead else "left" if seen.bearing > 0 else "right"
            yield Sighting(
                phrase,
                seen.description.category,
                score,
                in_frame(
                    start, place_at_bearing(look.pose, seen.distance, seen.bearing)
                ),
                in_frame(start, (look.pose.x, look.pose.y)),
                seen.distance,
                track,
                stretch,
                side,
                seen.bearing,
            )


@dataclass(frozen=True, slots=True)
class Followed:
    """A plan that was followed in the mind: where it may end, and with what weight."""

    endings: tuple[Ending, ...]
    masses: NDArray[np.float64]
    """Of the endings, shares of all."""
    places: NDArray[np.float64]
    """Of the endings, metres, shape (n, 2)."""

    def share_at(self, goal: Point, within: float) -> float:
        """Return how likely the plan ends within so many metres of a goal."""
        there = [ends_at(each, goal, within) for each in self.endings]
        return float(self.masses[there].sum())

    @property
    def likeliest(self) -> Ending | None:
        """The heaviest ending of the likeliest place; None where the plan has none."""
        if not self.endings:
            return None
        about = [
            self.masses[self._near(each.place)].sum() if mass > LIGHT else 0.0
            for each, mass in zip(self.endings, self.masses, strict=True)
        ]
        near = self._near(self.endings[int(np.argmax(about))].place)
        return self.endings[int(np.argmax(np.where(near, self.masses, -1.0)))]

    def _near(self, place: Point) -> NDArray[np.bool_]:
        return np.hypot(*(self.places - np.array(place)).T) < SAME_PLACE


def ends_at(ending: Ending, goal: Point, within: float) -> bool:
    """Tell whether who arrives there comes within so many metres of a goal.

    One walks on through a door that opens by itself and under a hanging sign, and stops
    before a thing, or before the wall at the end of a way.
    """
    if ending.sighting is None:
        within += SHORT_OF_THE_END if ending.at < 0 else 0.0
    elif leads_inside(ending.sighting.label):
        within = max(within, BEYOND_SIGN)
    else:
        within += CLOSE
    return math.dist(ending.place, goal) < within


def follow(
    plan: RoutePlan,
    floor: FloorMap,
    starts: list[AssumedStart],
    model: Likelihoods,
    pointing_signs: set[int],
) -> Followed:
    """Weigh all that a plan may mean on a map."""
    things = Things(plan, floor, model)
    belief = Belief(plan, floor, model, things)
    belief.update(starts)
    arrivals = Arrivals(plan, floor, model, things)
    floor.refuted |= pointing_signs
    endings = tuple(each for each in arrivals.endings(belief) if each.mass > 0)
    masses = np.array([each.mass for each in endings])
    places = np.array([each.place for each in endings]).reshape(-1, 2)
    return Followed(endings, masses / masses.sum(), places)


def leads_inside(label: str) -> bool:
    """Tell whether one goes on through what has this label, or under it."""
    return OPENS.search(label) is not None or "hanging" in label


def phrases_of(plan: RoutePlan) -> tuple[str, ...]:
    """Return all that one would look for who follows a plan."""
    floor, model = FloorMap(), Likelihoods()
    things = Things(plan, floor, model)
    phrases = [ANY_FLOOR, *Recognition(plan.arrival, floor, model, things).names]
    for number in range(len(plan.legs) + 1):
        outlook = outlook_of(plan, number)
        phrases += [*things.phrases(number), *outlook.ahead, *outlook.behind]
    return tuple(each for each in dict.fromkeys(phrases) if len(each) <= LONGEST_QUERY)


class TurnsOfRoute:
    """The crossings that who walks a route passes, and where they have to turn."""

    def __init__(self, route: Route, graph: TurningPointGraph) -> None:
        """Find them; corners without a choice, bends and the goal's door may be left out."""
        facts = RouteFacts(graph, route)
        goal = shapely.Point(route.line.coords[-1])
        self.passed = {point for _, point in graph.passed[route.id]}
        self.needed = {
            turn.at
            for turn in route.turns
            if not turn.direction.startswith("slight")
            and (heading := facts.headings.get(turn.at)) is not None
            and graph.only_way(turn.at, heading) is None
            and graph.points[turn.at].polygon.centroid.distance(goal) > BEYOND_SIGN
        }

    def are_taken(self, segment: Segment, numbers: Mapping[str, int]) -> bool:
        """Tell whether an alignment takes the turns of the route, and no others."""
        took = {at for _, at in segment.turns}
        took |= {each.at for each in segment.slips if each.kind == "turn left out"}
        needed = {numbers[point] for point in self.needed}
        passed = {0, *(numbers[point] for point in self.passed)}
        return needed <= took <= passed


@dataclass(frozen=True, slots=True)
class Meaning:
    """What the plan of a text means on the true map."""

    episode: Episode
    is_goal: bool
    """Whether it leads to the goal."""
    off: float
    """Metres from the likeliest place to end to the goal; infinite where there is none."""
    share_at_goal: float
    takes_the_turns: bool
    story: tuple[str, ...]
    """What the heaviest alignment to the likeliest place takes for the turns."""


class Readings:
    """Follows plans on the true maps of their sites."""

    def __init__(self, sites: Mapping[str, Site]) -> None:
        """Take the sites; their maps are made when they are first asked for."""
        self._sites = sites
        self._maps: dict[str, TrueMaps] = {}
        self._graphs: dict[str, TurningPointGraph] = {}

    def followed(
        self, episode: Episode, plan: RoutePlan, model: Likelihoods
    ) -> Followed:
        """Follow what was read of a text."""
        maps = self.maps(episode.instruction.site)
        start = episode.start
        floor = maps.floor_map(start, phrases_of(plan))
        starts = starts_ahead(model, floor, maps.crossing_at(start.x, start.y))
        return follow(plan, floor, starts, model, maps.pointing_signs)

    def meaning(self, episode: Episode, plan: RoutePlan, model: Likelihoods) -> Meaning:
        """Return where a plan leads, and by which turns."""
        told = episode.instruction
        followed = self.followed(episode, plan, model)
        best = followed.likeliest
        goal = in_frame(episode.start, episode.goal)
        if best is None:
            return Meaning(episode, False, math.inf, 0.0, False, ("it ends nowhere",))
        route = self._sites[told.site].find_route(told.reference_route)
        turns = TurnsOfRoute(route, self._graph(told.site))
        maps = self.maps(told.site)
        names = {number: point for point, number in maps.numbers.items()}
        ends = [
            f"turn {leg + 1} at {names.get(at, 'the start')}"
            for leg, at in best.segment.turns
        ]
        slips = [
            f"{each.kind} ({each.leg + 1}) at {names.get(each.at, 'a dead end')}"
            for each in best.segment.slips
        ]
        return Meaning(
            episode,
            ends_at(best, goal, SUCCESS_DISTANCE),
            math.dist(best.place, goal),
            followed.share_at(goal, SUCCESS_DISTANCE),
            turns.are_taken(best.segment, maps.numbers),
            (*ends, *slips, best.reason),
        )

    def maps(self, site: str) -> TrueMaps:
        """Return the maps of a site."""
        if site not in self._maps:
            self._maps[site] = TrueMaps(self._sites[site])
        return self._maps[site]

    def _graph(self, site: str) -> TurningPointGraph:
        if site not in self._graphs:
            self._graphs[site] = TurningPointGraph(self._sites[site])
        return self._graphs[site]


def rows(meanings: Sequence[Meaning]) -> Iterator[dict[str, object]]:
    """Yield what is told of texts by half, errors and study, the other half first."""
    for half, name in HALVES.items():
        for has_error in (False, True):
            for study in ("online", "onsite"):
                these = [
                    each
                    for each in meanings
                    if is_of_split(each.episode.instruction, half)
                    and bool(each.episode.instruction.failures) == has_error
                    and each.episode.instruction.study == study
                ]
                values = {
                    "goal": [float(each.is_goal) for each in these],
                    "turns": [float(each.takes_the_turns) for each in these],
                    "route": [
                        float(each.is_goal and each.takes_the_turns) for each in these
                    ],
                    "belief": [each.share_at_goal for each in these],
                }
                units = [each.episode.instruction.participant for each in these]
                yield {
                    "half": name,
                    "texts": "with an error" if has_error else "correct",
                    "study": study,
                    "n": len(these),
                    **estimates(values, units),
                }


def ceiling_table(meanings: Sequence[Meaning], reader: str) -> Table:
    """Return the shares of texts that lead to the goal, and that take the route."""
    return Table(
        f"Plans followed in the mind on the true maps ({reader})",
        (
            Column("half", "Half", role="group"),
            Column("texts", "Texts", role="label"),
            Column("study", "Study", role="label"),
            Column("n", "n"),
            share("goal", "Goal", "higher"),
            share("turns", "Turns", "higher"),
            share("route", "Both", "higher"),
            share("belief", "Belief at the goal", "higher"),
        ),
        tuple(rows(meanings)),
        notes=(
            f"Goal: who ends at the likeliest place comes within {SUCCESS_DISTANCE:g} m of "
            f"it (the place is up to {BEYOND_SIGN:g} m away where one goes on through a "
            "door or under a sign, 0.7 m more before a thing). "
            "Turns: its heaviest alignment takes those of the route and no others; corners "
            "without a choice and bends may be left out. Belief: share of it at "
            "such places. Intervals: 95 %, participants drawn again.",
        ),
        name="ceiling",
    )


def readings_otherwise(meanings: Sequence[Meaning]) -> Iterator[str]:
    """Yield a line for each text without an error that does not mean its route."""
    for each in sorted(meanings, key=lambda each: each.share_at_goal):
        told = each.episode.instruction
        if told.failures or (each.is_goal and each.takes_the_turns):
            continue
        yield (
            f"{told.id}: ends {each.off:.0f} m off, belief at the goal "
            f"{each.share_at_goal:.2f}: {'; '.join(each.story)}"
        )


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.ceiling")
    parser.add_argument(
        "--reader",
        choices=("plans", "grammar"),
        default="plans",
        help="recorded plans of a language model, or those of the grammar",
    )
    parser.add_argument(
        "--list", action="store_true", help="also what plans mean that miss their route"
    )
    parser.add_argument(
        "--sample", type=int, metavar="N", help="only so many texts, alike many a route"
    )
    options = parser.parse_args()
    corpus, readings = load_corpus(), Readings(load_corpus().sites)
    plans, grammar = recorded_plans("plans"), GrammarReader()
    meanings: list[Meaning] = []
    for episode in sample(corpus.episodes, options.sample):
        told = episode.instruction
        if options.reader == "grammar":
            plan = grammar.read(told.text, Journal())
        else:
            plan = plans[told.id]
        meanings.append(readings.meaning(episode, plan, Likelihoods()))
    print(ceiling_table(meanings, options.reader))
    if options.list:
        print("\n".join(readings_otherwise(meanings)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
