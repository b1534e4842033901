"""Names of things: which words a detector should look for."""

import re

from memorymaze.understanding.words import FILLERS, SURFACES, UNSEEN

_NUMBERS = {
    "one": "1", "two": "2", "three": "3", "four": "4", "five": "5", "six": "6",
    "seven": "7", "eight": "8", "nine": "9", "ten": "10", "eleven": "11",
    "twelve": "12",
}  # fmt: skip
_KEPT_ING = {
    "painting", "building", "vending", "recycling", "reading", "meeting", "parking",
    "ceiling", "landing", "drilling", "dining", "waiting", "drinking", "tutoring",
    "advising", "nursing", "changing", "clothing", "railing", "engineering", "smoking",
    "seating", "shopping", "swimming", "printing", "washing", "living", "carving",
    "drawing", "writing", "king", "ring", "wing", "swing", "string", "thing",
}  # fmt: skip
_COMMON = frozenset([
    "door",
    "doors",
    "window",
    "windows",
    "wall",
    "walls",
    "sign",
    "signs",
    "plant",
    "plants",
    "bench",
    "benches",
    "seat",
    "seats",
    "chair",
    "chairs",
    "screen",
    "screens",
    "poster",
    "posters",
    "picture",
    "pictures",
    "board",
    "boards",
    "light",
    "lights",
    "box",
    "boxes",
    "room",
    "rooms",
    "office",
    "offices",
    "classroom",
    "classrooms",
    "exit",
    "exits",
    "opening",
    "entrance",
    "end",
])
"""Things that are everywhere and tell little."""
_SIGNS = frozenset({"sign", "signs", "board", "signboard", "arrow", "screen", "poster"})
_BINDERS = frozenset({
    "that",
    "says",
    "which",
    "reading",
    "saying",
    "with",
    "for",
    "hanging",
})
_PLAIN = SURFACES | frozenset([
    "automatic",
    "sliding",
    "double",
    "big",
    "large",
    "small",
    "little",
    "tall",
    "heavy",
    "huge",
    "wide",
    "open",
    "closed",
    "left",
    "right",
    "red",
    "blue",
    "green",
    "yellow",
    "orange",
    "white",
    "black",
    "brown",
    "grey",
    "gray",
    "pink",
    "purple",
    "silver",
    "golden",
    "dark",
    "light",
    "clear",
    "bright",
    "old",
    "new",
    "second",
    "first",
    "third",
    "next",
    "last",
    "pair",
    "of",
    "number",
    "brass",
    "steel",
    "metal",
])
"""Words before a common thing that do not make it special."""
_LANES = re.compile(
    r"\b(?:corridor|hallway|passage|passageway|walkway|way|street|path|lane|road|aisle"
    r"|alley|row)$"
)


def thing_phrase(words: str) -> str:
    """Return the words to look for, or "" when they name nothing a camera finds."""
    tokens = [token for token in words.split() if token not in {"the", "a", "an"}]
    while tokens and _is_idle(tokens[-1]):
        tokens.pop()
    while tokens and (tokens[0] in FILLERS or tokens[0] in {"of", "that"}):
        tokens.pop(0)
    if not tokens:
        return ""
    if len(tokens) > 1 and tokens[-1] in _NUMBERS:
        tokens[-1] = _NUMBERS[tokens[-1]]
    content = [
        t for t in tokens if t not in FILLERS and t not in SURFACES and t not in UNSEEN
    ]
    if not any(t not in _PLAIN or t in _COMMON for t in content):
        return ""
    return " ".join(tokens)


def _is_idle(token: str) -> bool:
    if token in {
        "guy",
        "fellow",
        "lady",
        "dude",
        "thing",
        "things",
        "stuff",
        "bit",
        "part",
    }:
        return True
    if token in {"of", "that", "with", "marked", "called", "about", "saying", "named"}:
        return True
    return token.endswith("ing") and token not in _KEPT_ING and len(token) > 5


def is_lane(phrase: str) -> bool:
    """Tell whether a phrase names a way to walk on rather than a thing beside it."""
    return _LANES.search(phrase) is not None


def is_common(phrase: str) -> bool:
    """Tell whether a thing is of a kind that is everywhere and has no name."""
    *before, head = phrase.split()
    return head in _COMMON and all(word in _PLAIN for word in before)


def place_on_sign(phrase: str) -> str | None:
    """Return what a sign names: `library` for `green library sign`; None for no sign."""
    words = phrase.split()
    if not any(word in _SIGNS for word in words):
        return None
    rest = [
        w for w in words if w not in _SIGNS and w not in _PLAIN and w not in _BINDERS
    ]
    return " ".join(rest)
