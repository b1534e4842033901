"""Signs that point the way to the destination, or name in other words what one wants there."""

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache

from memorymaze.agents.walking.floor_map import (
    Crossing,
    FloorMap,
    Sighting,
    along_and_aside,
)
from memorymaze.agents.walking.walker import IDLE
from memorymaze.basics.geometry.pose import wrap_angle
from memorymaze.basics.signposts import ANY_ARROW, signposts
from memorymaze.language.nouns import kind_distance, singular
from memorymaze.language.reading import is_common, place_on_sign
from memorymaze.language.reading.marking import likeness
from memorymaze.robot.perception.matching import points_elsewhere
from memorymaze.robot.perception.noun_phrase import words_of

AHEAD_OF_SIGN = 9.0
"""Metres from a sign to the crossing that it is about, at most."""
BESIDE_SIGN = 3.0
"""Metres that this crossing may lie behind or beside it."""
SEVERAL = frozenset([
    "bathroom",
    "elevator",
    "entrance",
    "escalator",
    "exit",
    "lavatory",
    "lift",
    "locker",
    "men",
    "restroom",
    "stair",
    "staircase",
    "toilet",
    "washroom",
    "wc",
    "women",
])
"""What a floor has several of: signs point to the nearest, whichever is meant."""
ALIKE = 0.3
"""Likeness of a name told and of one that is written from which on they may be one: 0.03 of
the other names in a building are so like, and two thirds of the right ones."""
_ANGLES = {"left": 90, "right": -90, "ahead": 0, "back": 180}
_BETWEEN = re.compile(rf"({ANY_ARROW.pattern})(?!.*\s\s)[^←↑→↓]+({ANY_ARROW.pattern})")
_RANGE = re.compile(r"(\d+)\s*(?:-|\u2013|to)\s*(\d+)")


class Pointers:
    """The signs read so far that name a destination and point on."""

    def __init__(self, names: Iterable[str]) -> None:
        """Take the names of the destination; those that are everywhere point nowhere."""
        told = (place_on_sign(each) or each for each in names)
        named = [_words(each) for each in told if not is_common(each)]
        self._names = [each for each in named if not each & SEVERAL]

    def headings(self, floor: FloorMap) -> dict[int, list[float]]:
        """Return the headings that signs point in, by the crossings they are about."""
        found: dict[int, list[float]] = {}
        if not self._names:
            return found
        for text in floor.texts:
            for angle in pointed(text.phrase, self._names):
                seen_along = math.atan2(
                    text.place[1] - text.seen_from[1], text.place[0] - text.seen_from[0]
                )
                crossing = _crossing_of(text, seen_along, floor)
                if crossing is not None:
                    heading = wrap_angle(seen_along + math.radians(angle))
                    found.setdefault(crossing.number, []).append(heading)
        return found


def pointed(text: str, names: Sequence[frozenset[str]]) -> list[int]:
    """Return the directions a sign points in for a place, degrees, left positive.

    Of names between two arrows, read on one line, those at the ends alone belong to one.

    >>> pointed("← Lifts, Library   Café →", [frozenset({"cafe"})])
    [-90]
    >>> pointed("↑ Reception, Lifts Café, Library →", [frozenset({"library"})])
    [-90]
    >>> pointed("← Restrooms   Meeting Rooms, Bar →", [frozenset({"room", "6"})])
    [-90]
    """
    if _BETWEEN.fullmatch(text.strip()):
        first, *_, last = text.split(",") if "," in text else ("", "")
        text = f"{first}  {last}"
    return [
        _ANGLES[post.arrow]
        for post in signposts(text)
        if post.arrow is not None and any(_names(post.words, name) for name in names)
    ]


def _names(group: str, name: frozenset[str]) -> bool:
    """Tell whether names on a sign are of a place: by name, by its kind, or by a range."""
    words = _words(group)
    if name and name <= words:
        return True
    numbers = {each for each in name if each.isdigit()}
    kind = name - numbers
    if not any(each.isdigit() for each in words):
        # Meeting Rooms are all of them; a Meeting Room is one.
        several = any(f"{each}s" in _plain(group) for each in kind)
        return bool(numbers) and kind <= words and several
    return any(
        int(low) <= int(number) <= int(high)
        for low, high in _RANGE.findall(group)
        for number in numbers
    )


def _words(text: str) -> frozenset[str]:
    return frozenset(
        w[:-1] if len(w) > 3 and w.endswith("s") else w for w in _plain(text)
    )


def _plain(text: str) -> list[str]:
    return re.findall(r"[a-z]+|\d+", text.casefold().replace("é", "e"))


def _crossing_of(text: Sighting, heading: float, floor: FloorMap) -> Crossing | None:
    """Return the crossing that one comes to next who reads a sign."""
    best, least = None, math.inf
    for crossing in floor.crossings.values():
        ahead, beside = along_and_aside(crossing.place, text.place, heading)
        if not -BESIDE_SIGN <= ahead <= AHEAD_OF_SIGN or beside > BESIDE_SIGN:
            continue
        if len(crossing.exits) > 1 and abs(ahead) + beside < least:
            best, least = crossing, abs(ahead) + beside
    return best


def named_by_use(
    names: Iterable[str], texts: Iterable[Sighting]
) -> Iterator[tuple[Sighting, str]]:
    """Yield texts like what one wants there, with the name told: Cinema for movies.

    Names of things and rooms are left out: who knows them tells them.
    """
    uses = [each for each in names if not _names_thing(each)]
    for text in texts:
        nearest = max(uses, key=lambda each: _likeness(text.phrase, each), default=None)
        if nearest is not None and _likeness(text.phrase, nearest) >= ALIKE:
            yield text, nearest


@lru_cache(maxsize=20_000)
def _names_thing(name: str) -> bool:
    """Tell whether a name is one of a thing or a room, not of what one does there.

    >>> _names_thing("statue"), _names_thing("food"), _names_thing("movies")
    (True, False, False)
    """
    return kind_distance("artifact", singular(name.split()[-1].casefold())) is not None


@lru_cache(maxsize=20_000)
def _likeness(text: str, name: str) -> float:
    """Return how like in meaning a text on a wall is to a name; no number is like another.

    >>> _likeness("Restaurant", "food") > ALIKE > _likeness("Bakery", "movies")
    True
    """
    told = place_on_sign(name) or name
    if points_elsewhere(text) or is_common(name) or re.search(r"\d", text + told):
        return 0.0
    said, asked = (
        " ".join(word for word in words_of(each) if word not in IDLE)
        for each in (text, told)
    )
    return likeness(asked, said)
