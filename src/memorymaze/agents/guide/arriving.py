"""Where the destination may be, and how likely it is there."""

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, repeat

import numpy as np

from memorymaze.agents.guide.alignments import Frontier, Segment, Visit, mass_of
from memorymaze.agents.guide.belief import Belief
from memorymaze.agents.guide.likelihoods import (
    MOST_SEEN,
    Likelihoods,
    Weights,
    ends_after,
    junction_ratio,
    length_ratio,
    passings_ratio,
    seen_ratio,
    untold_length,
    without_turn,
)
from memorymaze.agents.guide.said_of_legs import counted_since, rest_to_come
from memorymaze.agents.guide.signs import named_by_use
from memorymaze.agents.guide.things import Things, passed_after
from memorymaze.agents.walking.approaching import DOOR, is_sign
from memorymaze.agents.walking.choices import choices_at
from memorymaze.agents.walking.floor_map import (
    FloorMap,
    Point,
    Sighting,
    Stretch,
    distance_to_line,
    is_on_a_pointer,
    metres_along,
    side_of_line,
)
from memorymaze.agents.walking.outlooks import junction_at_the_end
from memorymaze.language.nouns import general_words, kin_of
from memorymaze.language.plans import Length, RoutePlan, Turn
from memorymaze.language.reading import is_common, is_floor, place_on_sign

BESIDE = 4.0
"""Metres from the line of a stretch within which a destination is on it."""
REACH = 8.0
"""Metres of way on which the destination would count as being there."""
SAME_PLACE = 3.0
"""Metres; places to arrive at that are nearer to each other are one."""
ANYWHERE = 2.0
"""Metres between two places at which a way may end where nothing was seen."""
MOST_WIDER = 4
"""More general words for a destination that are looked for."""

UNIQUE = 0.3
"""How often what fits a name told of a destination in full is met elsewhere, beside other
things."""
COMMON_UNSEEN = 0.4
"""Weight of a place where a thing of a kind that is everywhere was not seen."""
LIKELY_MEANT = 0.5
"""Probability that a name is the destination's from which on one stops at it at once."""
IN_FULL = 0.95
"""Score from which on something fits a name in full."""
NTH = 3.0, 0.3, 0.1
"""Weights of what is counted rightly, one off, and more."""
BACK_AT_START = 0.05
"""Weight of a place where one has set off from: nobody is told the way to there."""

BY_USE = 0.4
"""Score of a sign whose words are like what is told in meaning."""

