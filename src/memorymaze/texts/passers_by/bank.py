"""The bank: what passers-by say when a guide robot asks them, by who they are.

A language model wrote the answers in role, and the phrases for their slots (`data/`).
What is true, and what of it somebody remembers, is decided elsewhere.
"""

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import TypeVar, get_args

import numpy as np

from memorymaze.basics.errors import SettingsError
from memorymaze.robot.api.asking import QuestionKind
from memorymaze.texts.passers_by.bank_file import read_answers, read_words
from memorymaze.texts.passers_by.bank_records import (
    ALWAYS_GIVEN,
    MANY_TURNS,
    OPPOSITES,
    REPLY_CASES,
    SLOT,
    WAY_CASES,
    BankAnswer,
    CueWords,
    StartSide,
    TurnFact,
    WayFacts,
)
from memorymaze.texts.passers_by.spoken_numbers import (
    LENGTH_UNITS,
    ordinal_word,
    spoken_number,
)

DATA_FOLDER = Path(__file__).parent / "data"
_SENTENCE_START = re.compile(r"(^|[.!?]\s+)$")
_Record = TypeVar("_Record")


class Bank:
    """Answers and phrases, checked; the same generator gives the same words."""

    def __init__(
        self, answers: Iterable[BankAnswer], words: Iterable[CueWords]
    ) -> None:
        """Hold what `load_bank` has read and checked."""
        self.answers = tuple(answers)
        self.words = tuple(words)
        self.manners = tuple(sorted({answer.manner for answer in self.answers}))
        self._answers: dict[tuple[str, str], list[BankAnswer]] = defaultdict(list)
        for answer in self.answers:
            self._answers[answer.kind, answer.case].append(answer)
        self._words: dict[str, list[CueWords]] = defaultdict(list)
        for phrase in self.words:
            self._words[phrase.slot].append(phrase)

    def way(
        self, facts: WayFacts, rng: np.random.Generator, manner: str | None = None
    ) -> str:
        """Say a way, in one manner where it is given."""
        case = WAY_CASES[min(len(facts.turns), MANY_TURNS)]
        answer = _choose(self._in_manner("way_to", case, manner), rng)
        told = answer.turns_told
        phrases = _Phrases(self._words, answer.manner, rng)

        def say(name: str, number: str) -> str:
            if number:
                return phrases.of_turn(name, facts.turns[int(number) - 1])
            match name:
                case "start" | "set_off":
                    return phrases.choose(name, facts.start)
                case "where":
                    return phrases.choose(name, facts.end)
                case "metres":
                    return phrases.length(facts.metres)
                case "total":
                    before = sum(turn.metres for turn in facts.turns)
                    return phrases.length(before + facts.metres)
                case "rest":
                    rest = (phrases.of_turn(name, turn) for turn in facts.turns[told:])
                    return ", ".join(rest)
                case _:
                    return facts.destination

        return _sentences(answer.text, say)

    def reply(
        self,
        kind: QuestionKind,
        case: str,
        slots: Mapping[str, str],
        rng: np.random.Generator,
        manner: str | None = None,
    ) -> str:
        """Say an answer of a case, in one manner where it is given.

        `metres` is a number in digits, `where` one of `StartSide`; both are put into words.
        Of `metres`, `near` and `where` those may be missing that nobody is to speak of.
        """
        if (kind, case) not in REPLY_CASES:
            known = ", ".join(map(" ".join, REPLY_CASES))
            raise SettingsError(f"expected a case of {known}, got {kind} {case}")
        allowed = REPLY_CASES[kind, case]
        needed = allowed & ALWAYS_GIVEN
        if not needed <= slots.keys() <= allowed:
            raise SettingsError(
                f"{kind} {case}: expected the slots {sorted(needed)}, perhaps "
                f"{sorted(allowed - needed)}, got {sorted(slots)}"
            )
        if slots.get("where", "ahead") not in get_args(StartSide):
            raise SettingsError(
                f"{kind} {case}: expected where to be one of {get_args(StartSide)}, got "
                f"{slots['where']!r}"
            )
        fitting = self._in_manner(kind, case, manner)
        answer = _choose([a for a in fitting if a.slots <= slots.keys()], rng)
        phrases = _Phrases(self._words, answer.manner, rng)

        def say(name: str, _number: str) -> str:
            if name == "metres":
                return phrases.length(float(slots[name]))
            if name == "where":
                return phrases.choose("start", slots[name])
            return slots[name]

        return _sentences(answer.text, say)

    def _in_manner(self, kind: str, case: str, manner: str | None) -> list[BankAnswer]:
        if manner is not None and manner not in self.manners:
            raise SettingsError(
                f"expected a manner of {', '.join(self.manners)}, got {manner!r}"
            )
        answers = self._answers[kind, case]
        return [a for a in answers if manner is None or a.manner == manner]


class _Phrases:
    """The phrases that fit one voice."""

    def __init__(
        self,
        words: Mapping[str, list[CueWords]],
        manner: str,
        rng: np.random.Generator,
    ) -> None:
        self._words = words
        self._manner = manner
        self._rng = rng

    def choose(self, slot: str, case: str) -> str:
        """Return a phrase for a slot, its own slots not yet filled."""
        fitting = [word for word in self._fitting(slot) if word.case == case]
        return _choose(fitting, self._rng).text

    def length(self, metres: float) -> str:
        """Return how somebody speaks of a length."""
        fitting = [w for w in self._fitting("length") if w.least <= metres < w.most]
        chosen = _choose(fitting, self._rng)
        if chosen.case == "unmeasured":
            return chosen.text
        number = spoken_number(metres * LENGTH_UNITS[chosen.case])
        return _fill(chosen.text, lambda _name, _number: number)

    def of_turn(self, name: str, turn: TurnFact) -> str:
        """Return what a slot of a turn is filled with."""
        match name:
            case "side" | "bend":
                return self.choose(name, turn.side)
            case "wrong":
                return self.choose("side", OPPOSITES[turn.side])
            case "metres":
                return self.length(turn.metres)
            case "ordinal":
                return ordinal_word(turn.ordinal)
            case "thing":
                return turn.thing
            case _:
                text = self.choose(name, "turn" if name == "rest" else turn.cue)
                return _fill(text, lambda inner, _number: self.of_turn(inner, turn))

    def _fitting(self, slot: str) -> list[CueWords]:
        words = self._words[slot]
        return [w for w in words if not w.manners or self._manner in w.manners]


@cache
def load_bank(folder: Path = DATA_FOLDER) -> Bank:
    """Return the bank of a folder; `AnswerFileError` says which line is wrong."""
    answers = read_answers(folder / "answers.jsonl")
    manners = frozenset(answer.manner for answer in answers)
    return Bank(answers, read_words(folder / "words.jsonl", manners))


def _fill(text: str, say: Callable[[str, str], str]) -> str:
    """Fill each slot with what `say` returns for its name and its number."""
    return SLOT.sub(lambda slot: say(slot[1], slot[2]), text)


def _sentences(text: str, say: Callable[[str, str], str]) -> str:
    """Fill the slots of a whole answer; one that opens a sentence has a capital."""

    def say_in_place(slot: re.Match[str]) -> str:
        words = say(slot[1], slot[2])
        if _SENTENCE_START.search(slot.string[: slot.start()]):
            return words[:1].upper() + words[1:]
        return words

    return SLOT.sub(say_in_place, text)


def _choose(among: Sequence[_Record], rng: np.random.Generator) -> _Record:
    return among[int(rng.integers(len(among)))]
