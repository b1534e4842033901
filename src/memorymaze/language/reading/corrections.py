"""Self-corrections and stutters: what was taken back is removed.

"Turn left, no wait, sorry, right" becomes "turn right"; "right, right" one turn.
"""

import re
from dataclasses import replace

from memorymaze.language.plans import STEP_METRES, Length
from memorymaze.language.reading.chunks import Chunk
from memorymaze.language.reading.lengths import MINUTE, PLACE_METRES

_CLASSES = {
    "L": "way",
    "S": "way",
    "2": "way",
    "O": "order",
    "M": "length",
    "n": "length",
}
_NEUTRAL = set(",.fhi>&r")
_REACH = 3
"""How many other words may stand between what is taken back and the correction."""


def apply_corrections(chunks: list[Chunk]) -> list[Chunk]:
    """Return the chunks without what the speaker took back."""
    chunks = list(chunks)
    at = 0
    while at < len(chunks):
        if not _is_marker(chunks, at):
            at += 1
            continue
        end = at + 1
        while end < len(chunks) and (
            chunks[end].kind in _NEUTRAL
            or _is_marker(chunks, end)
            or (chunks[end].kind == "X" and chunks[end].text == "no")
        ):
            end += 1
        new = _first_value(chunks, end)
        old = None if new is None else _last_value(chunks, at, chunks[new])
        refused = chunks[at].kind == "X" and old is not None and new is not None
        if refused and _same_way(chunks[old or 0], chunks[new or 0]):
            new = None  # "there is a left, no. then left"
        if new is None or old is None:
            early = _said_too_early(chunks, at, end)
            del chunks[early : early + 1]
            at = end
            continue
        chunks = _replaced(chunks, old, new)
        at = old + 1
    return _without_echoes([chunk for chunk in chunks if chunk.kind != "C"])


def _without_echoes(chunks: list[Chunk]) -> list[Chunk]:
    """Drop the second of `right, yes, right` and of `first left, first left`."""
    kept: list[Chunk] = []
    for at, chunk in enumerate(chunks):
        if chunk.kind == "d" and any(c.kind == "d" for c in kept[-4:]):
            continue
        if chunk.kind == "L" and _repeats(kept, chunk, chunks[at + 1 : at + 9]):
            continue
        confirmed = chunks[at + 1 : at + 3]
        kinds = "".join(each.kind for each in confirmed)
        if chunk.kind in "LS" and _is_echo(kept, chunk, confirmed=kinds == ",e"):
            while kept[-1].kind in "OJ":
                kept.pop()
            continue
        kept.append(chunk)
    return [chunk for chunk in kept if chunk.kind != "e"]


def _repeats(before: list[Chunk], chunk: Chunk, after: list[Chunk]) -> bool:
    """`At the desk right, right`, but not `right, right, left`, a list of turns."""
    said = [each for each in before[-8:] if each.kind != "f"]
    kinds = "".join(each.kind for each in said)
    contrast = re.search("L,+XL,$", kinds)
    if contrast is not None:  # "right, not left, right"
        first = said[contrast.start()]
        return first.way == chunk.way and said[-2].way != chunk.way
    if re.search("[TGZAEJNOt>]L,$", kinds) is None or said[-2].way != chunk.way:
        return False
    return re.match("f*,f*[&>]?f*L", "".join(each.kind for each in after)) is None


def _is_echo(before: list[Chunk], chunk: Chunk, *, confirmed: bool) -> bool:
    gap = ""
    for at in range(len(before) - 1, -1, -1):
        earlier = before[at]
        if earlier.kind in "LS":
            told = before[at - 1].number if at and before[at - 1].kind == "O" else None
            same = told is not None and told == before[-1].number
            ordinals = same and re.fullmatch("O[,f]+", gap) is not None
            return earlier.way == chunk.way and (
                ordinals
                or (confirmed and re.fullmatch("J?O[,f]+", gap) is not None)
                or (
                    re.search("e|h,", gap) is not None
                    and re.fullmatch("O?[,.fherZ&]*", gap) is not None
                )
            )
        gap += "" if earlier.kind == "f" else earlier.kind
        if len(gap) > 8:
            return False
    return False


def _is_marker(chunks: list[Chunk], at: int) -> bool:
    chunk = chunks[at]
    if chunk.kind == "C":
        return True
    if chunk.kind == "X" and chunk.text == "no":
        before = at == 0 or chunks[at - 1].kind in ",."
        if at and chunks[at - 1].text.startswith("..") and at + 1 < len(chunks):
            return chunks[at + 1].kind in "L."
        after = at + 1 < len(chunks) and chunks[at + 1].kind in ",."
        if "".join(c.kind for c in chunks[at + 1 : at + 3]) == ",&":
            return False  # "one on the left, no, and one on the right"
        return before and after
    return False


