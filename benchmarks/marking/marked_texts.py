"""Marked texts as labels of their words."""

import json
import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from memorymaze.language.plans import RoutePlan
from memorymaze.language.reading.marking.marks import OF_NO_LEG, Mark, ends_leg
from memorymaze.language.reading.marking.plans import plan_of_marks
from memorymaze.language.reading.marking.word_pieces import Word, words_in
from memorymaze.texts.corpus import load_corpus

MARKED_TEXTS = Path("examples/marked_texts")
TIMES = {"shipped": 2, "voices": 2, "from_memory": 3, "sail": 3}
"""How often texts count whose manner few others have, by the file they are in."""
KEPT_BACK = "not_learned"
"""The file of texts that readers are judged by, and learn nothing from."""
SIDES = frozenset({"left", "right"})


@dataclass(frozen=True, slots=True)
class MarkedWord:
    """A word, and what it is part of."""

    text: str
    label: str = ""
    begins: bool = False
    """Whether it is the first word of its mark."""
    leg: int = -1

    @property
    def steps(self) -> bool:
        """Whether a mark begins here that tells on which leg the speaker is."""
        return self.begins and self.label not in OF_NO_LEG


@dataclass(frozen=True, slots=True)
class MarkedText:
    """A text by one person."""

    id: str
    person: str
    words: tuple[MarkedWord, ...]
    turns: int


def load_marked_texts(
    folder: Path = MARKED_TEXTS, sail: Path | None = None
) -> list[MarkedText]:
    """Return all marked texts to learn from; those of SAIL where its folder is given."""
    corpus = {
        each.instruction.id: each.instruction.text for each in load_corpus().episodes
    }
    if sail is not None:
        lines = (sail / "instructions.jsonl").read_text("utf-8").splitlines()
        corpus |= {each["id"]: each["text"] for each in map(json.loads, lines)}
    texts: list[MarkedText] = []
    for path in sorted(folder.glob("*.jsonl")):
        if path.stem == KEPT_BACK or (path.stem == "sail" and sail is None):
            continue
        for line in path.read_text("utf-8").splitlines():
            record = json.loads(line)
            number = record["id"]
            person = {
                "invented": number,
                "from_memory": number,
                "sail": number.partition("-")[0],
            }.get(path.stem, number.rpartition("-")[0])
            text = record.get("text") or corpus[number]
            marked = _marked(number, person, text, record["marks"])
            texts += [marked] * TIMES.get(path.stem, 1)
    return texts


def load_kept_back(folder: Path = MARKED_TEXTS) -> Iterator[tuple[MarkedText, str]]:
    """Yield the marked texts that nothing is learned from, and how they are written."""
    for line in (folder / f"{KEPT_BACK}.jsonl").read_text("utf-8").splitlines():
        record = json.loads(line)
        number, text = record["id"], record["text"]
        yield _marked(number, number, text, record["marks"]), text


def _marked(number: str, person: str, text: str, marks: Sequence[Any]) -> MarkedText:
    words = words_in(text)
    marked = [MarkedWord(each.text) for each in words]
    after = 0
    for *said, label, leg in marks:
        if len(said) == 2:
            inside = range(*said)
        else:
            start = text.index(said[0], after)
            after = start + len(said[0])
            inside = _within(words, start, after)
        kind = label.split(":")[0]
        label = kind if kind in {"ordinal", "nth"} else label
        for place, at in enumerate(inside):
            if not marked[at].label:
                marked[at] = replace(
                    marked[at], label=label, begins=place == 0, leg=leg
                )
    turns = max((each[-1] for each in marks), default=0)
    return MarkedText(number, person, tuple(_only_sides(marked)), turns)


def _within(words: Sequence[Word], start: int, end: int) -> range:
    """Return the words of a piece, without punctuation at its ends."""
    inside = range(
        bisect_right(words, start, key=lambda word: word.end),
        bisect_left(words, end, key=lambda word: word.start),
    )
    said = [n for n in inside if re.match(r"\w|&", words[n].text)] or inside
    return range(said[0], said[-1] + 1)


def marks_of(words: Sequence[MarkedWord]) -> Iterator[tuple[int, int]]:
    """Yield the first word of each mark, and the one after its last."""
    start = 0
    while start < len(words):
        end = start + 1
        if words[start].begins:
            while (
                end < len(words)
                and words[end].label == words[start].label
                and not words[end].begins
            ):
                end += 1
            yield start, end
        start = end


def plan_as_marked(
    text: str, words: Sequence[Word], marked: Sequence[MarkedWord]
) -> RoutePlan:
    """Return the plan that a text has by its marks, taken for certain."""
    marks = [
        Mark(
            words[start].start,
            words[end - 1].end,
            marked[start].label,
            marked[start].leg,
            1.0,
        )
        for start, end in marks_of(marked)
    ]
    return plan_of_marks(text, marks)


def _only_sides(words: Sequence[MarkedWord]) -> list[MarkedWord]:
    """Leave of a turn, a bend and a side the word that tells the side, if there is one."""
    out = list(words)
    for start, end in marks_of(words):
        kind, _, way = words[start].label.partition(":")
        side = way.split("_")[-1]
        if kind in {"turn", "bend", "side"} and side in SIDES:
            told = [n for n in range(start, end) if words[n].text.lower() == side]
            if told:
                out[start:end] = [MarkedWord(each.text) for each in words[start:end]]
                out[told[-1]] = replace(
                    words[told[-1]],
                    label=words[start].label,
                    begins=True,
                    leg=words[start].leg,
                )
    return out


def ways_of(words: Sequence[MarkedWord]) -> list[str]:
    """Return the turns and bends in their order."""
    labels = [each.label for each in words if each.begins]
    return [label.partition(":")[2] for label in labels if ends_leg(label)]
