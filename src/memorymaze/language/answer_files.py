"""Answers in a file: JSONL, one record per line, from any model or by hand.

A record is an answer to one question (`instruction_id`, `stage`, `reply` or `error`), or
all that one instruction took on the way to a program (`instruction_id`, `program` or
`error`, and `replies`). What else there can be is in `docs/language_models.md`.
"""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Annotated

from pydantic import Field, StringConstraints, TypeAdapter, ValidationError

from memorymaze.errors import AnswerFileError
from memorymaze.input_files import mistakes, parse_record, read_lines, unknown_fields
from memorymaze.language.model import MOST_TOKENS, Completion, Question, Usage
from memorymaze.language.prompt_texts import numbered

Text = Annotated[str, StringConstraints(min_length=1, pattern=r"\S")]
Count = Annotated[int, Field(ge=0, le=MOST_TOKENS)]
Amount = Annotated[float, Field(ge=0, le=1e9)]


@dataclass(frozen=True, slots=True)
class Answer:
    """An answer, or why there is none, and the question it was given to."""

    instruction: str
    stage: str
    """One without a variant answers all its variants."""
    number: int
    prompt: str | None
    """Version of the prompt; None where nobody says."""
    completion: Completion | None
    error: str | None
    """Why there is no completion."""
    place: str
    """`file:line`, or the file."""

    def answers(self, stage: str) -> bool:
        """Tell whether it answers a stage, such as `program` that of `program+parser`."""
        return stage == self.stage or stage.startswith(f"{self.stage}+")


@dataclass(frozen=True, slots=True)
class _Reply:
    """One reply on the way to a program."""

    stage: Text
    text: str
    prompt_tokens: Count = 0
    completion_tokens: Count = 0
    cost_usd: Amount | None = None
    latency_s: Amount = 0.0


@dataclass(frozen=True, slots=True)
class _Record:
    """One line, of either kind; `method` is read and not used."""

    instruction_id: Text
    model: Text | None = None
    stage: Text | None = None
    number: Annotated[int, Field(ge=1)] = 1
    step: Annotated[int, Field(ge=1)] | None = None
    prompt: Text | None = None
    reply: str | None = None
    error: str | None = None
    prompt_tokens: Count = 0
    completion_tokens: Count = 0
    cost_usd: Amount | None = None
    latency_s: Amount = 0.0
    program: str | None = None
    method: Text | None = None
    parser: bool | None = None
    steps: tuple[str, ...] | None = None
    replies: tuple[_Reply, ...] = ()


_RECORD = TypeAdapter(_Record)
_FIELDS = [field.name for field in fields(_Record)]
_COMMON = ("model", "parser")
"""Fields that all records of a file have in common: a file is one method."""


class AnswerFile:
    """The answers in one file, sound or not.

    `problems` says what is wrong, one line each with its place; `unused` names fields that
    the format does not know.
    """

    def __init__(self, path: str | Path) -> None:
        """Read the file, and find all that is wrong with it."""
        self.path = Path(path)
        self.answers: list[Answer] = []
        self.problems: list[str] = []
        unused: dict[str, None] = {}
        first: _Record | None = None
        places: dict[tuple[str, str, int, str | None], str] = {}
        for place, line in read_lines(path, AnswerFileError):
            try:
                record, extra = _read(line)
                first = first or record
                _check_common(record, first)
                found = list(_answers(record, place))
                for each in found:
                    key = (each.instruction, each.stage, each.number, each.prompt)
                    known = places.setdefault(key, place)
                    if known != place:
                        raise ValueError(
                            f"expected one answer to a question, got a second one to "
                            f"{each.stage} of {each.instruction!r}, which {known} has"
                        )
            except ValueError as error:
                self.problems.append(f"{place}: {error}")
                continue
            unused.update(dict.fromkeys(extra))
            self.answers += found
        self.unused = tuple(unused)
        named = None if first is None else first.model
        self.model = named or self.path.stem
        self._by_question: dict[tuple[str, int], list[Answer]] = {}
        for each in self.answers:
            key = (each.instruction, each.number)
            self._by_question.setdefault(key, []).append(each)

    def find_by_question(self, question: Question) -> Answer | None:
        """Return the answer to a question, under this version of the prompt or another."""
        asked = self._by_question.get((question.instruction, question.number), [])
        matching = [each for each in asked if each.answers(question.stage)]
        same = [each for each in matching if each.prompt == question.prompt]
        return (same or matching or [None])[-1]

    def stages(self) -> dict[tuple[str, str], set[str | None]]:
        """Return the versions of prompts answered, by instruction and stage."""
        found: dict[tuple[str, str], set[str | None]] = {}
        for each in self.answers:
            found.setdefault((each.instruction, each.stage), set()).add(each.prompt)
        return found


