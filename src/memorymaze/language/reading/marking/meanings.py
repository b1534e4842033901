"""What the words of one mark mean: numbers, lengths, openings left alone, things."""

import re
from typing import Literal

from memorymaze.language.plans import Length, Passing, Totals
from memorymaze.language.plans.records import MOST_COUNTED
from memorymaze.language.reading.lengths import (
    LENGTH,
    NUMBER,
    TIMES,
    length_in_places,
    read_length,
    read_number,
    read_vague,
)
from memorymaze.language.reading.spoken_numbers import with_plain_numbers
from memorymaze.language.reading.things import floor_phrase, thing_phrase
from memorymaze.language.reading.vocabulary import ONES, ORDINALS

_SIGNS = str.maketrans({
    "\u2019": "'",
    "\u2018": "'",
    "\u201c": '"',
    "\u201d": '"',
    "&": " and ",
})
_DIGITS = re.compile(r"([1-9]\d{0,5})(?:st|nd|rd|th)?")
_BACKWARDS = re.compile(r"\b(?:to last|last but|but one|second last|penultimate)\b")
"""Counts that are told from the end; only the last has a number here."""

_PLACE = (
    r"(?:(?:segment|intersection|junction|crossing|block|alley|aisle|square|section"
    r"|corridor|hallway|passage)s?|times)"
)
_COUNTED_IN_PLACES = re.compile(
    rf"\b(?:(?P<count>{NUMBER}) (?:more |full |whole |other )?{_PLACE}|once|twice)\b"
)
_NUMBER = re.compile(rf"\b(?P<count>\d+(?:\.\d+)?|{NUMBER})(?:[- ]?ish)?\b")
_NAMED = re.compile(r" (?!(?:more|or|odd|to|and|then|also|maybe|again|further)\b)[a-z]")
"""What comes after a number of things that have a name."""
_TURNS = re.compile(rf"(?P<count>{NUMBER}) (?:\w+ )?(?:turn(?:ing)?s?|corners|bends)\b")

_SIDES = re.compile(r"\b(left|right)\b")
_BOTH_SIDES = re.compile(r"\b(?:each|either|both) (?:side|hand|wall)s?\b")
_NONE = re.compile(
    r"\b(?:don'?t|do not|no|none|not|never|any|all|every|everything|without|nothing|anything)\b"
)
_CROSSING = re.compile(r"cross|junction|intersection")
_HOW_MANY = {**ONES, "both": 2, "couple": 2, "pair": 2, "few": 3, "several": 4}

_ARTICLE = re.compile(r"^(?:the|an?|some|your|that|this|those|these|its)\s+")
_INNER = re.compile(
    r"\b(of|on|with|in|to|at|by|opposite|beside|like) (?:the|an?|your) "
)
_WRITTEN = re.compile(
    r"(?i:\b(doors?|signs?|boards?|screens?|panels?) with (?:the |an? )?)(?=[A-Z\d])"
)
"""What bears a name: in the middle of a sentence that is what has a capital."""
_ON_IT = re.compile(r"(?: written)? on (?:it|them)$")
_POSSESSIVE = re.compile(r"'s?(?!\w)")
_ROOM = re.compile(r"(?:door |room |number )*(\d+\w?)")
_ROOM_IN_WORDS = re.compile(rf"(?:door |room |number )*({'|'.join(ONES)})")


def _plain(words: str) -> str:
    return with_plain_numbers(" ".join(words.translate(_SIGNS).lower().split()))


def ordinal_in(words: str) -> int | None:
    """Return which one is meant, -1 for the last; `None` if that has no number."""
    said = _plain(words)
    if _BACKWARDS.search(said) is not None:
        return None
    for word in re.findall(r"\w+", said):
        if (number := ORDINALS.get(word, ONES.get(word))) is not None:
            return number
        if (digits := _DIGITS.fullmatch(word)) is not None:
            return int(digits[1])
    return None


def unit_in(words: str) -> str | None:
    """Return the word for what a length is counted in, if it says one."""
    found = re.search(LENGTH, _plain(words))
    return found["unit"] if found is not None else None


def length_in(words: str, unit: str) -> Length:
    """Return a length; a number alone is counted in a unit that was told elsewhere."""
    said = _plain(words)
    if (found := re.search(LENGTH, said)) is not None:
        return read_length(found)
    if (places := _COUNTED_IN_PLACES.search(said)) is not None:
        told = places["count"]
        count = read_number(told) if told is not None else TIMES[places[0]]
        if count > 0:
            return length_in_places(count)
    if (number := _NUMBER.search(said)) is not None:
        count = read_number(number["count"])
        rest = said[number.end() :]
        units = re.findall(r"\w+", rest)
        if _NAMED.match(rest) is None:
            units.append(unit)
        for each in units if count > 1 else ():
            if (found := re.search(LENGTH, f"{count:.10g} {each}")) is not None:
                return read_length(found)
    return read_vague(said)


def totals_in(words: str) -> Totals:
    """Return what is said of the whole way."""
    said = _plain(words)
    turns, length = _TURNS.search(said), re.search(LENGTH, said)
    count = round(read_number(turns["count"])) if turns is not None else None
    return Totals(count, read_length(length).metres if length is not None else None)


def passings_in(words: str) -> list[Passing]:
    """Return the openings or junctions that are left alone, on each side that is told."""
    said = _plain(words)
    what = "crossing" if _CROSSING.search(said) is not None else None
    if _BOTH_SIDES.search(said) is not None:
        count = _how_many(said)
        return [Passing(count, "left", what), Passing(count, "right", what)]
    found: list[Passing] = []
    start = 0
    for each in _SIDES.finditer(said):
        part = said[start : each.end()]
        start = each.end()
        alone = found and re.search(r"\d|[a-z]{3,}", part[: -len(each[0])]) is None
        count = found[-1].count if alone else _how_many(part)
        side: Literal["left", "right"] = "left" if each[0] == "left" else "right"
        found.append(Passing(count, side, what))
    return found or [Passing(_how_many(said), None, what)]


def _how_many(said: str) -> int | None:
    """Return how many; `None` for all there are. Of `the second` it is one."""
    counts = [
        int(word) if word.isdigit() else _HOW_MANY[word]
        for word in re.findall(r"\w+", said)
        if word in _HOW_MANY or (word.isdigit() and 0 < int(word[:7]) <= MOST_COUNTED)
    ]
    if counts:
        return min(max(counts), MOST_COUNTED)
    return None if _NONE.search(said) is not None else 1


def phrase_in(words: str, *, is_goal: bool = False) -> str:
    """Return a thing as one asks for it; empty if the words name none.

    A number alone is a room if one wants to get there.

    >>> phrase_in("the glass doors with A1 on them"), phrase_in("a door with a window")
    ('glass door that says a1', 'door with window')
    """
    words = _WRITTEN.sub(r"\1 that says ", _ON_IT.sub("", words))
    said = _POSSESSIVE.sub("", _plain(words).replace('"', "")).split(",")[0].strip(" '")
    said = _INNER.sub(r"\1 ", _ARTICLE.sub("", said))
    if (room := _ROOM.fullmatch(said)) is not None:
        return f"door that says {room[1].upper()}"
    if is_goal and (room := _ROOM_IN_WORDS.fullmatch(said)) is not None:
        return f"door that says {ONES[room[1]]}"
    return floor_phrase(said) or thing_phrase(said)
