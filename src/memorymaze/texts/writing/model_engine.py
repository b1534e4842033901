"""Have a language model write a outline; check what it wrote as far as a program can.

The model gets the typed steps of the right and the wrong plan, and marks in its reply
every word that tells to turn and every word of an error. The marks are checked.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import islice

from memorymaze.basics.errors import LanguageModelError
from memorymaze.language.models.model import CompletionRequest, LanguageModel, Message
from memorymaze.language.models.prompt_texts import load_prompt
from memorymaze.language.plans import Arrival, Leg
from memorymaze.texts.corpus.error_kinds import meaning_of
from memorymaze.texts.corpus.files import load_instructions
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.corpus.statistics import word_count
from memorymaze.texts.writing.clauses import thing_at_the_turn
from memorymaze.texts.writing.grammar import told_instruction
from memorymaze.texts.writing.marked_text import Marked
from memorymaze.texts.writing.phrases import phrases
from memorymaze.texts.writing.sampling import Outline
from memorymaze.texts.writing.steps import Mistake, Step, StepPlan
from memorymaze.texts.writing.telling import Told, error_label
from memorymaze.texts.writing.things import Thing, thing_called, with_article
from memorymaze.texts.writing.told_sides import commands

THINGS = 4
"""Things named per stretch."""


def listed_steps(plan: StepPlan) -> str:
    """Return the steps of a plan, one per line."""
    lines: list[str] = []
    if plan.around:
        lines.append("first turn around and go back the other way")
    for turn in plan.turns:
        lines.append(_turn(turn, plan.things))
    ending = plan.ending
    where = "straight ahead" if ending.side is None else f"on the {ending.side}"
    at = "" if ending.claimed is None else f", at {ending.claimed}"
    way = _stretch(ending.arrival, plan.things)
    lines.append(f"{way}; {ending.goal} is {where}{at}")
    return "\n".join(f"{number}. {line}" for number, line in enumerate(lines, 1))


def listed_errors(mistakes: Sequence[Mistake]) -> str:
    """Return the errors to put in, one per line."""
    if not mistakes:
        return "none: write only the right text"
    return "\n".join(
        f"{number}. {mistake.kind} ({meaning_of(mistake.kind)}): {mistake.detail}"
        for number, mistake in enumerate(mistakes, 1)
    )


def _turn(step: Step, things: Mapping[str, Thing]) -> str:
    side = step.side.replace("_", " ")
    way = _stretch(step.leg, things)
    if not step.told:
        return f"{way}; the way bends {side} by itself: do not tell this turn"
    return f"{way}; turn {side} {_where(step.leg, things)}"


def _where(leg: Leg, things: Mapping[str, Thing]) -> str:
    thing = thing_at_the_turn(leg)
    if thing is not None:
        return f"at {with_article(thing_called(thing, things), definite=True)}"
    if leg.turn.ordinal is not None:
        return f"at the {phrases('ordinals')[leg.turn.ordinal - 1]} way on that side"
    if leg.turn.at_end:
        return "where the way ahead ends"
    return "at the corner, which leaves no other way"


def _stretch(part: Leg | Arrival, things: Mapping[str, Thing]) -> str:
    if part.length is None:
        return "go on"
    passed = [each for each in part.mentions if each.place == "passed"]
    told = [
        f"{with_article(thing_called(each.phrase, things), definite=False)} ({each.side})"
        for each in passed[:THINGS]
    ]
    past = f", past {', '.join(told)}" if told else ""
    return f"go {part.length.metres:.0f} m{past}"


ATTEMPTS = 3
EXAMPLES = 2
TAG = re.compile(r"<(/?)(turn|error)(?: n=\"?(\d+)\"?)?(/?)>")
TEXT = re.compile(r"<(wrong|right)>(.*?)</\1>", re.DOTALL)
LENGTHS = (0.4, 2.5)
"""Least and greatest factor between the wanted and the written number of words."""


def written_by_model(
    outline: Outline, model: LanguageModel, *, paired: bool
) -> list[Instruction]:
    """Have a model write a outline; return its text, and with `paired` the right one too.

    Raises:
        LanguageModelError: No reply came, or none kept to the plan after three
            attempts; says what was wrong with the last one.
    """
    system = load_prompt("tell_route", examples=_examples(outline))
    asked = load_prompt(
        "tell_route_task",
        study="typed by somebody who watches a video of the way"
        if outline.cell.study == "online"
        else "spoken from memory by a passer-by, written down word for word",
        words=str(round(outline.words)),
        right=listed_steps(outline.plan),
        wrong=listed_steps(outline.told_plan),
        errors=listed_errors(outline.mistakes),
    )
    messages = [Message("system", system), Message("user", asked)]
    complaint = ""
    for attempt in range(ATTEMPTS):
        seed = (outline.seed + attempt) % 2**31
        reply = model.complete(
            CompletionRequest(tuple(messages), temperature=0.8, seed=seed)
        ).text
        try:
            return _read(reply, outline, paired=paired)
        except ValueError as error:
            complaint = str(error)
            messages += [
                Message("assistant", reply),
                Message("user", f"Not yet: {complaint}. Write both texts again."),
            ]
    raise LanguageModelError(
        f"{model.name}: after {ATTEMPTS} attempts its text does not keep to the plan "
        f"({complaint})"
    )


def _examples(outline: Outline) -> str:
    """Return texts that prompts may be built from, as examples of the tone."""
    known = [each for each in load_instructions() if each.split == "dev"]
    own = [each for each in known if each.study == outline.cell.study] or known
    other = (each for each in own if each.route != outline.cell.route)
    return "\n\n".join(each.text for each in islice(other, EXAMPLES))


def _read(reply: str, outline: Outline, *, paired: bool) -> list[Instruction]:
    """Return the records of a reply."""
    texts = {kind: text.strip() for kind, text in TEXT.findall(reply)}
    if not outline.mistakes:
        texts.setdefault("wrong", texts.get("right", ""))
        texts.setdefault("right", texts["wrong"])
    for kind in ("right", "wrong"):
        if not texts.get(kind):
            raise ValueError(
                f"expected a text between <{kind}> and </{kind}>, got none"
            )
    right = _told(texts["right"], outline, outline.plan)
    wrong = _told(texts["wrong"], outline, outline.told_plan)
    if outline.mistakes and _apart_from_errors(right) != _apart_from_errors(wrong):
        raise ValueError(
            "expected both texts to be the same, word for word, outside <error> marks"
        )
    pair = outline.id if paired and outline.mistakes else None
    written = [told_instruction(outline, wrong, pair=pair)]
    if pair is not None:
        written.append(told_instruction(outline, right, pair=pair, right=True))
    return [replace(each, source="llm") for each in written]


def _told(marked: str, outline: Outline, plan: StepPlan) -> Told:
    """Take the marks out of a text and check them against a plan."""
    text, sides, errors = _without_tags(marked)
    numbers = [number for number, _, _ in errors]
    if sorted(numbers) != list(range(1, len(outline.mistakes) + 1)):
        raise ValueError(
            f"expected errors 1 to {len(outline.mistakes)} marked once each, got {numbers}"
        )
    expected = [turn.side.rpartition("_")[2] for turn in plan.turns if turn.told]
    said = [text[start:end].lower() for start, end in sides]
    if said != expected:
        raise ValueError(
            f"expected the turns {', '.join(expected) or 'none'}, in this order and each "
            f"in <turn> marks, got {', '.join(said) or 'none'}"
        )
    starts = {start for start, _ in sides}
    unmarked = [each for each in commands(text) if each.start not in starts]
    if unmarked:
        raise ValueError(
            f"expected no other turns, got {text[unmarked[0].start - 12 :][:24]!r}"
        )
    words = word_count(text)
    if not LENGTHS[0] * outline.words <= words <= LENGTHS[1] * outline.words:
        raise ValueError(f"expected about {outline.words:.0f} words, got {words}")
    goal = plan.ending.goal.split(" in ")[0].split()[-1]
    if goal.lower() not in text.lower():
        raise ValueError(f"expected a word of the destination ({plan.ending.goal})")
    marks = [Marked(error_label(n - 1), start, end) for n, start, end in errors]
    return Told(text, tuple(sorted(marks, key=lambda each: each.start)))


def _without_tags(
    marked: str,
) -> tuple[str, list[tuple[int, int]], list[tuple[int, int, int]]]:
    """Return the text, the places of turns, and number and place of errors."""
    text, last = "", 0
    turns: list[tuple[int, int]] = []
    errors: list[tuple[int, int, int]] = []
    begun: list[tuple[str, int, int]] = []
    for tag in TAG.finditer(marked):
        text += marked[last : tag.start()]
        last = tag.end()
        closing, name, number, alone = tag.groups()
        if not closing:
            begun.append((name, int(number or 1), len(text)))
        if closing or alone:
            if not begun or begun[-1][0] != name:
                raise ValueError(f"expected marks that close in order, got {tag[0]}")
            _, n, start = begun.pop()
            if name == "turn":
                turns.append((start, len(text)))
            else:
                errors.append((n, start, len(text)))
    if begun:
        raise ValueError(f"expected the mark <{begun[-1][0]}> to be closed")
    return text + marked[last:], sorted(turns), errors


def _apart_from_errors(told: Told) -> Sequence[str]:
    """Return the words of a text outside its errors."""
    kept, last = "", 0
    for each in told.marks:
        kept += told.text[last : each.start] + " "
        last = each.end
    return re.findall(r"[\w']+", (kept + told.text[last:]).lower())
