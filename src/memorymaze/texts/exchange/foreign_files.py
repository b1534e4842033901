"""What the formats have in common: packed JSON files, and our record inside theirs."""

import gzip
import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, NamedTuple, TypeVar

from pydantic import TypeAdapter, ValidationError

from memorymaze.basics.errors import InstructionFileError
from memorymaze.basics.input_files import mistakes, parse_json, read_file, refusal
from memorymaze.texts.corpus.record_format import (
    InstructionProblem,
    parse_line,
    write_file,
)
from memorymaze.texts.corpus.records import Instruction
from memorymaze.world.sites.records import Route, Site

OWN_FIELD = "memorymaze"
"""Where a foreign record keeps what its format has no place for."""


_Read = TypeVar("_Read")


class Unlabelled(NamedTuple):
    """What is to be said of instructions from files that do not say it."""

    study: Literal["online", "onsite"]
    source: Literal["human", "llm", "synthetic"]
    language: str = "en"


def by_split(instructions: Iterable[Instruction]) -> dict[str, list[Instruction]]:
    """Sort instructions by split; the order within a split is kept."""
    splits: dict[str, list[Instruction]] = {}
    for instruction in instructions:
        splits.setdefault(instruction.split, []).append(instruction)
    return splits


def parsed(record: Mapping[str, Any], place: str) -> Instruction:
    """Check a record of ours that another format carried.

    Raises:
        InstructionFileError: It is not as `docs/formats.md` says.
    """
    instruction, unknown, problems = parse_line(json.dumps(record), place)
    if instruction is None or unknown:
        strange = [f"field {name!r}" for name in unknown]
        said = [InstructionProblem(place, each) for each in (*problems, *strange)]
        raise refusal(said, InstructionFileError)
    return instruction


def own_or_new(
    kept: Mapping[str, Any] | None,
    text: str,
    candidates: Sequence[tuple[Site, Route]],
    *,
    new_id: str,
    split: str,
    labels: Unlabelled | None,
    place: str,
) -> Instruction:
    """Return the instruction kept in a foreign record, else make one of its text.

    Where no record of ours is kept, the first of the routes that the foreign record fits
    is meant, and the new id is also the participant's.

    Raises:
        InstructionFileError: Both texts differ, the route is another one than the
            record says, or labels are needed and not given.
    """
    if kept is None:
        site, route = candidates[0]
        if labels is None:
            raise InstructionFileError(
                f"{place}: expected to be told how the texts came to be, since the file "
                "does not say; give --study and --source"
            )
        kept = {
            "id": new_id,
            "site": site.name,
            "route": route.route,
            "study": labels.study,
            "text": text,
            "reference_route": route.id,
            "source": labels.source,
            "language": labels.language,
            "split": split,
        }
    instruction = parsed(kept, place)
    if instruction.text != text:
        raise InstructionFileError(
            f"{place}: expected the text {instruction.text[:50]!r}… that field "
            f"{OWN_FIELD!r} has, got {text[:50]!r}…; one of them was edited"
        )
    fitting = [(site.name, route.id) for site, route in candidates]
    if (instruction.site, instruction.reference_route) not in fitting:
        got = " or ".join(" ".join(one) for one in fitting)
        raise InstructionFileError(
            f"{place}: expected the path of {instruction.site} "
            f"{instruction.reference_route}, as field {OWN_FIELD!r} says, got that of "
            f"{got}; the plan or the path was edited"
        )
    return instruction


def split_of(path: Path) -> str:
    """Return the split that a file name ends in: `R2R_val_seen.json` is `val_seen`."""
    return path.name.partition(".")[0].removeprefix("R2R_").lower() or "test"


def site_called(name: str, sites: Mapping[str, Site], place: str) -> Site:
    """Return the site that a foreign record names.

    Raises:
        InstructionFileError: There is none of this name.
    """
    if name not in sites:
        raise InstructionFileError(
            f"{place}: expected one of the sites ({', '.join(sorted(sites))}), got "
            f"{name!r}; give the folder of its plan with --sites"
        )
    return sites[name]


def read_as(adapter: TypeAdapter[_Read], path: Path, what: str) -> _Read:
    """Read a JSON file, gzipped or not, that holds what an adapter says.

    Raises:
        InstructionFileError: It cannot be read, or holds something else.
    """
    try:
        return adapter.validate_python(read_json(path))
    except ValidationError as error:
        where, said = next(mistakes(error))
        raise InstructionFileError(
            f"{path}: expected {what}: {where or 'the whole'}: {said}"
        ) from None


def read_json(path: str | Path) -> Any:
    """Read a JSON file; gzipped where its name ends in `.gz`.

    Raises:
        InstructionFileError: It cannot be read, or is not JSON.
    """
    try:
        return parse_json(read_file(path, InstructionFileError))
    except ValueError as error:
        raise InstructionFileError(f"{path}: {error}") from None


def write_json(path: str | Path, value: Any) -> None:
    """Write a JSON file; gzipped where its name ends in `.gz`.

    The same value gives the same bytes.

    Raises:
        InstructionFileError: It cannot be written.
    """
    content = json.dumps(value, ensure_ascii=False, allow_nan=False).encode()
    if Path(path).suffix == ".gz":
        content = gzip.compress(content, mtime=0)
    write_file(path, content)
