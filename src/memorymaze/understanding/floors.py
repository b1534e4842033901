"""Floors and pictures that tell one way from another: `the blue path`."""

import re

ANY_FLOOR = "floor"
"""What to look for to learn whether coverings can be told at all."""

_LOOKS: tuple[tuple[str, str], ...] = (
    (r"octagon\w*|hexagon\w*|honey ?comb\w*|olive", "octagon floor"),
    (r"flower\w*|rose|roses|floral", "flowered floor"),
    (r"grass\w*", "grass floor"),
    (r"brick\w*", "brick floor"),
    (r"wood|wooden|wooded|woods|parquet", "wooden floor"),
    (r"blue|bl[uv]+e", "blue floor"),
    (r"yellow", "yellow floor"),
    (r"pink", "pink floor"),
    (r"red", "red floor"),
    (r"green", "green floor"),
    (r"black", "black floor"),
    (r"brown", "brown floor"),
    (r"stones?|rocks?|rocky|gravel|cobble\w*", "stone floor"),
    (r"concrete|cement|gr[ae]y|bare|plain|untiled|uncarpeted", "concrete floor"),
)
"""Words that describe a floor, those that tell most first, and what to look for."""
_WORDS = tuple((re.compile(rf"\b(?:{words})\b"), phrase) for words, phrase in _LOOKS)
_FLOOR = re.compile(
    r"(?:floors?|flooring|floored|carpet|carpets|carpeting|carpeted|tiles?|tiled)$"
)
_WAY = re.compile(
    r"(?:halls?|hallways?|paths?|alleys?|aisles?|roads?|streets?|corridors?|areas?"
    r"|lanes?|passages?|passageways?|walkways?)$"
)
_SURFACE = re.compile(r"^(?:grass|bricks?|gravel|cement|concrete|carpet)$")
_PICTURED = re.compile(
    r"^(?:monarch )?(butterfl\w+|butterlfy|fish\w*|(?:eiffel )?towers?)$"
)
_PICTURES = {
    "b": "picture of a butterfly",
    "f": "picture of a fish",
    "t": "picture of a tower",
}
_SHOWN = re.compile(r"\b(?:pictures?|paintings?|images?|posters?)\b")


def floor_phrase(words: str) -> str | None:
    """Return what to look for when words name a way by its floor; None for others.

    >>> floor_phrase("pink-flowered carpet hall")
    'flowered floor'
    >>> floor_phrase("vending machine hall") is None
    True
    """
    tokens = words.replace("-", " ").split()
    if not tokens:
        return None
    named = _FLOOR.search(tokens[-1]) or _WAY.search(tokens[-1])
    if not named and not _SURFACE.match(tokens[-1]):
        return None
    text = " ".join(tokens)
    return next((phrase for look, phrase in _WORDS if look.search(text)), None)


def wall_phrase(words: str) -> str | None:
    """Return what to look for when words name a way by pictures on its walls.

    >>> wall_phrase("butterfly hallway")
    'picture of a butterfly'
    """
    tokens = words.replace("-", " ").split()
    named = bool(tokens) and _WAY.search(tokens[-1]) is not None
    if named:
        tokens = tokens[:-1]
    shown = _PICTURED.match(" ".join(tokens))
    return _PICTURES[shown[1].removeprefix("eiffel ")[0]] if shown and named else None


def is_floor(phrase: str) -> bool:
    """Tell whether a phrase to look for is a floor."""
    return phrase == ANY_FLOOR or phrase.endswith(" floor")
