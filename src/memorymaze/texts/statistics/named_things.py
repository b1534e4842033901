"""Which things a description names, and whether the building has them."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading import is_floor
from memorymaze.robot.perception.camera_view import ObjectDescription
from memorymaze.robot.perception.matching import MATCH_THRESHOLD, match_score
from memorymaze.robot.perception.noun_phrase import words_of
from memorymaze.robot.simulation.senses.sight_targets import (
    describe_door,
    describe_landmark,
)
from memorymaze.world.sites.records import Site

Sort = Literal["landmark", "door", "room", "way", "floor", "unknown"]

SORTS: dict[Sort, str] = {
    "landmark": "landmarks of the plan",
    "door": "doors of the plan",
    "room": "rooms of the plan",
    "way": "hallways and places of the plan",
    "floor": "floor materials",
    "unknown": "not found in the plan",
}


@dataclass(frozen=True)
class SiteNames:
    """All that can be named in a building."""

    site: Site

    @cached_property
    def _things(self) -> list[tuple[Sort, ObjectDescription]]:
        site = self.site
        things: list[tuple[Sort, ObjectDescription]] = []
        landmarks = [describe_landmark(each) for each in site.landmarks]
        things.extend(("landmark", landmark) for landmark in landmarks)
        doors = [describe_door(each, site) for each in site.doors]
        rooms = [ObjectDescription(each.use, name=each.name) for each in site.rooms]
        things.extend(("door", door) for door in doors)
        things.extend(("room", room) for room in rooms)
        return list(dict.fromkeys(things))

    @cached_property
    def _ways(self) -> list[frozenset[str]]:
        places = (*self.site.corridors, *self.site.areas, *self.site.turning_points)
        names = {each.name for each in places if each.name}
        return [frozenset(words_of(name)) for name in sorted(names)]

    @cached_property
    def _known(self) -> dict[str, Sort]:
        return {}

    def sort_of(self, phrase: str) -> Sort:
        """Return what of the building a noun phrase fits best.

        By the rules of `detect_from_RGB_image` (docs/seeing.md) for landmarks,
        doors and rooms; a hallway or place is meant where all words of the phrase, two
        or more, are in its name. Landmarks come before doors and rooms that fit as well.
        """
        if phrase not in self._known:
            self._known[phrase] = self._find(phrase)
        return self._known[phrase]

    def _find(self, phrase: str) -> Sort:
        if is_floor(phrase):
            return "floor"
        best: Sort = "unknown"
        score = 0.0
        for sort, thing in self._things:
            fit = match_score(phrase, thing)
            if fit >= MATCH_THRESHOLD and fit > score:
                best, score = sort, fit
                if score == 1.0:
                    return best
        said = frozenset(words_of(phrase))
        named = len(said) > 1 and any(said <= way for way in self._ways)
        return "way" if named else best


def named_things(plan: RoutePlan, names: SiteNames) -> Counter[Sort]:
    """Count what a parsed description names, each phrase once, by what it fits best."""
    phrases = {phrase for phrase in _phrases(plan) if phrase.strip()}
    return Counter(names.sort_of(phrase) for phrase in phrases)


def _phrases(plan: RoutePlan) -> Iterator[str]:
    for leg in (*plan.legs, plan.arrival):
        yield from (mention.phrase for mention in leg.mentions)
        yield from leg.too_far
    yield from plan.arrival.destinations
