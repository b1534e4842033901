"""Where the destination may be, and how to come close to it."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from operator import itemgetter

from memorymaze.agents.guide.arriving import INSIDE, OPENS, variants, with_door
from memorymaze.agents.rules.evidence import (
    Standing,
    junction_cost,
    length_cost,
    mentions_cost,
    passings_cost,
)
from memorymaze.agents.walking.choices import Choices
from memorymaze.agents.walking.floor_map import (
    FloorMap,
    Sighting,
    Stretch,
    metres_along,
)
from memorymaze.agents.walking.outlooks import junction_at_the_end, things_on
from memorymaze.agents.walking.walker import Walker
from memorymaze.routes import RoutePlan, Turn
from memorymaze.understanding import is_common, is_floor

POORLY_SEEN = 1.0
"""Nats lost, times one minus the score, by stopping at something seen."""
COMMON = 1.3
"""Nats lost when it is a thing that is everywhere, such as a door."""
SECOND_NAME = 1.5
"""Nats lost when it is not the likeliest of the names for the destination."""
UNSEEN = 4.0
"""Nats lost by stopping without having seen the destination."""
UNSEEN_COMMON = 1.8
"""The same when only things that are everywhere are known of it."""
UNNAMED = 0.5
"""The same when nothing is known of it."""
SIGN_SEEN = 2.0
"""Nats gained then by a sign near by that names it."""
LEG_TO_COME = 2.4
"""Nats lost for each leg that the description still has."""
CLOSE = 1.2
"""Metres from the destination at which to stop."""
AT_CROSSING = 2.2
"""Metres from a crossing within which the destination is there."""
AFTER_TURN = 1.7
"""Nats lost by stopping where the last turn was made."""
SIGN_NEAR = 9.0
"""Metres within which a sign that names the destination speaks for a place."""


@dataclass(frozen=True, slots=True)
class RulesEnding:
    """A hypothesis that the destination is here."""

    standing: Standing
    """At the crossing to start from."""
    exit: int | None
    """Exit to leave it by; None when the place is the crossing."""
    distance: float
    """Metres from the crossing."""
    cost: float
    reason: str


class RulesArrivals:
    """Finds the places where the walk of a plan may end."""

    def __init__(self, plan: RoutePlan, floor: FloorMap) -> None:
        """Take the plan and the map that the walk draws."""
        self._plan = plan
        self._floor = floor
        self._doors: list[int] = []
        names = with_door(plan.arrival.destinations)
        self._first = tuple(variants(names[0])) if names else ()
        told = dict.fromkeys([*self._first, *names])
        self.phrases = tuple(name for name in told if not is_floor(name))
        """What to look for."""

    def on_stretch(self, standing: Standing, stretch: Stretch) -> Iterator[RulesEnding]:
        """Yield the endings on a stretch walked by a hypothesis."""
        to_come = len(self._plan.legs) - standing.leg
        if to_come > 2:
            return
        start = self._floor.crossings[stretch.start].place
        end = self._floor.crossings[stretch.end].place
        base = standing.cost + LEG_TO_COME * to_come
        for loss, sighting in self._sightings():
            if sighting.stretch != (stretch.start, stretch.exit):
                continue
            if self._only_names(sighting):
                continue
            along = metres_along(sighting.seen_from, start, end)
            cost = base + loss + self._fit(standing, along, to_come)
            cost += self._side_cost(sighting)
            reason = f"{sighting.phrase} seen"
            yield RulesEnding(standing, standing.exit, along, cost, reason)
        length = self._plan.arrival.length
        if to_come == 0 and length is not None and length.unit != "places":
            rest = length.metres - standing.walked
            if 0.0 < rest < stretch.length:
                cost = base + (self._unseen + self._fit(standing, rest, 0))
                reason = f"{length.metres:.0f} m walked"
                yield RulesEnding(standing, standing.exit, rest, cost, reason)

    def at_crossing(
        self, standing: Standing, choices: Choices
    ) -> Iterator[RulesEnding]:
        """Yield the ending at a crossing where all legs are done."""
        if standing.leg < len(self._plan.legs) or not standing.walked:
            return
        place = self._floor.crossings[standing.at].place
        here = [
            loss + self._side_cost(sighting)
            for loss, sighting in self._sightings()
            if not self._only_names(sighting)
            and math.dist(sighting.place, place) <= AT_CROSSING
        ]
        unseen = min([self._unseen, *here])
        cost = standing.cost + unseen + self._fit(standing, 0.0, 0)
        arrival = self._plan.arrival
        junction = junction_at_the_end(arrival)
        if junction is not None:
            cost += junction_cost(Turn("either", junction=junction), choices)
        if choices.forward is not None:
            open_end = arrival.length is None and not (junction or here)
            cost += 1.0 if open_end or arrival.at_end else 0.3
        elif arrival.at_end:
            cost -= 0.5
        if any(
            self._only_names(s) and math.dist(s.place, place) <= SIGN_NEAR
            for _, s in self._sightings()
        ):
            cost -= min(SIGN_SEEN, unseen)
        yield RulesEnding(standing, None, 0.0, cost, "end of the way")

    def after_turn(self, standing: Standing) -> Iterator[RulesEnding]:
        """Yield the ending where the last turn is all there is to do."""
        if standing.leg < len(self._plan.legs) or standing.walked:
            return
        if self._plan.arrival.on_the_spot and self._plan.legs and not self.phrases:
            yield RulesEnding(standing, None, 0.0, standing.cost + AFTER_TURN, "turned")

    def best_now(
        self, standing: Standing, seen: list[Sighting], walked: float
    ) -> tuple[float, Sighting] | None:
        """Return the cost of stopping at something just seen, and what it is."""
        if standing.leg < len(self._plan.legs):
            return None
        fitting = [
            sighting
            for sighting in seen
            if sighting.phrase in self._first
            and not self._only_names(sighting)
            and (
                not is_common(sighting.phrase)
                or self._is_the_one(sighting, standing.walked + walked)
            )
        ]
        costs = [
            standing.cost
            + self._loss(sighting)
            + self._fit(standing, walked + sighting.distance, 0)
            + self._side_cost(sighting)
            for sighting in fitting
        ]
        return min(zip(costs, fitting, strict=True), key=itemgetter(0), default=None)

    def _is_the_one(self, sighting: Sighting, walked: float) -> bool:
        """Tell one door from the next by its side, its number and how far it is."""
        arrival = self._plan.arrival
        if arrival.side in {"left", "right"}:
            if sighting.side != arrival.side:
                return False
            if sighting.track not in self._doors:
                self._doors.append(sighting.track)
            if arrival.nth is not None and arrival.nth > 0:
                return self._doors.index(sighting.track) + 1 >= arrival.nth
        elif sighting.side != "ahead":
            return False
        if arrival.length is not None:
            return walked + sighting.distance >= 0.6 * arrival.length.metres
        return walked + sighting.distance >= 3.0

    def _sightings(self) -> Iterator[tuple[float, Sighting]]:
        for phrase in self.phrases:
            for sighting in self._floor.seen(phrase):
                yield self._loss(sighting), sighting

    def _loss(self, sighting: Sighting) -> float:
        loss = POORLY_SEEN * (1.0 - min(sighting.score, 1.0))
        if is_common(sighting.phrase):
            loss += COMMON
        if sighting.phrase not in self._first:
            loss += SECOND_NAME
        return loss

    @property
    def _unseen(self) -> float:
        if not self.phrases:
            return UNNAMED
        return UNSEEN_COMMON if all(map(is_common, self.phrases)) else UNSEEN

    def _only_names(self, sighting: Sighting) -> bool:
        """A sign that says `Library` is not the library."""
        return _is_sign(sighting.label) and not _is_sign(sighting.phrase)

    def _fit(self, standing: Standing, further: float, to_come: int) -> float:
        if to_come:
            return 0.0
        arrival = self._plan.arrival
        walked = standing.walked + further
        places = standing.places + bool(further)
        crossings = standing.crossings + bool(further)
        counted = arrival.length is not None and arrival.length.unit == "places"
        if counted:
            begun = self._counted_from(standing)
            places, crossings = places - begun, max(crossings - begun, 0)
        told = length_cost(arrival.length, walked, places, crossings)
        cost = told if counted else 0.7 * told
        cost += passings_cost(arrival.passings, standing)
        others = [
            m
            for m in things_on(self._plan, len(self._plan.legs))
            if m.phrase not in self.phrases
        ]
        end, at = standing.line[-1], None if further else standing.at
        return cost + 0.5 * mentions_cost(others, self._floor, standing, end, at)

    def _counted_from(self, standing: Standing) -> int:
        """Return where counting begins: `one crossing past the clock`."""
        passed = [m.phrase for m in self._plan.arrival.mentions if m.place == "passed"]
        for number in range(len(standing.line) - 1, 0, -1):
            for sighting in (s for phrase in passed for s in self._floor.seen(phrase)):
                if math.dist(sighting.place, standing.line[number]) <= AT_CROSSING:
                    return number
        return 0

    def _side_cost(self, sighting: Sighting) -> float:
        side = self._plan.arrival.side
        if side in {"left", "right"} and sighting.side in {"left", "right"}:
            return 0.0 if side == sighting.side else 0.7
        return 0.0


def approach(walker: Walker, sighting: Sighting) -> None:
    """Walk up to a thing just seen; into the place behind it when it is a door."""
    for _ in range(14 + int(sighting.distance)):
        seen = [s for s in walker.look((sighting.phrase,)) if s.track == sighting.track]
        if not seen:
            break
        sighting = seen[0]
        opens = OPENS.search(sighting.label) is not None
        if opens and sighting.side != "ahead" and walker.turn_in(sighting.side):
            walker.walk_on(2 * INSIDE)
            return
        rest = sighting.distance - CLOSE
        if opens:
            rest = walker.metres_until_abreast(sighting)
        if rest <= 0.1 or not walker.step(min(rest, 0.8)):
            break
    if OPENS.search(sighting.label):
        walker.walk_on(walker.metres_until_abreast(sighting) + INSIDE)


def _is_sign(words: str) -> bool:
    return any(
        word in {"sign", "board", "signboard", "poster"} for word in words.split()
    )
