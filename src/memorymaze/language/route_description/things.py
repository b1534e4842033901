"""Names of things: which words a detector should look for."""

import re

from memorymaze.language.route_description.words import FILLERS, SURFACES, UNSEEN

__all__ = ["is_common", "is_lane", "thing_phrase"]

_KEPT_ING = {
    "painting", "building", "vending", "recycling", "reading", "meeting", "parking",
    "ceiling", "landing", "drilling", "dining", "waiting", "drinking", "tutoring",
    "advising", "nursing", "changing", "clothing", "railing", "engineering", "smoking",
    "seating", "shopping", "swimming", "printing", "washing", "living", "carving",
    "drawing", "writing", "king", "ring", "wing", "swing", "string", "thing",
}  # fmt: skip
_COMMON = frozenset(
    """door doors window windows wall walls sign signs plant plants bench benches seat
    seats chair chairs screen screens poster posters picture pictures board boards light
    lights box boxes room rooms exit exits opening entrance""".split()
)
"""Things that are everywhere and tell little."""
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
    content = [t for t in tokens if t not in FILLERS and t not in SURFACES and t not in UNSEEN]
    if not content:
        return ""
    return " ".join(tokens)


def _is_idle(token: str) -> bool:
    if token in {"of", "that", "with", "marked", "called", "about", "saying", "named"}:
        return True
    return token.endswith("ing") and token not in _KEPT_ING and len(token) > 5


def is_lane(phrase: str) -> bool:
    """Tell whether a phrase names a way to walk on rather than a thing beside it."""
    return _LANES.search(phrase) is not None


def is_common(phrase: str) -> bool:
    """Tell whether a thing is of a kind that is everywhere and has no name."""
    words = phrase.split()
    return words[-1] in _COMMON and len(words) <= 2
