"""Checks a file of programs before a run: its records, and each program by itself."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from tqdm import tqdm

from memorymaze.errors import ProgramError
from memorymaze.evaluation.program_files import missing_programs, read_programs
from memorymaze.instructions.records import Instruction
from memorymaze.language.json_lines import some
from memorymaze.language.sandbox import screen_program

Kind = Literal["problem", "unsafe", "crash", "model_error", "note"]
"""`problem`: the file cannot be used so. `unsafe`, `crash`, `model_error`: a record that
can be used, and how its episode will end. `note`: worth knowing."""


@dataclass(frozen=True, slots=True)
class Remark:
    """One line on a file of programs."""

    kind: Kind
    text: str
    """With `file:line` where there is one."""


@dataclass(frozen=True, slots=True)
class CheckedPrograms:
    """What was found in a file of programs."""

    remarks: tuple[Remark, ...]
    agent: str | None
    """Name in tables; None where no record is sound."""
    records: int
    """That are sound."""
    instructions: int
    """That programs are wanted for."""

    @property
    def usable(self) -> bool:
        """Whether `evaluate` takes the file for these instructions."""
        return not any(remark.kind == "problem" for remark in self.remarks)

    def count(self, kind: Kind) -> int:
        """Return how many remarks there are of a kind."""
        return Counter(remark.kind for remark in self.remarks)[kind]


def check_programs(
    path: str | Path, instructions: Sequence[Instruction]
) -> CheckedPrograms:
    """Find what is wrong with a file of programs; no program is run.

    Raises:
        ProgramFileError: The file cannot be read, is not UTF-8, or is empty.
    """
    file = read_programs(path)
    remarks = [Remark("problem", problem) for problem in file.problems]
    wanted = [each.id for each in instructions]
    known = set(wanted)
    for identifier, record in tqdm(
        file.records.items(), unit="program", disable=None, leave=False
    ):
        place = file.places[identifier]
        if identifier not in known:
            text = f"{place}: {identifier!r} is the id of no instruction; not used"
            remarks.append(Remark("note", text))
        if record.program is None:
            text = f"{place}: {identifier}: no program: {record.error}"
            remarks.append(Remark("model_error", text))
        else:
            remarks += _screened(record.program, f"{place}: {identifier}")
    missing = missing_programs(file, wanted)
    if missing:
        text = f"{path}: no program for {len(missing)} of {len(wanted)} instructions: "
        remarks.append(Remark("problem", text + some(missing)))
    if file.unused:
        fields = ", ".join(map(repr, file.unused))
        remarks.append(Remark("note", f"{path}: fields that are not used: {fields}"))
    agent = file.first.agent if file.records else None
    return CheckedPrograms(tuple(remarks), agent, len(file.records), len(wanted))


def _screened(program: str, place: str) -> list[Remark]:
    try:
        doubts = screen_program(program)
    except ProgramError as error:
        return [Remark("unsafe" if error.unsafe else "crash", f"{place}: {error}")]
    return [Remark("note", f"{place}: {doubt}") for doubt in doubts]