def _first_value(chunks: list[Chunk], start: int) -> int | None:
    """Index of the first thing said after a marker that can replace something."""
    others = 0
    for at in range(start, min(start + 8, len(chunks))):
        kind = chunks[at].kind
        if kind in _CLASSES:
            return at
        if kind in "IYo" or others >= _REACH:
            return None
        if kind == "N" or (kind == "." and at > start):
            return None
        if kind not in _NEUTRAL:
            others += 1
    return None


def _last_value(chunks: list[Chunk], marker: int, new: Chunk) -> int | None:
    """Index of what the new value replaces: the last of its class before."""
    others = 0
    for at in range(marker - 1, max(marker - 12, -1), -1):
        chunk = chunks[at]
        if _CLASSES.get(chunk.kind) == _CLASSES[new.kind]:
            subject = chunk.kind == "L" and chunks[at + 1].kind == "B"
            return None if subject else at
        if chunk.kind not in _NEUTRAL:
            others += 1
        if others > _REACH:
            return None
    return None


def _said_too_early(chunks: list[Chunk], marker: int, end: int) -> int:
    """`Left, no wait, first to the desk, and only then left`: the index of the first.

    The number of chunks, where nothing was said too early.
    """
    said = marker - 1
    while said > 0 and chunks[said].kind in _NEUTRAL:
        said -= 1
    later = next((n for n in range(end, len(chunks)) if chunks[n].kind in "LS2"), end)
    between = "".join(each.kind for each in chunks[end:later])
    again = later > end and _same_way(chunks[said], chunks[later])
    if again and ">" in between and between.count(".") < 2:
        return said
    return len(chunks)


def _replaced(chunks: list[Chunk], old: int, new: int) -> list[Chunk]:
    """Drop everything from the old value up to the new one.

    Things named between the old value and the marker stay; an ordinal before the old
    value goes when the new value brings its own.
    """
    value = chunks[new]
    if chunks[old].kind == "M" and value.kind == "n" and value.number is not None:
        before = chunks[old].length
        unit = before.unit if before else "metres"
        length = Length(
            value.number * _unit_metres(chunks[old]),
            unit,
            value.number if unit == "places" else None,
        )
        value = Chunk("M", value.text, value.start, length=length)
    if chunks[old].kind == "S" and value.kind == "L":
        value = replace(value, kind="S", text=chunks[old].text)
    said = chunks[old + 1 : new]
    # A thing keeps the preposition before it: "left at the stairs, no, right".
    kinds = "".join(each.kind for each in said)
    kept = [said[at] for at in range(len(said)) if re.match("Af*N|N", kinds[at:])]
    start = old
    if (
        value.kind in "LS2"
        and start > 0
        and chunks[start - 1].kind == "O"
        and any(chunk.kind == "O" for chunk in chunks[old:new])
    ):
        start -= 1
    ordinals = [chunk for chunk in chunks[old + 1 : new] if chunk.kind == "O"][-1:]
    rest = _after_an_aside(chunks, new + 1)
    if not (rest < len(chunks) and _same_way(chunks[rest], value)):
        rest = new
    return [*chunks[:start], *kept, *ordinals, value, *chunks[rest + 1 :]]


def _after_an_aside(chunks: list[Chunk], start: int) -> int:
    """Return where one goes on after a correction: `right, I mix them up, right at …`."""
    at = start
    while at < len(chunks) and chunks[at].kind in _NEUTRAL - {"."}:
        at += 1
    comma = next((n for n in range(at, len(chunks)) if chunks[n].kind in ",."), at)
    aside = chunks[start:comma]
    kinds = {each.kind for each in aside}
    if "i" not in {each.text for each in aside} or kinds & set("LS2OEJMTGKUAPQ."):
        return at
    while comma < len(chunks) and chunks[comma].kind in _NEUTRAL - {"."}:
        comma += 1
    return comma


def _same_way(chunk: Chunk, other: Chunk) -> bool:
    return chunk.kind in "LS" and other.kind in "LS" and chunk.way == other.way


def _unit_metres(chunk: Chunk) -> float:
    """Metres of one of the units that a length was counted in."""
    if chunk.length is None:
        return 1.0
    if chunk.length.unit == "steps":
        return STEP_METRES
    if chunk.length.unit == "places":
        return PLACE_METRES
    return MINUTE if re.search(r"\bmin", chunk.text) else 1.0
