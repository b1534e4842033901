"""What is true of a route, and what a right description of it says."""

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal

from shapely import LineString, Point
from shapely.ops import substring

from memorymaze.basics.errors import SitePlanError
from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.texts.writing.following import Followed, follow_steps
from memorymaze.texts.writing.steps import (
    SIDES,
    Beside,
    Cue,
    Step,
    StepPlan,
    ToldEnding,
    ToldStretch,
)
from memorymaze.texts.writing.things import Thing
from memorymaze.texts.writing.turning_point_graph import (
    TurningPointGraph,
    TurnSide,
    side_of_angle,
    side_of_turn,
)
from memorymaze.world.sites.records import Route, RouteTurn

BESIDE = 4.5
"""Metres from the way within which things are mentioned."""
SAME_DOOR = 1.0
"""Metres from the end of a route within which a door is not passed before."""
COMING = (0.0, 1.5, 3.0)
"""Metres before a turn from where one looks for what to turn at."""
SEEN_IN_COMING = 5.0
"""Metres within which somebody who comes to a turn notices what stands at it."""
AHEAD = math.radians(40)
"""A destination within this bearing lies ahead."""


@dataclass(frozen=True)
class RouteFacts:
    """One route of a site, ready to be described.

    Raises:
        SitePlanError: When read: the route's turns do not lie on its line, or no right
            description of it can be found.
    """

    graph: TurningPointGraph
    route: Route

    @cached_property
    def plan(self) -> StepPlan:
        """The right description with the plainest cues; it arrives."""
        turns = tuple(
            Step(f"turn{n}", side_of_turn(turn), cues[0], leg, turn.at)
            for n, (turn, cues, leg) in enumerate(
                zip(self.route.turns, self.cues, self.stretches[:-1], strict=True)
            )
        )
        plan = StepPlan(turns, self._ending, self.graph.things_by_words)
        found = self.follow(plan)
        if not found.arrived:
            raise SitePlanError(
                f"{self.graph.site.name}, {self.route.id}: expected turns that lead to "
                f"the goal, got a walk that does not arrive ({found.lost or found.end}); "
                "check the exits of the turning points on the route"
            )
        return plan

    def follow(self, plan: StepPlan) -> Followed:
        """Follow a plan for this route."""
        return follow_steps(self.graph, self.route, plan)

    def is_right(self, plan: StepPlan) -> bool:
        """Tell whether a plan arrives, turning where it should, in either way of counting.

        Some count a corner without a choice among the ways on its side and some do not.
        """
        told = tuple(turn.at for turn in plan.turns if turn.told)
        return all(each.arrived and each.turned == told for each in self._both(plan))

    def is_wrong(self, plan: StepPlan) -> bool:
        """Tell whether a plan does not arrive, in either way of counting."""
        return not any(each.arrived for each in self._both(plan))

    def _both(self, plan: StepPlan) -> tuple[Followed, Followed]:
        counted = follow_steps(self.graph, self.route, plan, corners_counted=True)
        return self.follow(plan), counted

    @cached_property
    def stops(self) -> tuple[float, ...]:
        """Metres along the line where the turns are, in order."""
        stops: list[float] = []
        passed = iter(self.graph.passed[self.route.id])
        for turn in self.route.turns:
            found = next((at for at, point in passed if point == turn.at), None)
            if found is None:
                raise SitePlanError(
                    f"{self.graph.site.name}, {self.route.id}: expected its turns in "
                    f"order along its line, got {turn.at!r}, which is not met there"
                )
            stops.append(found)
        return tuple(stops)

    @cached_property
    def between(self) -> tuple[tuple[str, ...], ...]:
        """Turning points passed straight on before each turn, and after the last."""
        edges = (-1.0, *self.stops, math.inf)
        passed = self.graph.passed[self.route.id]
        return tuple(
            tuple(point for at, point in passed if low < at < high)
            for low, high in pairwise(edges)
        )

    @cached_property
    def headings(self) -> dict[str, float]:
        """The heading on coming to each turning point of the route, radians."""
        ways = self.graph.first_way(self.route)
        found: dict[str, float] = {}
        turns: dict[str, TurnSide] = {
            turn.at: side_of_turn(turn) for turn in self.route.turns
        }
        for _ in range(len(self.graph.passed[self.route.id]) + 1):
            if ways is None or ways.end is None:
                break
            found.setdefault(ways.end, ways.heading)
            side = turns.get(ways.end)
            onward = self.graph.leaving(ways.end, ways.heading, side)
            ways = onward or self.graph.only_way(ways.end, ways.heading)
        return found

    @cached_property
    def stretches(self) -> tuple[ToldStretch, ...]:
        """The stretches before each turn, and the last one."""
        edges = (0.0, *self.stops, self.route.line.length)
        stretches: list[ToldStretch] = []
        for n, (low, high) in enumerate(pairwise(edges)):
            turn = self.route.turns[n] if n < len(self.route.turns) else None
            stretches.append(self._stretch(low, high, self.between[n], turn))
        return tuple(stretches)

    @cached_property
    def cues(self) -> tuple[tuple[Cue, ...], ...]:
        """For every turn the cues that mean it, the plainest first."""
        first = [Cue("ordinal")] * len(self.route.turns)
        found: list[tuple[Cue, ...]] = []
        for n, turn in enumerate(self.route.turns):
            good = tuple(
                cue for cue in self._proposals(n) if self._leads_to(n, cue, first)
            )
            if not good:
                raise SitePlanError(
                    f"{self.graph.site.name}, {self.route.id}: expected a way to say "
                    f"where to turn {turn.direction} at {turn.at!r}, got none; check "
                    "its exits"
                )
            first[n] = good[0]
            found.append(good)
        return tuple(found)

    def _leads_to(self, n: int, cue: Cue, before: list[Cue]) -> bool:
        """Tell whether the n-th turn is made where it should be with this cue."""
        turns = [
            Step(
                str(k),
                side_of_turn(each),
                cue if k == n else before[k],
                ToldStretch(0),
                each.at,
            )
            for k, each in enumerate(self.route.turns[: n + 1])
        ]
        plan = StepPlan(tuple(turns), self._ending, {})
        wanted = tuple(turn.at for turn in turns)
        return self.follow(plan).turned == wanted

    def _proposals(self, n: int) -> Iterator[Cue]:
        turn = self.route.turns[n]
        heading = self.headings.get(turn.at)
        if heading is not None and self.graph.leaving(turn.at, heading, None) is None:
            if self.graph.only_way(turn.at, heading) is not None:
                yield Cue("forced")
            yield Cue("end")
        for ordinal in range(1, 7):
            yield Cue("ordinal", ordinal)
        counts = Counter(thing.words for thing in self.graph.things)
        marks = sorted(
            (thing for thing in self._things_at(n) if counts[thing.words] <= 2),
            key=lambda thing: thing.id,
        )
        for thing in marks:
            yield Cue("thing", words=thing.words)

    def _things_at(self, n: int) -> list[Thing]:
        """Return what marks the n-th turn for somebody who comes to it by the route."""
        point = self.graph.points[self.route.turns[n].at]
        line, stop = self.route.line, self.stops[n]
        eyes = [line.interpolate(max(0.0, stop - back)) for back in COMING]

        def is_seen(spot: Point) -> bool:
            return any(
                eye.distance(spot) <= SEEN_IN_COMING and self.graph.sees(eye, spot)
                for eye in eyes
            )

        return [
            thing
            for thing in self.graph.things
            if self.graph.is_seen_from(point, thing) and is_seen(Point(thing.position))
        ]

    def _stretch(
        self, low: float, high: float, points: tuple[str, ...], turn: RouteTurn | None
    ) -> ToldStretch:
        line = substring(self.route.line, low, high)
        if not isinstance(line, LineString) or line.length < 0.01:
            return ToldStretch(0.0)
        openings: list[Literal["left", "right"]] = []
        for point in points:
            heading = self.headings.get(point)
            for side in SIDES:
                if (
                    heading is not None
                    and self.graph.leaving(point, heading, side) is not None
                ):
                    openings.append(side)
        parts = [*self.graph.site.corridors, *self.graph.site.areas]
        part = max(parts, key=lambda p: p.polygon.intersection(line).length)
        return ToldStretch(
            length=line.length,
            beside=tuple(self._beside(line)),
            openings=tuple(openings),
            floor=part.floor_material,
            name=part.name,
            beyond=None if turn is None else self._beyond(turn),
        )

    def _beside(self, line: LineString) -> Iterator[Beside]:
        seen: set[str] = set()
        found: list[tuple[float, Thing, Point]] = []
        for thing in self.graph.things:
            spot = Point(thing.position)
            if line.distance(spot) > BESIDE:
                continue
            at = line.project(spot)
            if not 0.3 < at < line.length - 0.3:
                continue
            if self.graph.sees(line.interpolate(at), spot):
                found.append((at, thing, spot))
        for at, thing, spot in sorted(found, key=lambda each: each[0]):
            if thing.words in seen:
                continue
            seen.add(thing.words)
            here, further = line.interpolate(at - 0.2), line.interpolate(at + 0.2)
            if here.distance(further) < 0.01:  # The way turns back here.
                further = line.interpolate(at)
            bearing = turn_between(
                heading_to((here.x, here.y), (further.x, further.y)),
                heading_to((here.x, here.y), (spot.x, spot.y)),
            )
            yield Beside(thing, side_of_angle(bearing), at)

    def _beyond(self, turn: RouteTurn) -> Thing | None:
        """Return what one meets who does not turn."""
        heading = self.headings.get(turn.at)
        onward = None if heading is None else self.graph.leaving(turn.at, heading, None)
        if onward is None or math.dist(onward.line[0], onward.line[-1]) < 4.0:
            return None
        counts = Counter(thing.words for thing in self.graph.things)
        line = LineString(onward.line)
        ahead = [
            (line.project(Point(thing.position)), thing)
            for thing in self.graph.things
            if counts[thing.words] == 1
            and line.distance(Point(thing.position)) < 3.0
            and self.route.line.distance(Point(thing.position)) > 5.0
            and (at := line.project(Point(thing.position))) > 3.0
            and self.graph.sees(line.interpolate(at), Point(thing.position))
        ]
        return min(ahead, key=lambda each: each[0], default=(0.0, None))[1]

    @cached_property
    def _ending(self) -> ToldEnding:
        line = self.route.line
        x, y = line.coords[-1][:2]
        site = self.graph.site
        goals = {
            **{t.id: t.position for t in site.landmarks},
            **{d.id: d.line.interpolate(0.5, normalized=True) for d in site.doors},
            **{r.id: r.polygon.centroid for r in site.rooms},
        }
        goal = goals.get(self.route.goal_landmark)
        side = None
        if goal is not None and math.dist((x, y), (goal.x, goal.y)) > 0.3:
            back = line.interpolate(max(0.0, line.length - 0.5))
            bearing = turn_between(
                heading_to((back.x, back.y), (x, y)),
                heading_to((x, y), (goal.x, goal.y)),
            )
            side = (
                side_of_angle(bearing)
                if AHEAD < abs(bearing) < math.radians(140)
                else None
            )
        near = [
            each.thing
            for each in self.stretches[-1].beside
            if math.dist(each.thing.position, (x, y)) < 5.0
            and each.thing.id != self.route.goal_landmark
        ]
        by = near[-1] if near else None
        last = self.stretches[-1]
        place = float(x), float(y)
        return ToldEnding(self.route.goal, place, last, side, by, nth=self._nth_door)

    @cached_property
    def _nth_door(self) -> int | None:
        """Which of several doors of one name on the last stretch it is, if there are."""
        doors = self.graph.site.doors
        goal = next((d for d in doors if d.id == self.route.goal_landmark), None)
        if goal is None or goal.label is None:
            return None
        stretch = substring(
            self.route.line, (0.0, *self.stops)[-1], self.route.line.length
        )
        before = 0
        for door in doors:
            middle = door.line.interpolate(0.5, normalized=True)
            at = stretch.project(middle)
            if (
                door.id != goal.id
                and door.label == goal.label
                and 0.0 < at < stretch.length - SAME_DOOR
                and stretch.distance(middle) <= BESIDE
                and self.graph.sees(stretch.interpolate(at), middle)
            ):
                before += 1
        return before + 1 if before else None
