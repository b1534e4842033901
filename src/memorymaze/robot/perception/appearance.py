"""Colours and materials in words: which fit, which contradict each other."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

from memorymaze.language.nouns import family_of, word_table
from memorymaze.robot.perception.noun_phrase import words_of

_FAMILY = family_of("colors")
_ALIKE = {
    frozenset((color, other))
    for color, others in word_table("alike").items()
    for other in others
}
_SHADES = dict.fromkeys(word_table("shades")["dark"], -1) | dict.fromkeys(
    word_table("shades")["light"], 1
)
_DARK_BY_NAME = frozenset(word_table("shades")["dark_by_name"])
_MATERIAL = family_of("materials")
_ANY_KIND = {
    word: family for family, words in word_table("any_kind").items() for word in words
}
_COLOR_OF_MATERIAL = {
    material: color for material, [color] in word_table("color_of_material").items()
}

_UNKNOWN = 0.75
"""Factor where the thing's colour or material is not known."""
_NEAR = 0.6
"""Factor for a neighbouring colour or shade."""


@dataclass(frozen=True, slots=True)
class Appearance:
    """What is known or asked of how a thing looks."""

    colors: frozenset[str] = frozenset()
    """Families such as `red`."""
    shade: int = 0
    """-1 dark, 1 light, 0 not said."""
    materials: frozenset[str] = frozenset()
    """Words such as `oak`; `wood` stands for all of its kinds."""


def is_appearance_word(word: str) -> bool:
    """Tell whether a word in lower case names a colour, shade or material."""
    return word in _FAMILY or word in _MATERIAL or word in _SHADES


@lru_cache(maxsize=4096)
def parse_appearance(text: str) -> Appearance:
    """Read a colour or material description such as `dark red` or `light oak`."""
    return _read(words_of(text))


def _read(words: Iterable[str]) -> Appearance:
    colors: set[str] = set()
    materials: set[str] = set()
    shade = 0
    for word in words:
        if word in _FAMILY:
            colors.add(_FAMILY[word])
        if word in _MATERIAL:
            materials.add(_ANY_KIND.get(word, word))
        if word in _SHADES:
            shade = _SHADES[word]
        elif word in _DARK_BY_NAME:
            shade = -1
    return Appearance(frozenset(colors), shade, frozenset(materials))


def appearance_score(asked: str, color: str | None, material: str | None) -> float:
    """Return how well a thing's look fits the words asked for.

    1 for a fit, lower for a near or unknown one, 0 for a contradiction. A word that
    names both a colour and a material (`silver`) fits as either.

    >>> appearance_score("red", "dark red", None)
    1.0
    >>> appearance_score("red", "blue", None)
    0.0
    """
    want = parse_appearance(asked)
    have = parse_appearance(f"{color or ''} {material or ''}")
    known = {_MATERIAL[m] for m in have.materials}
    colors = have.colors | {
        _COLOR_OF_MATERIAL[m]
        for m in known
        if m in _COLOR_OF_MATERIAL and not have.colors
    }
    scores: list[float] = []
    if want.colors:
        scores.append(_color_score(want, Appearance(colors, have.shade)))
    if want.materials:
        scores.append(_material_score(want.materials, have.materials))
    if len(scores) == 2 and len(want.colors | want.materials) == 2:
        both = want.colors & {_FAMILY.get(m) for m in want.materials}
        if both:
            return max(scores)
    return min(scores, default=1.0)


def _color_score(want: Appearance, have: Appearance) -> float:
    if not have.colors:
        return _UNKNOWN
    shared = want.colors & have.colors
    if not shared:
        near = any(
            frozenset((w, h)) in _ALIKE for w in want.colors for h in have.colors
        )
        return _NEAR if near else 0.0
    if want.shade * have.shade < 0:
        return 0.0
    if want.shade != have.shade and want.shade != 0:
        return _NEAR
    return 1.0


def _material_score(want: frozenset[str], have: frozenset[str]) -> float:
    if not have:
        return _UNKNOWN
    if want & have:
        return 1.0
    families = {_MATERIAL[m] for m in have}
    if want & families:
        return 1.0
    return _NEAR if {_MATERIAL[m] for m in want} & families else 0.0
