"""Labelling in the terminal, one question after the other."""

import textwrap
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeVar

from memorymaze.collection.labels import KINDS, NO_WAY, Label, append_labels
from memorymaze.collection.questions import (
    Question,
    draw_ways,
    read_kind,
    read_way,
    read_yes_or_no,
    way_in_words,
)
from memorymaze.instructions.records import WRITTEN_BY, Failure

Ask = Callable[[str], str]
Say = Callable[[str], None]
Answer = TypeVar("Answer")

WIDTH = 88
HELP = "s: leave this one for later · b: the one before again · q: stop; all is kept"


class _Later(Exception):
    """The annotator leaves this instruction for later."""


class _Back(Exception):
    """The annotator wants the instruction before again."""


class _Stop(Exception):
    """The annotator breaks off."""


def ask_for_labels(
    questions: Sequence[Question],
    annotator: str,
    out: str | Path,
    *,
    ask: Ask,
    say: Say,
    pictures: str | Path | None = None,
) -> int:
    """Ask an annotator about instructions; each answer is kept as soon as it is whole.

    Breaking off (`q`, the end of the input, or an interrupt) loses nothing but the
    instruction at hand. `b` goes back to the one before, whose new label replaces the
    old one.

    Plans with the ways drawn in go into the folder for pictures; None draws none.
    """
    added = 0
    at = 0
    say(HELP)
    try:
        while at < len(questions):
            _show(questions[at], at, len(questions), pictures, say)
            try:
                label = _answer(questions[at], annotator, ask, say)
            except _Later:
                at += 1
            except _Back:
                at = max(0, at - 1)
            else:
                append_labels(out, [label])
                added += 1
                at += 1
    except (_Stop, EOFError, KeyboardInterrupt):
        say("")
        say(f"stopped; {_kept(added, out)}. The same command goes on.")
    else:
        say(f"done; {_kept(added, out)}.")
    return added


def _kept(added: int, out: str | Path) -> str:
    return f"{added} {'label is' if added == 1 else 'labels are'} kept in {out}"


def _show(
    question: Question, at: int, total: int, pictures: str | Path | None, say: Say
) -> None:
    told = question.instruction
    say("")
    say(
        f"[{at + 1} of {total}] {told.id}: {question.site.title}, {told.route}, "
        f"{told.study}, iteration {told.iteration}; written by {WRITTEN_BY[told.source]}"
    )
    if pictures is not None:
        say(f"plan: {draw_ways(pictures, question.site, told.route)}")
    for number, way in enumerate(question.site.ways(told.route), start=1):
        line = f"{number} {way.id}: {way_in_words(question.site, way)}"
        say(textwrap.fill(line, WIDTH, initial_indent="  ", subsequent_indent="      "))
    say("")
    for line in told.text.splitlines():
        printable = "".join(c if c.isprintable() else "\ufffd" for c in line)
        say(
            textwrap.fill(printable, WIDTH, initial_indent="> ", subsequent_indent="> ")
        )
    say("")


def _answer(question: Question, annotator: str, ask: Ask, say: Say) -> Label:
    ways = question.ways
    numbers = "1" if len(ways) == 1 else f"1 to {len(ways)}"
    way = _ask(
        f"Which way does it describe? {numbers}, or 0 for none of them [1]: ",
        lambda answer: read_way(answer or "1", ways),
        ask,
        say,
    )
    arrives = _ask(
        "Would an attentive person who follows it arrive? yes or no: ",
        read_yes_or_no,
        ask,
        say,
    )
    failures: list[Failure] = []
    while not arrives:
        for number, (kind, meaning) in enumerate(KINDS.items()):
            say(f"  {number} {kind}: {meaning}")
        kind = _ask("What is wrong? ", read_kind, ask, say)
        if way != NO_WAY:
            turns = next(each for each in question.site.routes if each.id == way).turns
            say(f"  turning points: {', '.join(turn.at for turn in turns) or 'none'}")
        where = _ask("Where? a turning point's id, or a place: ", _words, ask, say)
        detail = _ask(
            "What does the text say, and what is right? ", str.strip, ask, say
        )
        failures.append(Failure(kind, where, detail))
        arrives = not _ask(
            "Is anything else wrong? yes or no [no]: ",
            lambda answer: read_yes_or_no(answer or "no"),
            ask,
            say,
        )
    return question.label(annotator, way, failures)


def _words(answer: str) -> str:
    if not answer.strip():
        raise ValueError("expected a place, got nothing")
    return answer.strip()


def _ask(prompt: str, read: Callable[[str], Answer], ask: Ask, say: Say) -> Answer:
    """Ask until the answer can be read."""
    while True:
        typed = ask(prompt).strip()
        match typed.casefold():
            case "q":
                raise _Stop
            case "s":
                raise _Later
            case "b":
                raise _Back
            case _:
                pass
        try:
            return read(typed)
        except ValueError as error:
            say(f"{error}. ({HELP})")
