"""Everything that is wrong in instruction files, all at once."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.corpus import read_instruction_file
from memorymaze.instructions.episodes import site_problems
from memorymaze.instructions.problems import InstructionProblem, repeated_ids
from memorymaze.instructions.records import Instruction
from memorymaze.sites.records import Site

__all__ = ["check_instruction_files"]


def check_instruction_files(
    paths: Sequence[str | Path], sites: Mapping[str, Site]
) -> tuple[int, list[InstructionProblem]]:
    """Check files, also against the sites they speak of; never raises for content.

    Returns:
        How many instructions can be used, and what is wrong with the others.
    """
    instructions: list[Instruction] = []
    problems: list[InstructionProblem] = []
    for path in paths:
        try:
            read, wrong = read_instruction_file(path)
        except InstructionFileError as error:
            place, _, message = str(error).partition(": ")
            problems.append(InstructionProblem(place, message))
        else:
            instructions += read
            problems += wrong
    misplaced = repeated_ids(instructions) + site_problems(instructions, sites)
    bad = {problem.place for problem in misplaced}
    good = sum(instruction.origin not in bad for instruction in instructions)
    return good, problems + misplaced
