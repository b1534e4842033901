"""Distances in words: metres, feet, steps, walking time, `a few`, ranges."""

import math
import re

from memorymaze.language.plans import SECOND_METRES, STEP_METRES, Length, Totals, Unit
from memorymaze.language.reading.vocabulary import ONES, QUANTITIES, TENS

_LOOSE_UNITS: tuple[Unit, ...] = ("vague", "time")
"""Units that do not count beside others."""
A_FEW_STEPS = 4.0
"""Metres, as people say it."""
MINUTE = 60 * SECOND_METRES

_ones = "|".join(sorted(ONES, key=len, reverse=True))
_tens = "|".join(TENS)
_other = "|".join(sorted((re.escape(w) for w in QUANTITIES), key=len, reverse=True))
NUMBER = rf"(?:(?<!\d)\d{{1,6}}(?!\d)(?:[.,]\d{{1,6}}(?!\d))?|(?:{_tens})(?:[- ]?(?:{_ones}))?|(?:{_ones})|(?:{_other}))"
"""Pattern of a number in digits or words, lower case; longer ones count nothing."""

_UNIT = (
    r"(?:m|met(?:re|er)s?|mtrs?|steps?|strides?|paces?|feet|foot|ft|yards?|yds?"
    r"|(?<!\ba )second|seconds|secs?|minutes?|mins?)"
)
_ODD = r"(?:[- ]?odd|[- ]?ish|[- ]some|or so|more(?: like)?|good|small|little|quick|normal|slow)"
LENGTH = (
    rf"(?P<low>{NUMBER})(?:\s*(?:-|to|or|,|, or|, maybe|maybe)\s*(?P<high>(?!some\b){NUMBER}))?"
    rf"(?:\s*{_ODD})?(?:(?<=\d)\s*-?|\s+|-)(?P<unit>{_UNIT})\b(?: and a (?P<extra>half|bit|quarter)\b)?"
    r"(?:-ish| or so| ish)?(?! (?:ago|late|early|old)\b)"
)
"""Pattern of a distance: groups `low`, `high`, `unit` and `extra`."""