_ROOMS = frozenset({"room", "office", "classroom"})
"""Of a room without a name a camera sees the door."""
_NUMBER = re.compile(r"\d")


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
        self._counted: dict[str, list[int]] = {}
        """Tracks of what bears a name told, in the order in which it was seen."""
        self._is_told_apart = any(is_floor(m.phrase) for m in plan.arrival.mentions)
        """Whether the floor is told that it stands on: then there may be several."""
        self.refuted: set[int] = set()
        """Tracks of what was found not to be the destination."""
        names = with_door(plan.arrival.destinations)
        numbered = tuple(each for each in names if _NUMBER.search(each))
        # Any office is not office 2347: where a number is told, only it will do.
        names = numbered or names
        # What has a name of its own tells a place better than what is everywhere.
        names = tuple(sorted(names, key=is_common))
        self._first = tuple(variants(names[0])) if names else ()
        told = dict.fromkeys([*self._first, *names])
        self.names = tuple(name for name in told if not is_floor(name))
        """What to look for, the best first."""
        self._name = names[0] if names else ""
        self.kin = tuple(each for each in wider(self._name) if each not in told)
        """More general words, for what is near in meaning: who sees it may call it so."""
        doubts = chain(plan.arrival.unclear_names, repeat(0.0))
        self._meant = {
            name: 1 - doubt
            for name, doubt in zip(plan.arrival.destinations, doubts, strict=False)
        }
        """How likely each name is that of the destination."""
        self._unmeant = math.prod(1 - each for each in self._meant.values())
        """How likely none of the names told is."""
        best = next(iter(self._meant.values()), 1.0)
        of_name = self._meant.get(self._name, best)
        for name in (*self._first, *self.names, *self.kin):
            self._meant.setdefault(name, of_name)
        self.at_once = tuple(
            each
            for each in self._first
            if not is_common(each) and self._meant[each] >= LIKELY_MEANT
        )
        """Names at which to stop without having seen what else the way has."""
        likeliest = max(self._meant.values(), default=0.0)
        self.is_told = (
            likeliest >= LIKELY_MEANT
            or bool(plan.arrival.mentions)
            or not self._may_be_anywhere
        )
        """Whether anything is told by which one knows the place: a likely name, a thing, or
        how far it is."""

    def endings(self, belief: Belief) -> list[Ending]:
        """Return all places to arrive at."""
        found: list[Ending] = []
        self._candidates = [*self._sightings()]
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
            ratio = self.seen(sighting, (start, end), (*segment.line, end))
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
                    self._weigh(visit, metres, there) * self._unseen * share,
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
        return arrival.length is None and not (at_a_crossing or self._is_told_apart)

    def _share_about(self, walked: float) -> float:
        """Return how likely it is about so far from the last turn."""
        begin, end = walked - ANYWHERE / 2, walked + ANYWHERE / 2
        return ends_after(self._model, begin) - ends_after(self._model, end)

    def _ahead(self, frontier: Frontier) -> Iterator[Ending]:
        """Yield what is in sight along a way that was not walked yet."""
        crossing = self._floor.crossings[frontier.at]
        heading = crossing.exits[frontier.exit]
        for phrase in (*self.names, *self.kin):
            for sighting in self._floor.seen_ahead(phrase, frontier.at, heading):
                if not self._may_be_it(sighting):
                    continue
                along = math.dist(crossing.place, sighting.place)
                end = (
                    crossing.place[0] + along * math.cos(heading),
                    crossing.place[1] + along * math.sin(heading),
                )
                for segment, _, _ in frontier.alignments:
                    if segment.leg == self._legs:
                        yield Ending(
                            frontier.at,
                            frontier.exit,
                            along,
                            sighting.place,
                            segment.weights
                            * self._fit(segment, along)
                            * self.seen(
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
            for exit, heading in enumerate(crossing.exits)
            if exit not in crossing.closed and (at_end or exit != stretch.exit)
        )

    def _at_crossing(self, visit: Visit) -> Iterator[Ending]:
        arrival, model, segment = self._arrival, self._model, visit.segment
        if not segment.walked and not arrival.on_the_spot:
            return
        crossing = self._floor.crossings[segment.at]
        choices = choices_at(crossing.exits, crossing.closed, segment.heading)
        ratio = self._unseen
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
        return weights * self.seen(sighting)

    def beyond(self, segment: Segment, sighting: Sighting, walked: float) -> Weights:
        """Weigh an alignment with another of the same name as its destination, further on.

        A place has signs and more than one door.
        """
        nth = self._arrival.nth
        later = self._base(sighting) * self._model.name_again
        if nth is not None and nth > 0:
            later *= NTH[self._number_of(sighting) + 1 >= nth]
        weights = self._with_legs_missing(segment)
        length = self._arrival.length
        if segment.leg == self._legs and length is not None and not segment.lost:
            there = walked + sighting.distance
            line = (*segment.line, sighting.place)
            further = segment._replace(walked=segment.walked + there, line=line)
            weights = weights * rest_to_come(self._model, self._things, further, length)
        return weights * later

    def _with_legs_missing(self, segment: Segment) -> Weights:
        weights = segment.weights
        for leg in self._plan.legs[segment.leg :]:
            weights = without_turn(self._model, weights, leg)
        return weights

    def seen(
        self,
        sighting: Sighting,
        line: tuple[Point, ...] = (),
        since_turn: tuple[Point, ...] = (),
    ) -> float:
        """Weigh something seen as the destination, by who walks along a line.

        `since_turn` is the whole way since the last turn, of which that is the end.
        """
        meant = self._meant[sighting.phrase]
        return meant * self._as_told(sighting, line, since_turn) + 1 - meant

    def _as_told(
        self, sighting: Sighting, line: tuple[Point, ...], since_turn: tuple[Point, ...]
    ) -> float:
        """Weigh something seen by its name, its side, and which of several it is."""
        arrival, common = self._arrival, is_common(sighting.phrase)
        ratio = self._base(sighting)
        ratio *= self._things.side_ratio(arrival.side, sighting, line)
        if arrival.side == "ahead" and common:
            ratio *= 1.3 if sighting.side == "ahead" else 0.6
        if arrival.nth is not None and arrival.nth > 0:
            number = (
                self._number_along(sighting, since_turn)
                if common
                else self._number_of(sighting)
            )
            off = abs(number + 1 - arrival.nth)
            if off or self.only_names(sighting):
                return min(ratio, 1.0) * NTH[min(max(off, 1), 2)]
            # Most ways have a second door.
            ratio *= 1.0 if common else NTH[0]
        return ratio

    def _base(self, sighting: Sighting) -> float:
        model = self._model
        rate, most = self._things.rate(sighting.phrase, sighting), MOST_SEEN
        if sighting.phrase in self.kin:
            rate = max(rate, model.common_rate)
        elif sighting.score >= IN_FULL and not (
            is_common(sighting.phrase) or self._is_told_apart
        ):
            rate, most = UNIQUE * rate, MOST_SEEN / UNIQUE
        there = (1 - model.misnamed) * model.detected * sighting.score
        ratio = seen_ratio(rate, REACH, there, most)
        if sighting.phrase not in self._first:
            ratio **= 0.6
        if self.only_names(sighting):
            ratio **= 0.7
        return ratio

    def _number_along(self, sighting: Sighting, line: tuple[Point, ...]) -> int:
        """Return how many others of a common name one passes before it on its side."""
        here = passed_after(sighting.place, line)
        side = self._arrival.side
        return sum(
            each.track != sighting.track
            and distance_to_line(each.place, line) <= BESIDE
            and (
                side not in {"left", "right"} or side_of_line(each.place, line) == side
            )
            and (after := passed_after(each.place, line)) is not None
            and (here is None or after < here)
            for each in self._floor.seen(sighting.phrase)
        )

    def _number_of(self, sighting: Sighting) -> int:
        """Return how many others of a name told were seen before one, without signs."""
        counted = self._counted.setdefault(sighting.phrase, [])
        if sighting.track in counted:
            return counted.index(sighting.track)
        on_side = sighting.side in {self._arrival.side, "ahead"}
        if self.only_names(sighting) or not (
            on_side or self._arrival.side in {None, "ahead"}
        ):
            return len(counted)
        counted.append(sighting.track)
        return len(counted) - 1

    def _sightings(self) -> Iterator[Sighting]:
        for phrase in (*self.names, *self.kin):
            yield from filter(self._may_be_it, self._floor.seen(phrase))
        for text, name in named_by_use(self.names, self._floor.texts):
            phrase, track = f"sign that says {text.phrase}", -text.track
            if phrase not in self.names:
                self._meant.setdefault(phrase, self._meant[name])
                sign = replace(
                    text, phrase=phrase, label="sign", score=BY_USE, track=track
                )
                if self._may_be_it(sign):
                    yield sign

    def _may_be_it(self, sighting: Sighting) -> bool:
        if sighting.track in self.refuted:
            return False
        if is_on_a_pointer(sighting, self._floor.texts):
            return False
        is_told = sighting.phrase not in self.kin
        return is_told or is_kin(sighting.label, self._name)

    def only_names(self, sighting: Sighting) -> bool:
        """A sign that says `Library` is not the library."""
        return is_sign(sighting.label) and place_on_sign(sighting.phrase) is None

    @cached_property
    def _unseen(self) -> float:
        """Weigh a place where nothing of the destination was seen."""
        if not self.names:
            return 1.0
        common = all(map(is_common, self.names))
        ratio = COMMON_UNSEEN if common else self._model.passed_by
        return (1 - self._unmeant) * ratio + self._unmeant

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


def with_door(names: tuple[str, ...]) -> tuple[str, ...]:
    """Return names of a destination; of a room without a name also what is seen of it."""
    if names and names[0].split()[-1] in _ROOMS and is_common(names[0]):
        return (DOOR, *names)
    return names


def wider(phrase: str) -> tuple[str, ...]:
    """Return more general words for a thing; none for what is told by a name of its own.

    >>> "furniture" in wider("information counter")
    True
    """
    if not phrase.islower() or is_common(phrase) or is_sign(phrase):
        return ()
    return general_words(phrase.split()[-1])[:MOST_WIDER]


def is_kin(label: str, phrase: str) -> bool:
    """Tell whether what is seen may be what somebody calls by another word."""
    return label.split()[-1] in kin_of(phrase.split()[-1])


def variants(phrase: str) -> list[str]:
    """Return a name, and its head alone: `robot` for `robot of human shape`.

    A sign is told by what it says: without that it may be any.
    """
    head = re.split(r" (?:of|with|that|for) ", phrase)[0]
    alone = head != phrase and not is_common(head) and not is_sign(head)
    return [phrase, head] if alone else [phrase]


def _on_line(start: Point, end: Point, metres: float) -> Point:
    share = metres / max(math.dist(start, end), 1e-6)
    return (
        start[0] + share * (end[0] - start[0]),
        start[1] + share * (end[1] - start[1]),
    )
