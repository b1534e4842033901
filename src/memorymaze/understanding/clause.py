"""One clause as the rules look at it: its chunks, and a letter for the kind of each."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from memorymaze.routes.plan import Side
from memorymaze.understanding.chunks import Chunk
from memorymaze.understanding.events import Event

_ADVERBS = "hiDar"
_RECAP = re.compile(r"\b(?:both|like|i said)\b")


@dataclass(frozen=True)
class Clause:
    """A clause without its joint, and what was said before it."""

    said: Sequence[Chunk]
    """All its chunks."""
    before: Sequence[Event]
    """Events of all clauses before."""

    @cached_property
    def chunks(self) -> list[Chunk]:
        """The chunks that the rules look at, adverbs left out."""
        return [chunk for chunk in self.said if chunk.kind not in _ADVERBS]

    @cached_property
    def kinds(self) -> str:
        """The kinds of `chunks`, one letter each."""
        return "".join(chunk.kind for chunk in self.chunks)

    def has(self, kind: str) -> bool:
        """Tell whether a chunk of a kind was said, adverbs included."""
        return any(chunk.kind == kind for chunk in self.said)

    @property
    def is_recap(self) -> bool:
        """Whether it may sum up what was said: `so right and left`."""
        return self.has("r") or any(_RECAP.search(chunk.text) for chunk in self.said)

    @property
    def has_verb(self) -> bool:
        """Whether it commands: `turn`, `go`, `bends`."""
        return re.search("[TGK]", self.kinds) is not None

    def kind_before(self, at: int) -> str:
        """Return the kind of the chunk before an index, "" at the beginning."""
        return self.kinds[at - 1] if at > 0 else ""

    def last_event(self) -> Event | None:
        """Return what was said last before this clause."""
        return next((e for e in reversed(self.before) if e.kind != "clause"), None)


def side_of(chunk: Chunk) -> Side | None:
    """Return the side that a direction or `on the left` names."""
    if chunk.way is None:
        return "behind" if "clock" in chunk.text else None
    if chunk.way == "forward":
        return "ahead"
    return "left" if "left" in chunk.way else "right"


def is_aside(chunk: Chunk) -> bool:
    """Tell `on the left` from `to the left`."""
    return re.match(r"(?:on|at|in|from|along|of|with)\b", chunk.text) is not None


def towards_a_side(chunk: Chunk) -> bool:
    """Tell `to the left` from `on the left`."""
    return re.match(r"(?:to|towards?)\b", chunk.text) is not None
