"""Text that carries labels, so that errors can be found to the word.

While a text is put together, labels are kept inside it between control characters;
`unmarked` takes them out and says where they lay.
"""

from typing import NamedTuple

OPEN, END_OF_LABEL, CLOSE = "\x02", "\x1f", "\x03"


class Marked(NamedTuple):
    """A labelled stretch of a text; `start == end` where words are missing."""

    label: str
    start: int
    """Character."""
    end: int
    """Character after the last one."""


def mark(label: str, text: str) -> str:
    """Return a text that carries a label."""
    return f"{OPEN}{label}{END_OF_LABEL}{text}{CLOSE}"


def unmarked(marked: str) -> tuple[str, list[Marked]]:
    """Return the text without labels, and where each label lay.

    >>> unmarked("Turn " + mark("side", "left") + ".")
    ('Turn left.', [Marked(label='side', start=5, end=9)])
    """
    plain: list[str] = []
    length = 0
    begun: list[tuple[str, int]] = []
    found: list[Marked] = []
    for part in (
        marked.replace(OPEN, "\x00" + OPEN).replace(CLOSE, "\x00" + CLOSE).split("\x00")
    ):
        rest = part
        if part.startswith(OPEN):
            label, _, rest = part[1:].partition(END_OF_LABEL)
            begun.append((label, length))
        elif part.startswith(CLOSE):
            label, start = begun.pop()
            found.append(Marked(label, start, length))
            rest = part[1:]
        plain.append(rest)
        length += len(rest)
    return "".join(plain), sorted(found, key=lambda each: (each.start, each.end))


def without_marks(marked: str) -> str:
    """Return the text alone."""
    return unmarked(marked)[0]


def capitalised(marked: str) -> str:
    """Return a text whose first letter, labels left aside, is a capital."""
    inside = False
    for place, character in enumerate(marked):
        if character == OPEN:
            inside = True
        elif character == END_OF_LABEL:
            inside = False
        elif not inside and character != CLOSE:
            return marked[:place] + character.upper() + marked[place + 1 :]
    return marked
