"""Put a plan into words of a wanted length, in one speaker's voice.

Every step has its own stream of random numbers, so that a plan with an error reads as
the right one does, word for word, apart from the error.
"""

import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from memorymaze.instructions.generation.asides import Aside, leg_asides
from memorymaze.instructions.generation.chatter import (
    beginnings,
    disturbed,
    endings,
    small_talk,
)
from memorymaze.instructions.generation.clauses import (
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
from memorymaze.instructions.generation.marked_text import (
    Marked,
    capitalised,
    mark,
    read_marks,
    without_marks,
)
from memorymaze.instructions.generation.mistakes import Mistake
from memorymaze.instructions.generation.steps import Leg, StepPlan, Turn
from memorymaze.instructions.generation.voices import Voice
from memorymaze.instructions.statistics import word_count

__all__ = ["Teller", "Told", "error_label"]

START, ARRIVAL = "start", "arrival"
MERGED_WITHIN = 8.0
"""Metres between two turns that can be told as one."""
SLACK = 2
"""Words that a text may be longer than wanted."""
AROUND = (
    "first turn around and go back the other way",
    "you have to go back the way behind you first",
    "turn around and walk in the opposite direction",
)
LINKS = ("then", "after that", "next", "from there", "and then", "now")
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


def error_label(number: int) -> str:
    """Return the label of the n-th error of a text."""
    return f"error|{number}"


class Teller:
    """One description by one speaker: the right plan, and the same with errors.

    Attributes:
        size: How much is said at each turn.
        asides: What is said besides, chosen for the right plan.
    """

    def __init__(self, plan: StepPlan, voice: Voice, seed: int, words: float) -> None:
        """Choose what is said.

        Args:
            plan: The right plan.
            voice: Who speaks.
            seed: Of the words.
            words: How long the text should be.
        """
        self._plan = plan
        self._voice = voice
        self._seed = seed
        self._numbers = {turn.key: n for n, turn in enumerate(plan.turns)}
        self._offset = int(self._rng("offset").integers(60))
        self.size: Size = self._fitting_size(words)
        self.asides: tuple[Aside, ...] = ()
        self.asides = tuple(self._fitting_asides(words))

    def tell(self, plan: StepPlan, mistakes: Sequence[Mistake] = ()) -> Told:
        """Put the right plan, or one with errors, into words.

        Args:
            plan: The right plan, or `mistakes[-1].plan`.
            mistakes: The errors, whose words are labelled in either; where words are
                missing, the label has no width.
        """
        focus = self._focus(mistakes)
        order = self._order(plan, mistakes)
        items: list[str] = []
        pending = ""
        if plan.around:
            label = focus.get(START, {}).get("step")
            told = one_of(AROUND, self._rng(START, "around"))
            told = spoken_as(told, self._voice)
            items.append(self._sentence(mark(label, told) if label else told))
        elif label := focus.get(START, {}).get("step"):
            pending = mark(label, "")
        before = self._around(START)
        if before:
            items.append(" ".join(before))
        for key in order:
            words = self._item(plan, key, focus, first=not items)
            if not without_marks(words):
                pending += words
                continue
            if self._is_merged(plan, key, focus):
                items[-1] = items[-1].rstrip(".") + f" {words}."
                continue
            items.append(pending + words)
            pending = ""
        after = self._around("end")
        if after:
            items[-1] = " ".join([items[-1], *after])
        marked = self._laid_out(items)
        text, marks = read_marks(marked + pending)
        return Told(text, tuple(marks))

    def _order(self, plan: StepPlan, mistakes: Sequence[Mistake]) -> list[str]:
        """Return the steps of a plan with those that are only in its counterpart."""
        keys = [turn.key for turn in plan.turns]
        for mistake in mistakes:
            wrong = [turn.key for turn in mistake.plan.turns]
            whole = [turn.key for turn in self._plan.turns]
            if mistake.part == "gone" and mistake.key not in keys:
                earlier = [k for k in whole[: whole.index(mistake.key)] if k in keys]
                place = keys.index(earlier[-1]) + 1 if earlier else 0
                keys.insert(place, mistake.key)
            elif mistake.key in wrong and mistake.key not in keys:
                earlier = [k for k in wrong[: wrong.index(mistake.key)] if k in keys]
                place = keys.index(earlier[-1]) + 1 if earlier else 0
                keys.insert(place, mistake.key)
        return [*keys, ARRIVAL]

    def _focus(self, mistakes: Sequence[Mistake]) -> dict[str, dict[str, str]]:
        focus: dict[str, dict[str, str]] = {}
        for number, mistake in enumerate(mistakes):
            part = "step" if mistake.part == "gone" else mistake.part
            focus.setdefault(mistake.key, {})[part] = error_label(number)
        return focus

    def _item(
        self, plan: StepPlan, key: str, focus: Mapping[str, Focus], *, first: bool
    ) -> str:
        """Return all that is said at one step, or only labels."""
        part = focus.get(key, {})
        turn = next((each for each in plan.turns if each.key == key), None)
        if key == ARRIVAL:
            core = arrival_clause(
                plan.arrival, self._core_size(key), self._voice, self._rng(key), part
            )
            said = plan.arrival.claimed is None
            asides = [each for each in self.asides if each.key == key and said]
        elif turn is None:
            return mark(part["step"], "") if "step" in part else ""
        elif self._is_merged(plan, key, focus):
            return merged_clause(turn, self._rng(key), part)
        else:
            core = self._turn_core(turn, part)
            asides = [each for each in self.asides if each.key == key]
        if not without_marks(core):
            return core
        core = self._linked(core, key, first=first)
        told = [(0.0, core)]
        told += [(each.order, self._as_told(each)) for each in asides]
        told.sort(key=lambda each: each[0])
        return self._joined([text for _, text in told], self._rng(key, "joined"))

    def _joined(self, texts: Sequence[str], rng: np.random.Generator) -> str:
        """Return texts as sentences, some of them run together."""
        share = 0.4 if self._voice.spoken else 0.15
        sentences = [texts[0]]
        for text, chance in zip(texts[1:], rng.random(len(texts) - 1), strict=True):
            before, plain = without_marks(sentences[-1]), without_marks(text)
            fits = len(before.split()) < 12 and not before.endswith(("?", "."))
            if chance < share and fits and not plain.startswith(NOT_JOINED):
                link = (
                    "and then"
                    if is_command(plain) and not is_command(before)
                    else "and"
                )
                sentences[-1] += f", {link} {text}"
            else:
                sentences.append(text)
        return " ".join(self._sentence(each) for each in sentences)

    def _turn_core(self, turn: Turn, part: Focus) -> str:
        if not turn.told:
            return skipped_clause(turn, self._rng(turn.key))
        size = self._core_size(turn.key)
        rng = self._rng(turn.key)
        number = self._offset + self._numbers.get(turn.key, len(self._numbers))
        return turn_clause(turn, size, self._voice, rng, part, number)

    def _linked(self, core: str, key: str, *, first: bool) -> str:
        rng = self._rng(key, "link")
        plain = without_marks(core)
        fits = not first and self.size != "terse" and self._voice.layout == "prose"
        if fits and is_command(plain) and rng.random() < 0.35:
            core = f"{one_of(LINKS, rng)} {core}"
        return disturbed(core, self._voice, rng, turn=True)

    def _is_merged(self, plan: StepPlan, key: str, focus: Mapping[str, Focus]) -> bool:
        """Tell whether a turn is told in one breath with the one before it."""
        keys = [turn.key for turn in plan.turns]
        right = [turn.key for turn in self._plan.turns]
        if key not in keys or key not in right or keys.index(key) == 0:
            return False
        place = right.index(key)
        before, turn = plan.turns[keys.index(key) - 1], plan.turns[keys.index(key)]
        if (
            place == 0
            or right[place - 1] != before.key
            or {"cue", "step"}
            & {
                *focus.get(key, {}),
                *focus.get(before.key, {}),
            }
        ):
            return False
        own = self._plan.turns[place]
        near = own.leg.length < MERGED_WITHIN and own.told and before.told
        simple = turn.cue.kind != "thing" and turn.cue.ordinal == 1
        # Of three turns in a row the third begins anew.
        if not (near and simple) or self._is_merged(plan, before.key, focus):
            return False
        chance = self._rng(key, "merged").random()
        return bool(chance < self._voice.surface.merged_turns)

    def _core_size(self, key: str) -> Size:
        if self.size != "wordy":
            return self.size
        return "wordy" if self._rng(key, "size").random() < 0.45 else "plain"

    def _fitting_size(self, words: float) -> Size:
        self.asides = ()
        for size in ("wordy", "plain", "terse"):
            self.size = size
            length = word_count(self.tell(self._plan).text)
            if size == "terse" or length <= {"wordy": 0.6, "plain": 0.9}[size] * words:
                return size
        return "terse"

    def _fitting_asides(self, words: float) -> Sequence[Aside]:
        room = words - word_count(self.tell(self._plan).text)
        rng, spoken = self._rng("choice"), self._voice.spoken
        chosen: list[Aside] = []
        chatter, talk = self._chatter(rng), self._talk(rng)
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
        known = {turn.cue.words for turn in self._plan.turns}
        before = None
        for turn in self._plan.turns:
            leg, before = _on_new_floor(turn.leg, before), turn.leg
            if turn.told and not self._is_merged(self._plan, turn.key, {}):
                own = self._rng(turn.key, "asides")
                side = turn.side.rpartition("_")[2]
                found += leg_asides(leg, turn.key, side, self._voice, own, known)
        own = self._rng(ARRIVAL, "asides")
        last = _on_new_floor(self._plan.arrival.leg, before)
        found += leg_asides(last, ARRIVAL, None, self._voice, own, known)
        # Some of what could be said is left to chatter, more of it in speech.
        kept = rng.random(len(found)) < (0.8 if self._voice.spoken else 0.95)
        return [each for each, keep in zip(found, kept, strict=True) if keep]

    def _chatter(self, rng: np.random.Generator) -> list[Aside]:
        goal = goal_words(self._plan.arrival.goal)
        opening = one_of(beginnings(self._voice, goal), rng)
        closing = one_of(endings(self._voice), rng)
        told = [Aside(START, 0, opening), Aside("end", 0, closing)]
        return [
            Aside(each.key, 0, spoken_as(each.text, self._voice), sure=True)
            for each in told
        ]

    def _talk(self, rng: np.random.Generator) -> list[Aside]:
        keys = [turn.key for turn in self._plan.turns if turn.told] + [ARRIVAL, "end"]
        pool = small_talk(self._voice)
        return [
            Aside(
                str(rng.choice(keys)),
                float(rng.uniform(-60, -5)),
                spoken_as(str(pool[number]), self._voice),
                sure=True,
            )
            for number in rng.permutation(len(pool))
        ]

    def _around(self, key: str) -> list[str]:
        told = sorted(
            (each for each in self.asides if each.key == key), key=lambda a: a.order
        )
        return [self._sentence(self._as_told(each)) for each in told]

    def _sentence(self, text: str) -> str:
        ended = without_marks(text).endswith((".", "?", "!"))
        return capitalised(text) + ("" if ended else ".")

    def _laid_out(self, items: Sequence[str]) -> str:
        if self._voice.layout == "prose":
            return " ".join(items)
        if self._voice.layout == "lines":
            return "\n".join(items)
        marker = self._voice.marker
        return "\n".join(
            f"{marker.format(n=number)} {item}" for number, item in enumerate(items, 1)
        )

    def _rng(self, *purpose: str) -> np.random.Generator:
        key = zlib.crc32("|".join(purpose).encode())
        return np.random.default_rng([self._seed, key])


def _on_new_floor(leg: Leg, before: Leg | None) -> Leg:
    """Return a stretch whose floor is only known where it changes."""
    same = before is not None and before.floor == leg.floor
    return replace(leg, floor=None) if same else leg
