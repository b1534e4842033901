"""Openings that are told one after the other: `openings left, right, left, all unused`."""

import re
from collections.abc import Iterator, Sequence

from memorymaze.language.reading.chunks import Chunk

_OPENINGS = re.compile(
    r"(?:openings|exits|branches|gaps|passages|corridors|hallways|halls|turnings|alleys"
    r"|aisles|lanes|paths|ways|possibilities|roads|streets)\b|\bopens?(?: up)?$"
)
_EXISTING = re.compile(
    r"B(?P<sides>[fn]*[LS](?:[f,&>aBnl]+[LS])+)[f,&]*(?P<refused>I)(?=f*(?:[.,;&>]|$))"
)
_ALL = re.compile(r"none of|\b(?:all|any|both|them|those|these|neither|dem)\b")
_LIST = re.compile(r"(?P<head>f*,?f*)(?P<sides>[nfa]*[LS](?:[f,&]+[nfa]*[LS])+)")
_LEFT_ALONE = re.compile(_LIST.pattern + "f*,?f*I[,.&]")
"""`With a left, a right and a left that were ignored.`"""


def with_listed_openings(chunks: Sequence[Chunk]) -> list[Chunk]:
    """Return chunks in which the sides of openings in a list are of openings passed.

    A list has two sides or more after a word for several openings, or after `there is`
    and before `none of those`; what one takes is told one at a time.
    """
    chunks = _without_refused(chunks)
    kinds = "".join(chunk.kind for chunk in chunks)
    read: list[Chunk] = []
    at = 0
    while at < len(chunks):
        chunk = chunks[at]
        listed = (
            _LIST if _is_head(chunk) else _LEFT_ALONE if chunk.kind == "A" else None
        )
        found = listed.match(kinds, at + 1) if listed else None
        if found is None or kinds[max(at - 3, 0) : at].endswith(("m", "T", "Tf")):
            read.append(chunk)
            at += 1
            continue
        read.extend(_passed(chunks[found.start("sides") : found.end("sides")]))
        at = found.end()
    return read


def _without_refused(chunks: Sequence[Chunk]) -> list[Chunk]:
    """`There is a left, a right, another left, and none of those.`: openings passed."""
    kinds = "".join(chunk.kind for chunk in chunks)
    read: list[Chunk] = []
    at = 0
    for found in _EXISTING.finditer(kinds):
        refused = chunks[found.start("refused") :][:2]
        if _ALL.search(" ".join(each.text for each in refused)):
            read.extend(chunks[at : found.start()])
            read.extend(_passed(chunks[found.start("sides") : found.end("sides")]))
            at = found.end()
    return [*read, *chunks[at:]]


def _passed(listed: Sequence[Chunk]) -> Iterator[Chunk]:
    """Yield the sides of a list as those of openings passed, with their joints."""
    for chunk in listed:
        if chunk.kind in "LS":
            yield Chunk("P", "past", chunk.start)
        if chunk.kind in "LSn,":
            yield chunk
        elif chunk.kind in "&>":
            yield Chunk(",", ",", chunk.start)


def _is_head(chunk: Chunk) -> bool:
    return chunk.kind in "JWNfB" and _OPENINGS.search(chunk.text) is not None