def _read(line: str) -> tuple[_Record, list[str]]:
    """Read one line; return the record and the names of fields that nobody knows."""
    content = parse_record(line)
    unknown = unknown_fields(content, _FIELDS)
    try:
        record = _RECORD.validate_python(content)
    except ValidationError as error:
        where, what = next(mistakes(error))
        raise ValueError(f"field {where!r}: {what}") from None
    kinds = [name for name in ("program", "reply", "error") if name in content]
    if len([name for name in kinds if content[name] is not None]) != 1:
        raise ValueError(
            "expected either `program` or `reply`, or `error` that says why there is "
            f"none, got {' and '.join(kinds) or 'neither'}"
        )
    if record.reply is not None and not (record.stage or record.step):
        raise ValueError("field 'stage' is missing: what the reply answers")
    if record.parser and not (record.replies or record.steps or record.error):
        raise ValueError(
            "expected `steps` or `replies` where `parser` is true: what the "
            "instruction was parsed into"
        )
    if record.program is not None and record.replies:
        written = "".join(record.replies[-1].text.split())
        if "".join(record.program.split()) not in written:
            raise ValueError(
                "expected the `program` that is in the last of `replies`, got another "
                "one; leave `replies` out where it was changed by hand"
            )
    return record, unknown


def _check_common(record: _Record, first: _Record) -> None:
    for name in _COMMON:
        expected, got = getattr(first, name), getattr(record, name)
        if got != expected:
            raise ValueError(
                f"expected {name} {expected!r} as in the first record, got {got!r}; a "
                "file is one method: split it"
            )


def _answers(record: _Record, place: str) -> Iterator[Answer]:
    """Yield what a record answers; of the way to a program, each reply."""
    if record.program is None and (record.stage or record.step):
        said = None if record.reply is None else _said(record, record.reply)
        yield _answer(record, record.stage or "step", said, place)
        return
    answered: set[str] = set()
    for each in record.replies:
        answered.add(each.stage)
        usage = Usage(each.prompt_tokens, each.completion_tokens, each.cost_usd)
        said = Completion(each.text, record.model or "", usage, each.latency_s)
        yield _answer(record, each.stage, said, place)
    # As a model would have said it; it is no inference.
    written = {
        "parse": None if record.steps is None else numbered(record.steps),
        "program": None if record.program is None else _fenced(record.program),
    }
    for stage in ("parse", "program") if record.parser else ("program",):
        if stage not in answered:
            text = written[stage]
            said = None if text is None else _said(record, text, inferred=False)
            yield _answer(record, stage, said, place)


def _fenced(program: str) -> str:
    fence = "~~~" if "```" in program else "```"
    return f"{fence}python\n{program}\n{fence}"


def _said(record: _Record, text: str, *, inferred: bool = True) -> Completion:
    usage = Usage(record.prompt_tokens, record.completion_tokens, record.cost_usd)
    return Completion(text, record.model or "", usage, record.latency_s, inferred)


def _answer(record: _Record, stage: str, said: Completion | None, place: str) -> Answer:
    return Answer(
        instruction=record.instruction_id,
        stage=stage,
        number=record.step or record.number,
        prompt=record.prompt,
        completion=said,
        error=None if said is not None else record.error,
        place=place,
    )