_IN_ALL = r",? (?:in (?:all|total)|all in all|altogether|overall)\b"
_TURNS_IN_ALL = re.compile(rf"\b(?P<count>{NUMBER}) turn(?:ing)?s?{_IN_ALL}")
_FIGURES = re.compile(
    rf"(?:(?<=[.:;] )|^)(?:{LENGTH}(?:,| and) (?P<count>{NUMBER}) (?:turn(?:ing)?s?|corners)"
    rf"|(?P<turns>{NUMBER}) (?:turn(?:ing)?s?|corners)(?:,| and) {LENGTH.replace('(?P<', '(?P<_')})(?= *[.;:])"
)
"""`157 m, 8 turns.`: a sentence of figures alone."""
_LENGTH_IN_ALL = re.compile(rf"\b{LENGTH}{_IN_ALL}")
_IN_METRES: dict[str, float] = {
    "m": 1.0,
    "s": STEP_METRES,
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
    if vague and unit.startswith(("st", "p")):
        return Length(A_FEW_STEPS, "vague")
    kind: Unit = "metres"
    if unit.startswith("min"):
        metres, kind = count * MINUTE, "time"
    elif unit.startswith("sec"):
        metres, kind = count * SECOND_METRES, "time"
    elif unit.startswith("st"):
        metres, kind = count * STEP_METRES, "steps"
    elif unit.startswith("p"):
        metres, kind = count * _IN_METRES["p"], "steps"
    elif unit.startswith("f"):
        metres = count * _IN_METRES["f"]
    elif unit.startswith("y"):
        metres = count * _IN_METRES["y"]
    else:
        metres = count
    return Length(metres, "vague" if vague else kind)


PLACE_METRES = 8.0
"""Metres from one place where one can turn to the next, where metres are needed."""
_FEW = r"[1-9]\d?|one|two|three|four|five|six|seven|eight|nine|ten|a couple(?: of)?"
_GOING = (
    r"(?:(?<=\bgo )|(?<=\bwalk )|(?<=\bmove )|(?<=forward )|(?<=\bdown )|(?<=\bahead )"
    r"|(?<=straight )|(?<=\bcontinue )|(?<=\bup )|(?<=\balong ))"
)
TIMES = {"once": 1.0, "twice": 2.0, "thrice": 3.0}
_ENDS = r"(?= *(?:[.,;]|$|and\b|then\b|more\b|to\b|or\b|into\b|past\b|turn\b|so\b))"
PLACES = (
    rf"(?:(?P<count>{_FEW}) (?:(?:more |full |whole |hall(?:way)? )?segments?\b"
    r"|(?:intersections?|junctions?|blocks?|alleys?) (?=(?:past|beyond|after)\b))"
    rf"|{_GOING}(?:(?P<places>{_FEW}) (?:more )?(?:blocks?|squares?|spaces?|units?"
    r"|sections?|intersections?|junctions?|alleys?|moves?|steps? forward)\b"
    rf"|(?P<bare>{_FEW}){_ENDS}|(?P<times>once|twice|thrice){_ENDS}"
    rf"|(?P<often>{_FEW}) times\b))"
)
"""Pattern of a length counted in places where one can turn."""


def read_places(match: re.Match[str]) -> Length:
    """Return the length of a match of `PLACES`."""
    if match["times"]:
        count = TIMES[match["times"]]
    else:
        words = next(
            match[name] for name in ("count", "places", "bare", "often") if match[name]
        )
        count = read_number(words)
    return length_in_places(count)


def length_in_places(count: float) -> Length:
    """Return the length of so many corridors, blocks or junctions."""
    return Length(count * PLACE_METRES, "places", count)


def read_totals(text: str) -> tuple[str, Totals]:
    """Take what is said of the whole way out of a text in lower case.

    >>> read_totals("it is 80 metres in all. turn left.")
    ('it is . turn left.', Totals(turns=None, metres=80.0))
    """
    figures = _FIGURES.search(text)
    if figures is not None:
        in_all = figures[0].replace(",", " in all ,").replace(" and ", " in all and ")
        text = f"{text[: figures.start()]}{in_all} in all{text[figures.end() :]}"
    turns = _TURNS_IN_ALL.search(text)
    if turns is not None:
        text = text[: turns.start()] + text[turns.end() :]
    length = _LENGTH_IN_ALL.search(text)
    if length is not None:
        text = text[: length.start()] + text[length.end() :]
    return text, Totals(
        round(read_number(turns["count"])) if turns is not None else None,
        read_length(length).metres if length is not None else None,
    )


_VAGUE_METRES = (("little", 4.0), ("short", 6.0), ("quite", 25.0), ("long", 25.0))
_A_WHILE = 12.0
VAGUE_LENGTH = (
    r"(?P<size>long|short)(?= (?:one|walk|stretch|straight)\b)|"
    rf"(?:{_GOING}|(?<=\bon )|(?<=\bgoing ))(?P<vague>for (?:quite )?a (?:long |short |little )?"
    r"(?:way|while|distance|stretch|bit|time)|(?:for )?a little(?: bit| way)?"
    r"|(?:quite )?a (?:short |long |little )?(?:bit|way|while|distance|stretch))"
    r"(?= *(?:[.,;]|$|and\b|then\b|until\b|till\b|further\b|past\b|to the (?!left|right)))"
)
"""Pattern of a length without a number, after a word for going."""


def read_vague(words: str) -> Length:
    """Return the length of words that `VAGUE_LENGTH` matches, or that name a way by it."""
    found = (metres for word, metres in _VAGUE_METRES if word in words)
    return Length(next(found, _A_WHILE), "vague")


def combine_lengths(lengths: list[Length]) -> Length | None:
    """Return one length for all that were said about the same leg.

    Lengths counted in the same unit are stretches one after the other and add up;
    those in different units say the same thing twice and are averaged.
    """
    if not lengths:
        return None
    for length in lengths:
        if length.after is not None:
            return length  # what else is said leads to the thing
    sums: dict[Unit, float] = {}
    for length in lengths:
        sums[length.unit] = sums.get(length.unit, 0.0) + length.metres
    for loose in _LOOSE_UNITS:
        if loose in sums and len(sums) > 1:
            del sums[loose]
    if "places" in sums:
        count = sum(each.count or 0.0 for each in lengths)
        return Length(sums["places"], "places", count)
    if len(sums) == 1:
        ((unit, metres),) = sums.items()
        return Length(metres, unit)
    metres = math.exp(sum(math.log(max(v, 0.3)) for v in sums.values()) / len(sums))
    return Length(metres, next(iter(sums)))
