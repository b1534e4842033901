"""Put a plan into words of a wanted length, in one speaker's voice.

Every step has its own stream of random numbers, so that a plan with an error reads as
the right one does, word for word, apart from the error.
"""

import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from memorymaze.language.plans import Arrival, Leg
from memorymaze.texts.corpus.statistics import word_count
from memorymaze.texts.writing.asides import (
    Aside,
    disturbed,
    floor_underfoot,
    leg_asides,
    opening_and_closing,
    small_talk,
)
from memorymaze.texts.writing.clauses import (
    Focus,
    Size,
    arrival_clause,
    goal_words,
    is_command,
    merged_clause,
    one_of,
    skipped_clause,
    spoken_as,
    turn_clause,
)
from memorymaze.texts.writing.marked_text import (
    Marked,
    capitalised,
    mark,
    unmarked,
    without_marks,
)
from memorymaze.texts.writing.phrases import phrases
from memorymaze.texts.writing.steps import Mistake, Step, StepPlan
from memorymaze.texts.writing.voices import Voice

MERGED_WITHIN = 8.0
"""Metres between two turns that can be told as one."""


def error_label(number: int) -> str:
    """Return the label of the n-th error of a text."""
    return f"error|{number}"


def focus_of(mistakes: Sequence[Mistake]) -> dict[str, dict[str, str]]:
    """Return which part of which step gets which label."""
    focus: dict[str, dict[str, str]] = {}
    for number, mistake in enumerate(mistakes):
        part = "step" if mistake.part == "gone" else mistake.part
        focus.setdefault(mistake.key, {})[part] = error_label(number)
    return focus


def keys_in_order(
    plan: StepPlan, right: StepPlan, mistakes: Sequence[Mistake]
) -> list[str]:
    """Return the turns of a plan, right or wrong, and those that only the other has."""
    keys = [turn.key for turn in plan.turns]
    whole = [turn.key for turn in right.turns]
    for mistake in mistakes:
        wrong = [turn.key for turn in mistake.plan.turns]
        other = whole if mistake.part == "gone" else wrong
        if mistake.key in keys or mistake.key not in other:
            continue
        earlier = [key for key in other[: other.index(mistake.key)] if key in keys]
        keys.insert(keys.index(earlier[-1]) + 1 if earlier else 0, mistake.key)
    return keys


START, ARRIVAL, END = "start", "arrival", "end"
FITS_WITHIN: Mapping[Size, float] = {"wordy": 0.6, "plain": 0.9}
"""Share of the wanted words that the turns alone may take."""
SLACK = 2
"""Words that a text may be longer than wanted."""
RUN_TOGETHER = {True: 0.4, False: 0.15}
"""Share of sentences joined to the one before, in speech and in typing."""
LONGEST_FIRST = 12
"""Words of a sentence that another one is joined to."""


@dataclass(frozen=True, slots=True)
class Told:
    """A plan in words."""

    text: str
    marks: tuple[Marked, ...]


