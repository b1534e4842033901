"""Where the destination may be, and how likely it is there."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from memorymaze.agents.guide.alignments import Frontier, Segment, Visit, mass_of
from memorymaze.agents.guide.belief import Belief
from memorymaze.agents.guide.likelihoods import (
    Likelihoods,
    Weights,
    ends_after,
    junction_ratio,
    length_ratio,
    passings_ratio,
    untold_length,
    without_turn,
)
from memorymaze.agents.guide.recognising import BESIDE, Recognition
from memorymaze.agents.guide.said_of_legs import counted_since, rest_to_come
from memorymaze.agents.guide.things import Things
from memorymaze.agents.walking.choices import choices_at
from memorymaze.agents.walking.floor_map import (
    FloorMap,
    Point,
    Sighting,
    Stretch,
    distance_to_line,
    metres_along,
)
from memorymaze.agents.walking.outlooks import junction_at_the_end
from memorymaze.basics.geometry.pose import moved
from memorymaze.language.plans import Length, RoutePlan, Turn

SAME_PLACE = 3.0
"""Metres; places to arrive at that are nearer to each other are one."""
ANYWHERE = 2.0
"""Metres between two places at which a way may end where nothing was seen."""
BACK_AT_START = 0.05
"""Weight of a place where one has set off from: nobody is told the way to there."""


@dataclass(frozen=True)
class Ending:
    """A place to arrive at, with all alignments that end there."""

    at: int
    """Crossing to start from."""
    exit: int | None
    """Exit to leave it by; None when the place is the crossing."""
    distance: float
    """Metres from the crossing."""
    place: Point
    weights: Weights
    segment: Segment
    sighting: Sighting | None
    """What was seen there; None when nothing was."""
    reason: str

    @cached_property
    def mass(self) -> float:
        """How much of the belief ends there, unnormalised."""
        return mass_of(self.weights)


def endings_at(endings: Iterable[Ending], place: Point) -> list[Ending]:
    """Return those that are at a place."""
    return [each for each in endings if math.dist(each.place, place) < SAME_PLACE]


class Arrivals:
    """Finds the places where a walk may end."""

    def __init__(
        self, plan: RoutePlan, floor: FloorMap, model: Likelihoods, things: Things
    ) -> None:
        """Take the plan, the map that the walk draws, and how speakers are."""
        self._plan = plan
        self._arrival = plan.arrival
        self._legs = len(plan.legs)
        self._floor = floor
        self._model = model
        self._things = things
        self.destination = Recognition(plan.arrival, floor, model, things)
        self.is_told = (
            self.destination.is_named
            or bool(plan.arrival.mentions)
            or not self._may_be_anywhere
        )
        """Whether anything is told by which one knows the place: a likely name, a thing, or
        how far it is."""

    def endings(self, belief: Belief) -> list[Ending]:
        """Return all places to arrive at."""
        found: list[Ending] = []
        self._candidates = [*self.destination.sightings()]
        self._candidates_on: dict[tuple[int, int], list[tuple[Sighting, float]]] = {}
        for visit in belief.visits:
            if visit.stretch is None:
                found.extend(self._at_crossing(visit))
            else:
                found.extend(self._on_stretch(visit))
        for frontier in belief.frontiers.values():
            found.extend(self._ahead(frontier))
        start = self._floor.crossings[belief.start].place
        return [
            replace(each, weights=each.weights * BACK_AT_START)
            if math.dist(each.place, start) < SAME_PLACE
            else each
            for each in found
        ]

    def _on_stretch(self, visit: Visit) -> Iterator[Ending]:
        segment, stretch = visit.segment, visit.stretch
        assert stretch is not None
        start = self._floor.crossings[stretch.start].place
        end = self._floor.crossings[stretch.end].place
        # Many alignments pass one stretch.
        key = stretch.start, stretch.exit
        if key not in self._candidates_on:
            self._candidates_on[key] = [*self._find_on(stretch, start, end)]
        for sighting, along in self._candidates_on[key]:
            ratio = self.destination.seen(sighting, (start, end), (*segment.line, end))
            yield Ending(
                stretch.start,
                stretch.exit,
                along,
                sighting.place,
                self._weigh(visit, along, _on_line(start, end, along)) * ratio,
                segment,
                sighting,
                f"{sighting.phrase} seen",
            )
        for metres, share, reason in self._where_unseen(segment, stretch.length):
            if 0.5 < metres < stretch.length - 0.5:
                there = _on_line(start, end, metres)
                yield Ending(
                    stretch.start,
                    stretch.exit,
                    metres,
                    there,
                    self._weigh(visit, metres, there) * self.destination.unseen * share,
                    segment,
                    None,
                    reason,
                )

    def _where_unseen(
        self, segment: Segment, length: float
    ) -> Iterator[tuple[float, float, str]]:
        """Yield how far along a stretch it may be unseen, how likely, and why there."""
        told = self._arrival.length
        if segment.lost:
            return
        if told is not None and told.unit != "places":
            yield told.metres - segment.walked, 1.0, f"{told.metres:.0f} m walked"
        if self._may_be_anywhere:
            for number in range(math.ceil(length / ANYWHERE)):
                metres = (number + 0.5) * ANYWHERE
                share = self._share_about(segment.walked + metres)
                yield metres, share, "all turns made"

    @cached_property
    def _may_be_anywhere(self) -> bool:
        """Whether nothing says how far from the last turn it is, or at what crossing."""
        arrival = self._arrival
        if arrival.nth is not None:
            return False
        at_a_crossing = arrival.at_end or junction_at_the_end(arrival) is not None
        return arrival.length is None and not (
            at_a_crossing or self.destination.is_told_apart
        )

    def _share_about(self, walked: float) -> float:
        """Return how likely it is about so far from the last turn."""
        begin, end = walked - ANYWHERE / 2, walked + ANYWHERE / 2
        return ends_after(self._model, begin) - ends_after(self._model, end)

    def _ahead(self, frontier: Frontier) -> Iterator[Ending]:
        """Yield what is in sight along a way that was not walked yet."""
        crossing = self._floor.crossings[frontier.at]
        heading = crossing.exits[frontier.exit]
        for phrase in self.destination.phrases:
            for sighting in self._floor.seen_ahead(phrase, frontier.at, heading):
                if not self.destination.may_be(sighting):
                    continue
                along = math.dist(crossing.place, sighting.place)
                end = moved(crossing.place, heading, along)
                for segment, _, _ in frontier.alignments:
                    if segment.leg == self._legs:
                        yield Ending(
                            frontier.at,
                            frontier.exit,
                            along,
                            sighting.place,
                            segment.weights
                            * self._fit(segment, along)
                            * self.destination.seen(
                                sighting,
                                (crossing.place, end),
                                (*segment.line, end),
                            )
                            * self._things.floors_ahead(
                                self._legs, frontier.at, frontier.exit
                            ),
                            segment,
                            sighting,
                            f"{sighting.phrase} seen ahead",
                        )

    def _find_on(
        self, stretch: Stretch, start: Point, end: Point
    ) -> Iterator[tuple[Sighting, float]]:
        """Yield what may be the place on a stretch, and how many metres along it."""
        for sighting in self._candidates:
            if distance_to_line(sighting.place, (start, end)) > BESIDE:
                continue
            if distance_to_line(sighting.seen_from, (start, end)) > BESIDE:
                continue
            along = metres_along(sighting.place, start, end)
            if not self._is_off(sighting, stretch, along):
                yield sighting, along

    def _is_off(self, sighting: Sighting, stretch: Stretch, along: float) -> bool:
        """Tell whether something beyond an end of a stretch is on another way there."""
        start = self._floor.crossings[stretch.start]
        end = self._floor.crossings[stretch.end]
        at_end = along >= math.dist(start.place, end.place)
        if along > 0 and not at_end:
            return False
        crossing = end if at_end else start
        return any(
            sighting
            in self._floor.seen_ahead(sighting.phrase, crossing.number, heading)
            for exit, heading in crossing.open_exits()
            if at_end or exit != stretch.exit
        )

    def _at_crossing(self, visit: Visit) -> Iterator[Ending]:
        arrival, model, segment = self._arrival, self._model, visit.segment
        if not segment.walked and not arrival.on_the_spot:
            return
        crossing = self._floor.crossings[segment.at]
        choices = choices_at(crossing.exits, crossing.closed, segment.heading)
        ratio = self.destination.unseen
        goes_on = choices.forward is not None
        if arrival.at_end:
            ratio *= 2 * (1 - model.kind_right if goes_on else model.kind_right)
        elif segment.walked and not segment.lost and self._may_be_anywhere:
            ratio *= (
                self._share_about(segment.walked)
                if goes_on
                else ends_after(model, segment.walked - ANYWHERE / 2)
            )
        elif goes_on and arrival.length is None and segment.walked:
            ratio *= model.arrival_open
        junction = junction_at_the_end(arrival)
        if junction is not None:
            ratio *= junction_ratio(model, Turn("either", junction=junction), choices)
        yield Ending(
            segment.at,
            None,
            0.0,
            crossing.place,
            self._weigh(visit, 0.0, crossing.place) * ratio,
            segment,
            None,
            "end of the way" if not goes_on else "all turns made",
        )

    def here(self, segment: Segment, sighting: Sighting, walked: float) -> Weights:
        """Weigh an alignment with this, just seen on its way, as its destination."""
        to_come = self._legs - segment.leg
        weights = self._with_legs_missing(segment)
        if not to_come:
            weights = weights * self._fit(segment, walked + sighting.distance)
        return weights * self.destination.seen(sighting)

    def beyond(self, segment: Segment, sighting: Sighting, walked: float) -> Weights:
        """Weigh an alignment with another of the same name as its destination, further on.

        A place has signs and more than one door.
        """
        weights = self._with_legs_missing(segment)
        length = self._arrival.length
        if segment.leg == self._legs and length is not None and not segment.lost:
            there = walked + sighting.distance
            line = (*segment.line, sighting.place)
            further = segment._replace(walked=segment.walked + there, line=line)
            weights = weights * rest_to_come(self._model, self._things, further, length)
        return weights * self.destination.again(sighting)

    def _with_legs_missing(self, segment: Segment) -> Weights:
        weights = segment.weights
        for leg in self._plan.legs[segment.leg :]:
            weights = without_turn(self._model, weights, leg)
        return weights

    def _weigh(self, visit: Visit, further: float, place: Point) -> Weights:
        """Weigh all that was said of the last stretch against one that ends at a place."""
        segment, stretch = visit.segment, visit.stretch
        line, asked = segment.line, segment.asked or frozenset()
        if stretch is not None:
            line = (*line, place)
            asked = stretch.asked if segment.asked is None else asked & stretch.asked
        return self._things.weigh(
            segment.weights * self._fit(segment, further, place),
            self._legs,
            line,
            asked,
            place,
            segment.at if stretch is None else None,
        )

    def _is_junction(self, segment: Segment) -> bool:
        crossing = self._floor.crossings[segment.at]
        choices = choices_at(crossing.exits, crossing.closed, segment.heading)
        return len(choices.ways) > 1

    def _fit(
        self, segment: Segment, further: float, place: Point | None = None
    ) -> Weights:
        """Weigh what was said of the last stretch against one that ends here."""
        arrival, model = self._arrival, self._model
        walked = segment.walked + further
        fit = np.ones(segment.weights.shape[1])
        if segment.lost:
            return fit
        if arrival.length is not None and walked > 0:
            fit = fit * self._length_fit(segment, arrival.length, further, place)
        elif arrival.length is None:
            fit = fit * untold_length(model, walked)
        if arrival.passings:
            fit = fit * passings_ratio(
                model, arrival.passings, segment.left, segment.right, segment.junctions
            )
        return fit

    def _length_fit(
        self, segment: Segment, length: Length, further: float, place: Point | None
    ) -> Weights:
        """Weigh the length of the last stretch; neutral where counting has not begun."""
        beyond = bool(further)
        line = (*segment.line, place) if place and beyond else segment.line
        since = counted_since(self._things, segment._replace(line=line), length.after)
        if since is None:
            return np.ones(segment.weights.shape[1])
        metres, places = since.metres, since.places
        junctions = since.junctions + bool(places)
        if length.after is None:
            metres, places = segment.walked + further, segment.places + beyond
            junctions = segment.junctions + 1
        if not (beyond or self._is_junction(segment)):
            junctions = places  # where who counts junctions alone does not end
        return length_ratio(self._model, length, metres, places, junctions)


def _on_line(start: Point, end: Point, metres: float) -> Point:
    share = metres / max(math.dist(start, end), 1e-6)
    return (
        start[0] + share * (end[0] - start[0]),
        start[1] + share * (end[1] - start[1]),
    )
