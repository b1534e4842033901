"""Sentences, and how they stand on the page."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from memorymaze.writing.clauses import is_command
from memorymaze.writing.marked_text import (
    Marked,
    capitalised,
    without_marks,
)
from memorymaze.writing.voices import Voice

RUN_TOGETHER = {True: 0.4, False: 0.15}
"""Share of sentences joined to the one before, in speech and in typing."""
LONGEST_FIRST = 12
"""Words of a sentence that another one is joined to."""
NOT_JOINED = (
    "and",
    "after that",
    "so",
    "now",
    "then",
    "next",
    "um",
    "uh",
    "er",
    "well",
)


@dataclass(frozen=True, slots=True)
class Told:
    """A plan in words."""

    text: str
    marks: tuple[Marked, ...]


def as_sentence(text: str) -> str:
    """Return a marked text with a capital and a full stop."""
    ended = without_marks(text).endswith((".", "?", "!"))
    return capitalised(text) + ("" if ended else ".")


def run_together(texts: Sequence[str], voice: Voice, rng: np.random.Generator) -> str:
    """Return marked texts as sentences, some of them joined."""
    sentences = [texts[0]]
    for text, chance in zip(texts[1:], rng.random(len(texts) - 1), strict=True):
        before, plain = without_marks(sentences[-1]), without_marks(text)
        fits = len(before.split()) < LONGEST_FIRST and not before.endswith(("?", "."))
        joined = fits and not plain.startswith(NOT_JOINED)
        if chance < RUN_TOGETHER[voice.spoken] and joined:
            command = is_command(plain) and not is_command(before)
            sentences[-1] += f", {'and then' if command else 'and'} {text}"
        else:
            sentences.append(text)
    return " ".join(as_sentence(each) for each in sentences)


def laid_out(items: Sequence[str], voice: Voice) -> str:
    """Return what is said at each step as prose, lines or a numbered list."""
    if voice.layout == "prose":
        return " ".join(items)
    if voice.layout == "lines":
        return "\n".join(items)
    return "\n".join(
        f"{voice.marker.format(n=number)} {item}"
        for number, item in enumerate(items, 1)
    )
