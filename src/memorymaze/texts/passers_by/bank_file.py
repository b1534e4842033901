"""Reading the bank's two files, with all that is checked of them."""

from collections.abc import Callable, Collection, Iterable
from itertools import product
from pathlib import Path
from typing import Any, TypeVar

from pydantic import TypeAdapter, ValidationError

from memorymaze.basics.errors import AnswerFileError, did_you_mean
from memorymaze.basics.input_files import mistakes, read_lines
from memorymaze.texts.passers_by.bank_records import (
    ALWAYS_GIVEN,
    MANY_TURNS,
    REPLY_CASES,
    WAY_CASES,
    WORD_CASES,
    BankAnswer,
    CueWords,
    Phrase,
)

_Record = TypeVar("_Record")

_WAY_SLOTS = {"start", "set_off", "where", "metres", "total", "destination", "rest"}
_TURN_SLOTS = ("side", "bend", "cue", "turn", "metres", "wrong")


def read_answers(file: Path) -> list[BankAnswer]:
    """Return the answers of a file: each fit for its case, and each case in each voice."""
    ids: set[str] = set()

    def check(answer: BankAnswer) -> None:
        if answer.id in ids:
            raise ValueError(f"expected an id of its own, got {answer.id!r} once more")
        ids.add(answer.id)
        _check_answer(answer)

    answers = _read(file, BankAnswer, check)
    # What may be missing of a reply must not decide whether a voice has an answer.
    found = {
        (a.manner, (a.kind, a.case))
        for a in answers
        if a.case in WAY_CASES or a.slots <= ALWAYS_GIVEN
    }
    ways = [("way_to", case) for case in WAY_CASES]
    manners = sorted({answer.manner for answer in answers})
    for manner, case in product(manners, [*ways, *REPLY_CASES]):
        if (manner, case) not in found:
            raise AnswerFileError(
                f"{file}: expected an answer to {' '.join(case)} of the manner {manner}, "
                f"a reply without slots but {sorted(ALWAYS_GIVEN)}; there is none"
            )
    return answers


def read_words(file: Path, manners: Collection[str]) -> list[CueWords]:
    """Return the phrases of a file, whose voices are among `manners`."""

    def check(phrase: CueWords) -> None:
        _check_case((phrase.slot, phrase.case), WORD_CASES)
        needed = WORD_CASES[phrase.slot, phrase.case]
        _check_slots(phrase, needed, {name for each in needed for name in each})
        strange = sorted(phrase.manners - set(manners))
        if strange:
            raise ValueError(f"expected manners of {sorted(manners)}, got {strange}")

    words = _read(file, CueWords, check)
    everybodys = {(w.slot, w.case) for w in words if w.is_for_all}
    for case in WORD_CASES:
        if case not in everybodys:
            raise AnswerFileError(
                f"{file}: expected a phrase for {' '.join(case)} that fits all manners and lengths; "
                "there is none"
            )
    return words


def _check_answer(answer: BankAnswer) -> None:
    if answer.kind != "way_to" or answer.case not in WAY_CASES:
        ways = [("way_to", case) for case in WAY_CASES]
        _check_case((answer.kind, answer.case), [*ways, *REPLY_CASES])
        _check_slots(answer, (), REPLY_CASES[answer.kind, answer.case])
        return
    turns = WAY_CASES.index(answer.case)
    many = turns == MANY_TURNS
    told = max(answer.turns_told, 1) if many else turns
    needed = [("start", "set_off")]
    for n in range(1, told + 1):
        needed += [(f"turn{n}", f"side{n}", f"bend{n}"), (f"turn{n}", f"cue{n}")]
    if not many or answer.slots & {"where", "rest"}:
        needed += [("where",)]
    if many and "where" in answer.slots:
        needed += [("rest",)]
    numbers = range(1, min(turns, MANY_TURNS - 1) + 1)
    of_turns = {f"{slot}{number}" for slot, number in product(_TURN_SLOTS, numbers)}
    _check_slots(answer, needed, _WAY_SLOTS | of_turns)


def _check_case(case: tuple[str, str], known: Iterable[tuple[str, str]]) -> None:
    if case not in known:
        names = [" ".join(each) for each in known]
        asked = " ".join(case)
        raise ValueError(
            f"expected a case of {', '.join(names)}, got {asked}"
            f"{did_you_mean(asked, names)}"
        )


def _check_slots(
    phrase: Phrase,
    needed: Iterable[Collection[str]],
    known: Collection[str],
) -> None:
    """Refuse unknown slots, and a text without any slot of a group that it needs."""
    unknown = sorted(phrase.slots - set(known))
    if unknown:
        raise ValueError(f"expected slots of {sorted(known)}, got {unknown}")
    for group in needed:
        if phrase.slots.isdisjoint(group):
            names = " or ".join(f"{{{name}}}" for name in group)
            raise ValueError(f"expected the slot {names} in {phrase.text!r}")


def _read(
    file: Path, record: type[_Record], check: Callable[[_Record], None]
) -> list[_Record]:
    form: TypeAdapter[Any] = TypeAdapter(record)
    records: list[_Record] = []
    for place, line in read_lines(file, AnswerFileError):
        try:
            records.append(form.validate_json(line))
            check(records[-1])
        except ValidationError as error:
            where, mistake = next(mistakes(error))
            raise AnswerFileError(f"{place}: {where}: {mistake}") from None
        except ValueError as problem:
            raise AnswerFileError(f"{place}: {problem}") from None
    return records
