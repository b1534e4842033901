"""Reading the bank's two files, with all that is checked of them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from pydantic import TypeAdapter, ValidationError

from memorymaze.errors import AnswerFileError, did_you_mean
from memorymaze.input_files import mistakes, read_lines
from memorymaze.passers_by.bank_records import (
    ALWAYS_GIVEN,
    CASES,
    MANY_TURNS,
    WORD_CASES,
    Answer,
    CueWords,
)

_Record = TypeVar("_Record")

_WAY_SLOTS = frozenset({
    "start",
    "set_off",
    "where",
    "metres",
    "total",
    "destination",
    "rest",
})
_TURN_SLOTS = ("side", "bend", "cue", "turn", "metres", "wrong")
_WORD_SLOTS: dict[tuple[str, str], frozenset[str]] = {
    ("cue", "ordinal"): frozenset({"ordinal"}),
    ("cue", "thing"): frozenset({"thing"}),
    ("turn", "next"): frozenset({"side", "bend"}),
    ("turn", "ordinal"): frozenset({"side", "bend", "ordinal"}),
    ("turn", "end"): frozenset({"side", "bend"}),
    ("turn", "thing"): frozenset({"side", "bend", "thing"}),
    ("turn", "crossing"): frozenset({"side", "bend"}),
    ("rest", "turn"): frozenset({"side", "bend", "cue", "turn"}),
}
"""The slots that phrases of a case may have; all others: none, or a unit's number."""


def read_answers(file: Path) -> list[Answer]:
    """Return the answers of a file: each fit for its case, and each case in each voice."""
    answers = _read(file, Answer, _check_answer)
    places: dict[str, str] = {}
    for place, answer in answers:
        if answer.id in places:
            raise AnswerFileError(
                f"{place}: expected an id of its own, {answer.id!r} is also at "
                f"{places[answer.id]}"
            )
        places[answer.id] = place
    # What may be missing of a reply must not decide whether a voice has an answer.
    found = {
        (a.manner, a.kind, a.turns if a.case is None else a.case)
        for _, a in answers
        if a.case is None or a.slots <= ALWAYS_GIVEN
    }
    cases = [("way_to", turns) for turns in range(MANY_TURNS + 1)] + list(CASES)
    for manner in sorted({answer.manner for _, answer in answers}):
        for kind, case in cases:
            if (manner, kind, case) not in found:
                raise AnswerFileError(
                    f"{file}: expected an answer to {kind}, {case}, of the manner "
                    f"{manner}, without slots but {sorted(ALWAYS_GIVEN)} where it is no "
                    "way; there is none"
                )
    return [answer for _, answer in answers]


def read_words(file: Path, manners: frozenset[str]) -> list[CueWords]:
    """Return the phrases of a file, whose voices are among `manners`."""

    def check(phrase: CueWords) -> None:
        _check_words(phrase)
        strange = sorted(phrase.manners - manners)
        if strange:
            raise ValueError(
                f"expected manners of the answers, {sorted(manners)}, got {strange}"
            )

    words = [phrase for _, phrase in _read(file, CueWords, check)]
    everybodys = {
        (phrase.slot, phrase.case)
        for phrase in words
        if not phrase.manners and phrase.least == 0
    }
    for slot, cases in WORD_CASES.items():
        for case in cases:
            if (slot, case) not in everybodys:
                raise AnswerFileError(
                    f"{file}: expected a phrase for the slot {slot}, case {case}, that "
                    "fits all manners; there is none"
                )
    return words


def _check_answer(answer: Answer) -> None:
    if answer.case is not None:
        if answer.turns is not None:
            raise ValueError("expected either turns or a case, got both")
        if (answer.kind, answer.case) not in CASES:
            known = [f"{kind} {case}" for kind, case in CASES]
            asked = f"{answer.kind} {answer.case}"
            raise ValueError(
                f"expected a case of {', '.join(known)}, got {asked}"
                f"{did_you_mean(asked, known)}"
            )
        _check_slots(answer.slots, CASES[answer.kind, answer.case])
        return
    if answer.kind != "way_to" or answer.turns is None:
        raise ValueError(f"expected a case of {answer.kind}, got none; add it")
    told = answer.turns_told
    numbers = range(1, told + 1)
    of_turns = {f"{slot}{number}" for slot in _TURN_SLOTS for number in numbers}
    _check_slots(answer.slots, _WAY_SLOTS | of_turns)
    missing: list[str] = []
    if not answer.slots & {"start", "set_off"}:
        missing.append("{start} or {set_off}")
    for n in numbers:
        sided = answer.slots & {f"side{n}", f"bend{n}"} and f"cue{n}" in answer.slots
        if not (sided or f"turn{n}" in answer.slots):
            missing.append(
                f"{{turn{n}}}, or {{cue{n}}} with {{side{n}}} or {{bend{n}}}"
            )
    many = answer.turns == MANY_TURNS
    if many and not answer.partial and "rest" not in answer.slots:
        missing.append("{rest}")
    if not answer.partial and "where" not in answer.slots:
        missing.append("{where}")
    if missing:
        raise ValueError(f"expected the slots {'; '.join(missing)} in {answer.text!r}")
    if answer.partial and not (many and 0 < told < MANY_TURNS):
        raise ValueError(
            f"expected a partial answer to tell 1 to {MANY_TURNS - 1} of "
            f"{MANY_TURNS} turns, got {told} of {answer.turns}"
        )
    if (many and not told < MANY_TURNS) or (not many and told != answer.turns):
        raise ValueError(f"expected slots of {answer.turns} turns, got {told}")


def _check_words(phrase: CueWords) -> None:
    if phrase.case not in WORD_CASES.get(phrase.slot, ()):
        known = [
            f"{slot} {case}" for slot, cases in WORD_CASES.items() for case in cases
        ]
        asked = f"{phrase.slot} {phrase.case}"
        raise ValueError(
            f"expected a slot and case of {', '.join(known)}, got {asked}"
            f"{did_you_mean(asked, known)}"
        )
    counted = phrase.slot == "length" and phrase.case != "unmeasured"
    allowed = _WORD_SLOTS.get((phrase.slot, phrase.case), frozenset[str]())
    _check_slots(phrase.slots, frozenset({"number"}) if counted else allowed)
    needed = allowed & {"ordinal", "thing"} | ({"number"} if counted else set())
    missing = needed - phrase.slots
    if phrase.slot in {"turn", "rest"} and not phrase.slots & {"side", "bend", "turn"}:
        missing |= {"side"}
    if missing:
        raise ValueError(f"expected the slots {sorted(missing)} in {phrase.text!r}")


def _check_slots(slots: frozenset[str], known: frozenset[str]) -> None:
    unknown = sorted(slots - known)
    if unknown:
        raise ValueError(f"expected slots of {sorted(known)}, got {unknown}")


def _read(
    file: Path, record: type[_Record], check: Callable[[_Record], None]
) -> list[tuple[str, _Record]]:
    form: TypeAdapter[Any] = TypeAdapter(record)
    records: list[tuple[str, _Record]] = []
    for place, line in read_lines(file, AnswerFileError):
        try:
            found = form.validate_json(line)
            check(found)
        except ValidationError as error:
            where, mistake = next(mistakes(error))
            raise AnswerFileError(f"{place}: {where}: {mistake}") from None
        except ValueError as problem:
            raise AnswerFileError(f"{place}: {problem}") from None
        records.append((place, found))
    return records
