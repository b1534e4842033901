"""What annotators say of instructions, and the files that keep it (JSONL)."""

import json
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from hashlib import sha256
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from memorymaze.basics.durable_files import append_lines, is_broken_off
from memorymaze.basics.errors import (
    LabelFileError,
    LabelFileWarning,
    SettingsError,
)
from memorymaze.basics.input_files import mistakes, parse_record, read_file, refusal
from memorymaze.texts.corpus.error_kinds import ERROR_KINDS
from memorymaze.texts.corpus.records import Failure, Instruction, Text
from memorymaze.world.sites.records import Site

OTHER_KIND = "other"
LABEL_KINDS = {kind.name: kind.meaning for kind in ERROR_KINDS} | {
    OTHER_KIND: "another significant error; say which"
}
"""Kinds of failures that annotators choose from, and what they mean."""
NO_WAY = "none"
"""Instead of a route's id: the text describes none of the plan's ways."""
STAMP_LENGTH = 16
WRITTEN = b'{"instruction": "'
"""What each line begins with that we wrote; only such a line can have been broken off."""


@dataclass(frozen=True, slots=True)
class Label:
    """What one annotator says of one instruction."""

    instruction: Text
    """Its id."""
    text_sha256: str
    """Of the text that was judged, the first 16 digits."""
    annotator: Text
    way: Text
    """Id of the route that the text describes, or `none`."""
    failures: tuple[Failure, ...]
    """Empty: an attentive person who follows the text arrives."""


_LABEL = TypeAdapter(Label)


def text_stamp(text: str) -> str:
    """Return the fingerprint by which a label knows the text it is about."""
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:STAMP_LENGTH]


def check_annotator(name: str) -> str:
    """Return an annotator's name."""
    if not name or name != name.strip() or not name.isprintable():
        raise SettingsError(
            "--annotator: expected a name without spaces at its ends or control "
            f"characters, got {name!r}"
        )
    return name


def read_labels(
    paths: Sequence[str | Path],
    instructions: Iterable[Instruction],
    sites: Mapping[str, Site],
) -> list[Label]:
    """Read files of labels about these instructions, in order.

    A last line that was broken off is passed over, with a warning.
    """
    known = {each.id: each for each in instructions}
    labels: list[Label] = []
    wrong: list[str] = []
    for path in paths:
        content = read_file(path, LabelFileError)
        lines = content.split(b"\n")
        if is_broken_off(lines[-1], WRITTEN):
            warnings.warn(
                f"{path}:{len(lines)}: the last label was broken off while it was "
                "written; it is left out",
                LabelFileWarning,
                stacklevel=2,
            )
            del lines[-1]
        for number, line in enumerate(lines, start=1):
            if not line.strip():
                continue
            try:
                labels.append(_label(line, known, sites))
            except ValueError as error:
                wrong.append(f"{path}:{number}: {error}")
    if wrong:
        raise refusal(wrong, LabelFileError)
    return labels


def _label(
    line: bytes, known: Mapping[str, Instruction], sites: Mapping[str, Site]
) -> Label:
    record = parse_record(line)
    for name in record.keys() - {each.name for each in fields(Label)}:
        raise ValueError(f"field {name!r} is unknown")
    try:
        read = _LABEL.validate_python(record)
    except ValidationError as error:
        field, said = next(mistakes(error))
        raise ValueError(f"field {field!r}: {said}") from None
    told = known.get(read.instruction)
    if told is None:
        raise ValueError(
            f"field 'instruction': {read.instruction!r} is not among the instructions; "
            "name their file with --instructions"
        )
    if read.text_sha256 != text_stamp(told.text):
        raise ValueError(
            f"field 'text_sha256': the text of {read.instruction!r} is another one than "
            "was labelled"
        )
    ways = [way.id for way in sites[told.site].ways(told.route)]
    if read.way not in {NO_WAY, *ways}:
        raise ValueError(
            f"field 'way': expected {', '.join(ways)} or {NO_WAY}, got {read.way!r}"
        )
    return read


def latest_labels(labels: Iterable[Label]) -> dict[tuple[str, str], Label]:
    """Return the last label by annotator and instruction, in the order first given."""
    return {(each.annotator, each.instruction): each for each in labels}


def append_labels(path: str | Path, labels: Iterable[Label]) -> None:
    """Add labels to a file; they are on the disk when this returns.

    A last line that was broken off is cut away first.
    """
    path = Path(path)
    lines = "".join(
        json.dumps(asdict(each), ensure_ascii=False) + "\n" for each in labels
    )
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        append_lines(path, lines.encode(), WRITTEN)
    except OSError as error:
        raise LabelFileError(
            f"{path}: cannot be written ({error.strerror or error})"
        ) from None
