"""What instructions say, in numbers: Table I, words, marks of speech, distances."""

from memorymaze.results.instruction_study.study import (
    InstructionStudy,
    study_instructions,
)
from memorymaze.results.instruction_study.writing import write_study

__all__ = ["InstructionStudy", "study_instructions", "write_study"]
