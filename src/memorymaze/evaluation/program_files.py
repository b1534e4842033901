"""Files of programs that were written elsewhere, one for each instruction.

JSONL, one record per line: `instruction_id`, `model` and `program`; or `error` in the
place of a program that the model failed to write. What else there can be is in
`docs/code_generation.md`.
"""

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, StringConstraints, TypeAdapter, ValidationError

from memorymaze.errors import did_you_mean
from memorymaze.language.json_lines import json_record, lines_of, listed, shown
from memorymaze.language.model import Completion, Usage

Text = Annotated[str, StringConstraints(min_length=1, pattern=r"\S")]
Count = Annotated[int, Field(ge=0)]
Amount = Annotated[float, Field(ge=0, allow_inf_nan=False)]


@dataclass(frozen=True, slots=True)
class ProgramReply:
    """A model's reply on the way to a program."""

    stage: Text
    """`parse` or `program`."""
    text: str
    prompt_tokens: Count = 0
    completion_tokens: Count = 0
    cost_usd: Amount | None = None
    latency_s: Amount = 0.0
    """Seconds from request to reply; 0 where nobody measured them."""

    def completion(self, model: str) -> Completion:
        """Return the reply as the model gave it."""
        usage = Usage(self.prompt_tokens, self.completion_tokens, self.cost_usd)
        return Completion(self.text, model, usage, self.latency_s)


@dataclass(frozen=True, slots=True)
class ProgramRecord:
    """A program for an instruction, and where it comes from."""

    instruction_id: Text
    model: Text
    """Name of the model that wrote it."""
    program: str | None = None
    """Python source; None where the model failed to write one."""
    error: str | None = None
    """Why there is no program."""
    method: Text | None = None
    """Name in tables; None for `programs[model]`."""
    parser: bool | None = None
    """Whether the instruction was parsed into steps first; None where nobody says."""
    steps: tuple[str, ...] | None = None
    """What it was parsed into."""
    replies: tuple[ProgramReply, ...] = ()
    """What was spent on it, in the order of the requests."""

    @property
    def agent(self) -> str:
        """Name in tables."""
        return self.method or f"programs[{self.model}]"


@dataclass(frozen=True, slots=True)
class ProgramFile:
    """What is in a file of programs, sound or not."""

    path: Path
    records: dict[str, ProgramRecord]
    """By instruction id."""
    places: dict[str, str]
    """`file:line` of each."""
    problems: tuple[str, ...]
    """One line each, with its place."""
    unused: tuple[str, ...]
    """Names of fields that the format does not know."""

    @property
    def first(self) -> ProgramRecord:
        """A record, for what all have in common."""
        return next(iter(self.records.values()))


_RECORD = TypeAdapter(ProgramRecord)
_FIELDS = tuple(ProgramRecord.__dataclass_fields__)
_COMMON = ("model", "method", "parser")
"""Fields that all records of a file have in common: a file is one method."""


def read_programs(path: str | Path) -> ProgramFile:
    """Read a file, and find all that is wrong with it.

    Raises:
        ProgramFileError: The file cannot be read, is not UTF-8, or is empty.
    """
    records: dict[str, ProgramRecord] = {}
    places: dict[str, str] = {}
    problems: list[str] = []
    unused: dict[str, None] = {}
    for place, line in lines_of(path):
        try:
            record, extra = _record(line)
        except ValueError as error:
            problems.append(f"{place}: {error}")
            continue
        unused.update(dict.fromkeys(extra))
        known = places.setdefault(record.instruction_id, place)
        if known != place:
            problems.append(
                f"{place}: expected one program for an instruction, got a second one for "
                f"{record.instruction_id!r}, which {known} has"
            )
            continue
        for name in _COMMON:
            first = next(iter(records.values()), record)
            if getattr(record, name) != getattr(first, name):
                problems.append(
                    f"{place}: expected {name} {getattr(first, name)!r} as in the first "
                    f"record, got {getattr(record, name)!r}; a file is one method: split "
                    "it"
                )
                break
        else:
            records[record.instruction_id] = record
    return ProgramFile(Path(path), records, places, tuple(problems), tuple(unused))


def load_programs(path: str | Path) -> ProgramFile:
    """Read a file in which everything must be right.

    Raises:
        ProgramFileError: Something in it is wrong; lists what.
    """
    file = read_programs(path)
    if file.problems:
        raise listed(file.problems)
    return file


def missing_programs(file: ProgramFile, instruction_ids: Iterable[str]) -> list[str]:
    """Return the ids for which a file has no record, in their order."""
    return [each for each in instruction_ids if each not in file.records]


def program_lines(records: Sequence[ProgramRecord]) -> bytes:
    """Write records as the lines of a file; fields that say nothing are left out."""
    # In ASCII: some readers take U+2028 and the like in a text for line ends.
    lines = (json.dumps(_without_nothing(asdict(record))) for record in records)
    return "".join(f"{line}\n" for line in lines).encode()


def _without_nothing(record: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in record.items() if value not in (None, ())}


def _record(line: str) -> tuple[ProgramRecord, list[str]]:
    """Read one line; return the record and the names of fields that nobody knows."""
    content = json_record(line)
    unknown = [name for name in content if name not in _FIELDS]
    unset = [name for name in _FIELDS if name not in content]
    for name in unknown:
        meant = did_you_mean(name, unset, cutoff=0.75)
        if meant:
            raise ValueError(f"field {name!r} is unknown{meant}")
    try:
        record = _RECORD.validate_python(content)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"]) or "the record"
        if first["type"] == "missing":
            raise ValueError(f"field {field!r} is missing") from None
        raise ValueError(
            f"field {field!r} is wrong ({first['msg']}), got {shown(first['input'])}"
        ) from None
    if (record.program is None) == (record.error is None):
        given = "neither" if record.program is None else "both"
        raise ValueError(
            "expected either `program`, or `error` that says why there is none, got "
            f"{given}"
        )
    return record, unknown
