"""What can be wrong in an instruction file, and how it is told."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.records import Instruction

PROBLEMS_SHOWN = 20


@dataclass(frozen=True, slots=True)
class InstructionProblem:
    """Something wrong in an instruction file."""

    place: str
    """`file`, or `file:line`."""
    message: str
    """What was expected and what came, naming the field."""

    def __str__(self) -> str:
        """Return one line: place and message."""
        return f"{self.place}: {self.message}"


def place_of(instruction: Instruction) -> str:
    """Return where an instruction comes from: `file:line`, else its id."""
    return instruction.origin or f"instruction {instruction.id}"


def repeated_ids(instructions: Iterable[Instruction]) -> list[InstructionProblem]:
    """List the instructions whose id an earlier one has."""
    first: dict[str, Instruction] = {}
    problems: list[InstructionProblem] = []
    for instruction in instructions:
        earlier = first.setdefault(instruction.id, instruction)
        if earlier is not instruction:
            message = (
                f"field 'id': expected a new id, got {instruction.id!r}, which "
                f"{place_of(earlier)} has"
            )
            problems.append(InstructionProblem(place_of(instruction), message))
    return problems


def refusal(problems: Sequence[InstructionProblem]) -> InstructionFileError:
    """Return the error that lists the problems, the first 20 in full."""
    shown = [str(problem) for problem in problems[:PROBLEMS_SHOWN]]
    more = len(problems) - len(shown)
    if more:
        shown.append(f"… and {more} more")
    noun = "problem" if len(problems) == 1 else "problems"
    return InstructionFileError(
        f"{len(problems)} {noun} in the instructions:\n" + "\n".join(shown)
    )
