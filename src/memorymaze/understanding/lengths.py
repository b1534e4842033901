"""Distances in words: metres, feet, steps, walking time, `a few`, ranges."""

import math
import re

from memorymaze.routes import Length, Unit
from memorymaze.understanding.vocabulary import ONES, QUANTITIES, TENS

_LOOSE_UNITS: tuple[Unit, ...] = ("vague", "time")
"""Units that do not count beside others."""
STEP = 0.7
"""Metres of one step."""
WALKING_SPEED = 1.0
"""Metres per second of someone who says how long a way takes."""

_ones = "|".join(sorted(ONES, key=len, reverse=True))
_tens = "|".join(TENS)
_other = "|".join(sorted((re.escape(w) for w in QUANTITIES), key=len, reverse=True))
NUMBER = (
    rf"(?:\d+(?:[.,]\d+)?|(?:{_tens})(?:[- ]?(?:{_ones}))?|(?:{_ones})|(?:{_other}))"
)
"""Pattern of a number in digits or words, lower case."""

_UNIT = (
    r"(?:m|met(?:re|er)s?|mtrs?|steps?|strides?|paces?|feet|foot|ft|yards?|yds?"
    r"|seconds?|secs?|minutes?|mins?)"
)
_ODD = r"(?:[- ]?odd|[- ]?ish|or so|more(?: like)?|good|small|little|quick|normal|slow)"
LENGTH = (
    rf"(?P<low>{NUMBER})(?:\s*(?:-|to|or|,|, or|, maybe|maybe)\s*(?P<high>{NUMBER}))?"
    rf"(?:\s*{_ODD})?(?:(?<=\d)\s*-?|\s+|-)(?P<unit>{_UNIT})\b(?: and a (?P<extra>half|bit|quarter)\b)?"
    r"(?:-ish| or so| ish)?"
)
"""Pattern of a distance: groups `low`, `high`, `unit` and `extra`."""

_IN_METRES: dict[str, float] = {
    "m": 1.0,
    "s": STEP,
    "p": 0.75,
    "f": 0.3048,
    "y": 0.9144,
}


def read_number(words: str) -> float:
    """Return the value of a number that `NUMBER` matches."""
    words = words.strip().replace(",", ".")
    if words[0].isdigit():
        return float(words)
    if words in QUANTITIES:
        return float(QUANTITIES[words])
    parts = [part for part in re.split(r"[- ]", words) if part]
    return float(sum(TENS.get(part, 0) + ONES.get(part, 0) for part in parts))


def read_length(match: re.Match[str]) -> Length:
    """Return the length of a match of `LENGTH`; ranges give their middle."""
    low = read_number(match["low"])
    high = read_number(match["high"]) if match["high"] else low
    count = (low + high) / 2 if low <= high <= 4 * low else high
    if match["extra"]:
        count += {"half": 0.5, "bit": 0.2, "quarter": 0.25}[match["extra"]]
    unit = match["unit"]
    vague = match["low"].strip() in {"a few", "few", "some", "several", "a couple of"}
    kind: Unit = "metres"
    if unit.startswith("min"):
        metres, kind = count * 60.0 * WALKING_SPEED, "time"
    elif unit.startswith("sec"):
        metres, kind = count * WALKING_SPEED, "time"
    elif unit.startswith("st"):
        metres, kind = count * STEP, "steps"
    elif unit.startswith("p"):
        metres, kind = count * _IN_METRES["p"], "steps"
    elif unit.startswith("f"):
        metres = count * _IN_METRES["f"]
    elif unit.startswith("y"):
        metres = count * _IN_METRES["y"]
    else:
        metres = count
    return Length(metres, "vague" if vague else kind)


SEGMENT_METRES = 10.0
"""Metres of a segment, where metres are needed: those of a hall between two corners."""
_FEW = r"\d{1,2}|one|two|three|four|five|six|seven|eight|nine|ten|a couple(?: of)?"
_GOING = (
    r"(?:(?<=\bgo )|(?<=\bwalk )|(?<=\bmove )|(?<=forward )|(?<=\bdown )|(?<=\bahead )"
    r"|(?<=straight )|(?<=\bcontinue )|(?<=\bup )|(?<=\balong ))"
)
_TIMES = {"once": 1.0, "twice": 2.0, "thrice": 3.0}
_ENDS = r"(?= *(?:[.,;]|$|and\b|then\b|more\b|to\b|or\b|into\b|past\b|turn\b|so\b))"
SEGMENTS = (
    rf"(?:(?P<count>{_FEW}) (?:(?:more |full |whole |hall(?:way)? )?segments?\b"
    r"|(?:intersections?|junctions?|blocks?|alleys?) (?=(?:past|beyond|after)\b))"
    rf"|{_GOING}(?:(?P<places>{_FEW}) (?:more )?(?:blocks?|squares?|spaces?|units?"
    r"|sections?|intersections?|junctions?|alleys?|moves?|steps? forward)\b"
    rf"|(?P<bare>{_FEW}){_ENDS}|(?P<times>once|twice|thrice){_ENDS}"
    rf"|(?P<often>{_FEW}) times\b))"
)
"""Pattern of a length counted in places where one can turn."""


def read_segments(match: re.Match[str]) -> Length:
    """Return the length of a match of `SEGMENTS`."""
    if match["times"]:
        count = _TIMES[match["times"]]
    else:
        words = next(
            match[name] for name in ("count", "places", "bare", "often") if match[name]
        )
        count = read_number(words)
    return Length(count * SEGMENT_METRES, "places", count)


def combine_lengths(lengths: list[Length]) -> Length | None:
    """Return one length for all that were said about the same leg.

    Lengths counted in the same unit are stretches one after the other and add up;
    those in different units say the same thing twice and are averaged.
    """
    if not lengths:
        return None
    sums: dict[Unit, float] = {}
    for length in lengths:
        sums[length.unit] = sums.get(length.unit, 0.0) + length.metres
    for loose in _LOOSE_UNITS:
        if loose in sums and len(sums) > 1:
            del sums[loose]
    if "places" in sums:
        count = sum(each.count or 0.0 for each in lengths)
        return Length(sums["places"], "places", count)
    metres = math.exp(sum(math.log(max(v, 0.3)) for v in sums.values()) / len(sums))
    return Length(metres, next(iter(sums)))
