"""Whether something seen is the destination, by its name, its side and its number."""

import math
import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from itertools import chain, repeat

from memorymaze.agents.guide.likelihoods import MOST_SEEN, Likelihoods, seen_ratio
from memorymaze.agents.guide.signs import named_by_use
from memorymaze.agents.guide.things import Things, passed_after
from memorymaze.agents.walking.approaching import DOOR
from memorymaze.agents.walking.floor_map import (
    FloorMap,
    Point,
    Sighting,
    distance_to_line,
    is_on_a_pointer,
    is_sign,
    side_of_line,
)
from memorymaze.language.nouns import general_words, kin_of
from memorymaze.language.plans import Arrival
from memorymaze.language.reading import is_common, is_floor, place_on_sign

BESIDE = 4.0
"""Metres from the line of a stretch within which a destination is on it."""
REACH = 8.0
"""Metres of way on which the destination would count as being there."""
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

BY_USE = 0.4
"""Score of a sign whose words are like what is told in meaning."""

_ROOMS = frozenset({"room", "office", "classroom"})
"""Of a room without a name a camera sees the door."""
_NUMBER = re.compile(r"\d")


class Recognition:
    """Knows a destination by what is seen."""

    def __init__(
        self, arrival: Arrival, floor: FloorMap, model: Likelihoods, things: Things
    ) -> None:
        """Take what is told of it, the map that the walk draws, and how speakers are."""
        self._arrival = arrival
        self._floor = floor
        self._model = model
        self._things = things
        self._counted: dict[str, list[int]] = {}
        """Tracks of what bears a name told, in the order in which it was seen."""
        self.is_told_apart = any(is_floor(m.phrase) for m in arrival.mentions)
        """Whether the floor is told that it stands on: then there may be several."""
        names = with_door(arrival.destinations)
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
        doubts = chain(arrival.unclear_names, repeat(0.0))
        self._meant = {
            name: 1 - doubt
            for name, doubt in zip(arrival.destinations, doubts, strict=False)
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
        self.is_named = likeliest >= LIKELY_MEANT
        """Whether a likely name is told."""

    @property
    def phrases(self) -> tuple[str, ...]:
        """All that it may be called."""
        return *self.names, *self.kin

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
            if off or self._only_names(sighting):
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
            is_common(sighting.phrase) or self.is_told_apart
        ):
            rate, most = UNIQUE * rate, MOST_SEEN / UNIQUE
        there = (1 - model.misnamed) * model.detected * sighting.score
        ratio = seen_ratio(rate, REACH, there, most)
        if sighting.phrase not in self._first:
            ratio **= 0.6
        if self._only_names(sighting):
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
        if self._only_names(sighting) or not (
            on_side or self._arrival.side in {None, "ahead"}
        ):
            return len(counted)
        counted.append(sighting.track)
        return len(counted) - 1

    def again(self, sighting: Sighting) -> float:
        """Weigh that another of the same name, further on, is the destination."""
        nth = self._arrival.nth
        later = self._base(sighting) * self._model.name_again
        if nth is not None and nth > 0:
            later *= NTH[self._number_of(sighting) + 1 >= nth]
        return later

    def sightings(self) -> Iterator[Sighting]:
        """Yield all that was seen which may be the destination."""
        for phrase in self.phrases:
            yield from filter(self.may_be, self._floor.seen(phrase))
        for text, name in named_by_use(self.names, self._floor.texts):
            phrase, track = f"sign that says {text.phrase}", -text.track
            if phrase not in self.names:
                self._meant.setdefault(phrase, self._meant[name])
                sign = replace(
                    text, phrase=phrase, label="sign", score=BY_USE, track=track
                )
                if self.may_be(sign):
                    yield sign

    def may_be(self, sighting: Sighting) -> bool:
        """Tell whether something seen may be the destination, for all that is known of it."""
        if sighting.track in self._floor.refuted:
            return False
        if is_on_a_pointer(sighting, self._floor.texts):
            return False
        is_told = sighting.phrase not in self.kin
        return is_told or is_kin(sighting.label, self._name)

    def _only_names(self, sighting: Sighting) -> bool:
        """A sign that says `Library` is not the library."""
        return is_sign(sighting.label) and place_on_sign(sighting.phrase) is None

    @cached_property
    def unseen(self) -> float:
        """Weigh a place where nothing of the destination was seen."""
        if not self.names:
            return 1.0
        common = all(map(is_common, self.names))
        ratio = COMMON_UNSEEN if common else self._model.passed_by
        return (1 - self._unmeant) * ratio + self._unmeant


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
