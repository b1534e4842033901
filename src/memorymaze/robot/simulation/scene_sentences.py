"""Sentences on what is seen, filled into templates; nothing is looked at in here."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from memorymaze.robot.perception.camera_view import ObjectDescription

WALL_CLOSE = 2.0
"""Metres within which a wall is close by."""
FAR = 7.0
"""Metres from which on a way is told to lead on."""
CORRIDOR_WIDTH = 5.0
"""Metres up to which a way between walls is called a corridor."""
NEAR_THINGS = 3.0
MOST_THINGS = 6
"""Things named in one sentence."""
LONGEST_WORDS = 80
"""Characters of what is written on a thing."""

_WORDS = {"wood_panel": "wood-panelled", "wood": "wooden"}
_HISSING = ("x", "ch", "sh")


@dataclass(frozen=True, slots=True)
class PlaceSurface:
    """What a place is made of, in the words of the site plan."""

    floor: str
    wall: str


@dataclass(frozen=True, slots=True)
class SceneView:
    """What is seen in one direction."""

    depth: float
    """Metres to where walls end the view."""
    width: float
    """Metres between the walls, a little ahead."""
    surface: PlaceSurface
    things: tuple[tuple[ObjectDescription, float], ...]
    """Things and their distances in metres, the nearest first."""


def view_sentence(view: SceneView) -> str:
    """Return one sentence on a direction: walls, floor and ways, then things."""
    floor, wall = _made_of(view.surface.floor), _made_of(view.surface.wall)
    if view.depth < WALL_CLOSE:
        scene = f"{_article(wall)} wall close by"
    elif view.depth < FAR:
        scene = (
            f"{_article(floor)} floor that ends at {_article(wall)} wall some steps on"
        )
    elif view.width <= CORRIDOR_WIDTH:
        scene = (
            f"a{' long' if view.depth > 2 * FAR else ''} corridor that leads on, with "
            f"{_article(floor)} floor and {wall} walls"
        )
    else:
        scene = f"a wide open space with {_article(floor)} floor and {wall} walls"
    near = [what for what, distance in view.things if distance <= NEAR_THINGS]
    far = [what for what, distance in view.things if distance > NEAR_THINGS]
    parts = [scene]
    if near:
        parts.append(f"near by {_listed(near)}")
    if far:
        parts.append(f"farther off {_listed(far)}")
    sentence = "; ".join(parts)
    return sentence[0].upper() + sentence[1:] + "."


def summary_sentence(
    views: Sequence[SceneView],
    surface: PlaceSurface,
    things: Sequence[ObjectDescription],
) -> str:
    """Return one sentence on a place, without directions."""
    far = [view.depth >= FAR for view in views]
    # A way that two neighbouring directions show is one way.
    ways = sum(
        now and not before
        for now, before in zip(far, [far[-1], *far[:-1]], strict=True)
    )
    ways = ways or int(all(far))
    open_space = sum(view.width > CORRIDOR_WIDTH for view in views if view.depth >= FAR)
    kind = "open space" if open_space * 2 > sum(far) else "corridor"
    floor, wall = _made_of(surface.floor), _made_of(surface.wall)
    seen = f"; one sees {_listed(things)}" if things else ""
    leading = (
        "nowhere far" if ways == 0 else f"on in {ways} direction" + "s" * (ways > 1)
    )
    return (
        f"The place is {_article(kind)} with {_article(floor)} floor and {wall} walls "
        f"that leads {leading}{seen}."
    )


def thing_words(what: ObjectDescription) -> str:
    """Return what a thing is called: `brown wooden door "2103"`, `bench`, `sign "Exit"`."""
    return " ".join(part for part in _in_words(what) if part)


def _in_words(what: ObjectDescription) -> tuple[str, str]:
    """Return what a thing is, and its name and what is written on it."""
    words = [what.state] if what.state == "open" else []
    words += [what.color or ""]
    if what.material and what.material not in what.category:
        words.append(_made_of(what.material))
    words.append(what.category)
    text = " ".join((what.text or "").split())
    known = []
    if what.name and what.name.casefold() not in f"{what.category} {text}".casefold():
        known.append(f"({what.name})")
    if text:
        known.append(f'"{_shortened(text)}"')
    return " ".join(word for word in words if word), " ".join(known)


def _listed(things: Sequence[ObjectDescription]) -> str:
    """Return things in words, equal ones counted: `a bench and 2 brown wooden doors`."""
    counts = Counter(map(_in_words, things))
    told = [
        f"{_article(kind) if count == 1 else f'{count} {_plural(kind)}'} {known}".strip()
        for (kind, known), count in list(counts.items())[:MOST_THINGS]
    ]
    if len(counts) > MOST_THINGS:
        told.append("more")
    return told[0] if len(told) == 1 else f"{', '.join(told[:-1])} and {told[-1]}"


def _article(words: str) -> str:
    return f"{'an' if words[0].lower() in 'aeiou' else 'a'} {words}"


def _plural(words: str) -> str:
    if words.endswith("person"):
        return words.removesuffix("person") + "people"
    if words.endswith("s"):
        return words
    return words + ("es" if words.endswith(_HISSING) else "s")


def _made_of(material: str) -> str:
    return _WORDS.get(material, material.replace("_", " "))


def _shortened(text: str) -> str:
    if len(text) <= LONGEST_WORDS:
        return text
    return text[:LONGEST_WORDS].rstrip() + "…"
