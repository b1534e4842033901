"""The things of a site, in the words that people would use for them."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

from memorymaze.language.plans import Kind
from memorymaze.texts.writing.phrases import phrases, words_for
from memorymaze.world.sites.records import Door, Landmark, Site

NUMBER = re.compile(r"[A-Z]?\d{2,5}[A-Z]?")
READABLE = re.compile(r"\w[\w' &-]*\w")
"""Written words that can be said aloud."""
VOWEL = re.compile(r"[aeiouAEIOU]|hour")


@dataclass(frozen=True, slots=True)
class Thing:
    """Something that can be mentioned."""

    id: str
    words: str
    """Without an article, such as `orange sofa`; or `room 2103`."""
    position: tuple[float, float]
    """Metres."""
    proper: bool = False
    """Whether it takes no article."""
    named: bool = False
    """Whether it is always told with `the`, being the only one of its name."""
    kind: Kind = "object"


def things_of(site: Site) -> tuple[Thing, ...]:
    """Return the things of a site that can be mentioned, in the plan's order."""
    rooms = {room.id: room.name for room in site.rooms}
    found = [_landmark(each) for each in site.landmarks]
    doors = [_door(each, rooms) for each in site.doors]
    found += [replace(each, kind="door") for each in doors if each is not None]
    return tuple(each for each in found if each is not None)


def thing_called(words: str, things: Mapping[str, Thing]) -> Thing:
    """Return the thing of a site with these words, or one that no site has."""
    return things.get(words) or Thing("", words, (math.nan, math.nan))


def with_article(thing: Thing, *, definite: bool) -> str:
    """Return the words for a thing with the article they take.

    >>> with_article(Thing("a", "orange sofa", (0, 0)), definite=False)
    'an orange sofa'
    """
    if thing.proper:
        return thing.words
    if definite or thing.named:
        return f"the {thing.words}"
    if is_plural(thing):
        return f"some {thing.words}"
    return f"{'an' if VOWEL.match(thing.words) else 'a'} {thing.words}"


def is_plural(thing: Thing) -> bool:
    """Tell whether the words for a thing are a plural."""
    return not (thing.proper or thing.named) and thing.words.split()[-1] in phrases(
        "words", "plurals"
    )


def _landmark(mark: Landmark) -> Thing | None:
    place = (float(mark.position.x), float(mark.position.y))
    category = mark.category.replace("_", " ")
    if category in phrases("words", "never_told"):
        return None
    if "number" in category and mark.text and NUMBER.fullmatch(mark.text):
        return Thing(mark.id, f"room {mark.text}", place, True)
    if "sign" in category:
        text = mark.text or ""
        if READABLE.fullmatch(text) and len(text.split()) <= 3:
            if text.lower().split()[0][:4] in category:
                return Thing(mark.id, category, place, kind="sign")
            return Thing(mark.id, f"{category} that says {text}", place, kind="sign")
        if not mark.color:
            return None
        return Thing(mark.id, f"{mark.color} {category}", place, kind="sign")
    color = f"{mark.color} " if mark.color and mark.color != "clear" else ""
    return Thing(mark.id, f"{color}{category}", place)


def _door(door: Door, rooms: dict[str, str]) -> Thing | None:
    middle = door.line.interpolate(0.5, normalized=True)
    place = (float(middle.x), float(middle.y))
    if door.label and NUMBER.fullmatch(door.label):
        return Thing(door.id, f"room {door.label}", place, True)
    plain = words_for("plain_doors").get(door.style)
    if plain is not None:
        return Thing(door.id, plain, place)
    label = door.label or ""
    if READABLE.fullmatch(label) and len(label.split()) <= 3:
        words = label.split()
        if label.istitle() and len(words) > 1 and len(words[-1]) <= 2:
            return Thing(door.id, label, place, proper=True)
        if (
            label.istitle()
            and len(words) > 1
            and words[-1].lower() in phrases("words", "rooms")
        ):
            return Thing(door.id, label, place, named=True)
        return Thing(door.id, f"door that says {label}", place)
    name = rooms.get(door.room or "", "")
    if READABLE.fullmatch(name) and len(name.split()) <= 3:
        return Thing(door.id, f"door to {_the(name)}", place, named=True)
    return None


def _the(name: str) -> str:
    if name.startswith("the "):
        return name
    return f"the {name[0].lower()}{name[1:]}" if name[1:].islower() else f"the {name}"
