"""Openings that are told one after the other: `openings left, right, left, all unused`."""

import re
from collections.abc import Sequence

from memorymaze.understanding.chunks import Chunk

_OPENINGS = re.compile(
    r"(?:openings|exits|branches|gaps|passages|corridors|hallways|alleys|aisles|lanes|paths"
    r"|ways|possibilities|roads|streets)\b|\bopens?(?: up)?$"
)
_LIST = re.compile(r"(?P<head>f*,?f*)(?P<sides>[nf]*[LS](?:[f,&]+[nf]*[LS])+)")


def with_listed_openings(chunks: Sequence[Chunk]) -> list[Chunk]:
    """Return chunks in which the sides of openings in a list are of openings passed.

    A list has two sides or more after a word for several openings; what one takes is
    told one at a time.
    """
    kinds = "".join(chunk.kind for chunk in chunks)
    read: list[Chunk] = []
    at = 0
    while at < len(chunks):
        chunk = chunks[at]
        found = _LIST.match(kinds, at + 1) if _is_head(chunk) else None
        if found is None or kinds[max(at - 3, 0) : at].endswith(("m", "T", "Tf")):
            read.append(chunk)
            at += 1
            continue
        for each in chunks[found.start("sides") : found.end("sides")]:
            if each.kind in "LS":
                read.append(Chunk("P", "past", each.start))
            if each.kind in "LSn,":
                read.append(each)
        at = found.end()
    return read


def _is_head(chunk: Chunk) -> bool:
    return chunk.kind in "JWNfB" and _OPENINGS.search(chunk.text) is not None