class Teller:
    """One description by one speaker: the right plan, and the same with errors."""

    def __init__(self, plan: StepPlan, voice: Voice, seed: int, words: float) -> None:
        """Choose how much is said at each turn of the right plan, and what besides."""
        self._plan = plan
        self._voice = voice
        self._seed = seed
        self._numbers = {turn.key: n for n, turn in enumerate(plan.turns)}
        self._offset = int(self._rng("offset").integers(60))
        self._asides: Sequence[Aside] = ()
        self._size: Size = self._fitting_size(words)
        self._asides = self._fitting_asides(words)

    def tell(self, plan: StepPlan, mistakes: Sequence[Mistake] = ()) -> Told:
        """Put the right plan, or that of the last mistake, into words.

        The words of the errors are labelled in either; where words are missing, the
        label has no width.
        """
        focus = focus_of(mistakes)
        items: list[str] = []
        before = self._around(START)
        if before:
            items.append(" ".join(before))
        pending = ""
        label = focus.get(START, {}).get("step")
        if plan.around:
            told = one_of(phrases("around"), self._rng(START, "around"))
            told = spoken_as(told, self._voice)
            items.append(as_sentence(mark(label, told) if label else told))
        elif label:
            pending = mark(label, "")
        for key in [*keys_in_order(plan, self._plan, mistakes), ARRIVAL]:
            words = self._item(plan, key, focus)
            if without_marks(words):
                items.append(pending + words)
                pending = ""
            else:
                pending += words
        after = self._around(END)
        if after:
            items[-1] = " ".join([items[-1], *after])
        text, marks = unmarked(laid_out(items, self._voice) + pending)
        return Told(text, tuple(marks))

    def _item(self, plan: StepPlan, key: str, focus: Mapping[str, Focus]) -> str:
        """Return all that is said at one step, or only labels."""
        part = focus.get(key, {})
        turn = next((each for each in plan.turns if each.key == key), None)
        asides = [each for each in self._asides if each.key == key]
        if key == ARRIVAL:
            core = arrival_clause(
                plan.ending.arrival,
                self._core_size(key),
                self._voice,
                self._rng(key),
                plan.things,
                by=plan.ending.claimed is not None,
            )
            if plan.ending.claimed is not None:
                asides = []
        elif turn is None:
            return mark(part["step"], "") if "step" in part else ""
        elif self._is_merged(plan, key, focus):
            return ""
        else:
            core = self._turn_core(turn, part)
            following = plan.turns[plan.turns.index(turn) + 1 :][:1]
            for each in following:
                if self._is_merged(plan, each.key, focus):
                    own = focus.get(each.key, {})
                    core += f" {merged_clause(each.leg, self._rng(each.key), own)}"
        if not without_marks(core):
            return core
        told = [(0.0, self._linked(core, key))]
        told += [(each.order, self._as_told(each)) for each in asides]
        told.sort(key=lambda each: each[0])
        texts = [text for _, text in told]
        if part:
            # What is joined hangs on the words, which differ in the right counterpart.
            said = " ".join(map(as_sentence, texts))
        else:
            said = run_together(texts, self._voice, self._rng(key, "joined"))
        return mark(part["step"], said) if "step" in part else said

    def _turn_core(self, turn: Step, part: Focus) -> str:
        if not turn.told:
            return skipped_clause(turn.leg, self._rng(turn.key))
        size = self._core_size(turn.key)
        rng = self._rng(turn.key)
        number = self._offset + self._numbers.get(turn.key, len(self._numbers))
        return turn_clause(
            turn.leg, size, self._voice, rng, part, number, self._plan.things
        )

    def _linked(self, core: str, key: str) -> str:
        rng = self._rng(key, "link")
        plain = without_marks(core)
        first = key == next((turn.key for turn in self._plan.turns), ARRIVAL)
        fits = not first and self._size != "terse" and self._voice.layout == "prose"
        if fits and is_command(plain) and rng.random() < 0.35:
            core = f"{one_of(phrases('links'), rng)} {core}"
        return disturbed(core, self._voice, rng, turn=True)

    def _is_merged(self, plan: StepPlan, key: str, focus: Mapping[str, Focus]) -> bool:
        """Tell whether a turn is told in one breath with the one before it.

        They follow each other in both plans within a few metres, and none of the two
        needs words of its own for where it is or for an error.
        """
        right = self._plan.turns
        keys, whole = ([each.key for each in turns] for turns in (plan.turns, right))
        number, place = (all.index(key) if key in all else 0 for all in (keys, whole))
        if not number or not place or keys[number - 1] != whole[place - 1]:
            return False
        before, turn = plan.turns[number - 1], plan.turns[number]
        labelled = {*focus.get(key, {}), *focus.get(before.key, {})}
        near = right[place].stretch.length < MERGED_WITHIN
        plain = turn.cue.kind != "thing" and turn.cue.ordinal == 1
        if labelled & {"cue", "step"} or not (near and plain):
            return False
        # Of three turns in a row the third begins anew.
        told = turn.told and before.told
        if not told or self._is_merged(plan, before.key, focus):
            return False
        chance = self._rng(key, "merged").random()
        return bool(chance < self._voice.surface.merged_turns)

    def _core_size(self, key: str) -> Size:
        if self._size != "wordy":
            return self._size
        return "wordy" if self._rng(key, "size").random() < 0.45 else "plain"

    def _fitting_size(self, words: float) -> Size:
        for size, share in FITS_WITHIN.items():
            self._size = size
            if word_count(self.tell(self._plan).text) <= share * words:
                return size
        return "terse"

    def _fitting_asides(self, words: float) -> Sequence[Aside]:
        room = words - word_count(self.tell(self._plan).text)
        rng, spoken = self._rng("choice"), self._voice.spoken
        chosen: list[Aside] = []
        goal = goal_words(self._plan.ending.goal)
        keys = [turn.key for turn in self._plan.turns if turn.told]
        chatter = opening_and_closing(self._voice, goal, START, END, rng)
        talk = small_talk(self._voice, [*keys, ARRIVAL, END], rng)
        early = [each for each in chatter if rng.random() < (0.4 if spoken else 0.15)]
        some = int(rng.integers(4)) if spoken else 0
        first = [*self._leg_asides(rng), *talk[:some]]
        for pool in (early, first, chatter, talk[some:]):
            for number in rng.permutation(len(pool)):
                aside = pool[number]
                length = word_count(without_marks(self._as_told(aside)))
                if aside not in chosen and length <= room + SLACK and room > SLACK:
                    room -= length
                    chosen.append(aside)
        return chosen

    def _as_told(self, aside: Aside) -> str:
        rng = self._rng(aside.key, aside.text)
        return disturbed(aside.text, self._voice, rng, sure=aside.sure)

    def _leg_asides(self, rng: np.random.Generator) -> list[Aside]:
        found: list[Aside] = []
        things = self._plan.things
        known = {turn.cue.words for turn in self._plan.turns}
        before: Leg | None = None
        for turn in self._plan.turns:
            leg, before = _on_new_floor(turn.leg, before), turn.leg
            if turn.told and not self._is_merged(self._plan, turn.key, {}):
                own = self._rng(turn.key, "asides")
                side = turn.side.rpartition("_")[2]
                found += leg_asides(
                    leg, turn.key, side, self._voice, own, things, known
                )
        own = self._rng(ARRIVAL, "asides")
        last = _on_new_floor(self._plan.ending.arrival, before)
        found += leg_asides(last, ARRIVAL, None, self._voice, own, things, known)
        # Some of what could be said is left to chatter, more of it in speech.
        kept = rng.random(len(found)) < (0.8 if self._voice.spoken else 0.95)
        return [each for each, keep in zip(found, kept, strict=True) if keep]

    def _around(self, key: str) -> list[str]:
        told = [each for each in self._asides if each.key == key]
        told.sort(key=lambda each: each.order)
        return [as_sentence(self._as_told(each)) for each in told]

    def _rng(self, *purpose: str) -> np.random.Generator:
        key = zlib.crc32("|".join(purpose).encode())
        return np.random.default_rng([self._seed, key])


def _on_new_floor(part: Leg | Arrival, before: Leg | None) -> Leg | Arrival:
    """Return a stretch whose floor is only known where it changes."""
    if before is None or floor_underfoot(before) != floor_underfoot(part):
        return part
    others = tuple(each for each in part.mentions if each.kind != "floor")
    return replace(part, mentions=others)


# -- sentences, and how they stand on the page


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
        joined = fits and not plain.startswith(phrases("words", "not_joined"))
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
