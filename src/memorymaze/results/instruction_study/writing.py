"""Writing the statistics in one of the formats."""

from collections.abc import Mapping, Sequence
from typing import Literal

from memorymaze.extras import require_extra
from memorymaze.instructions.records import Instruction
from memorymaze.results.instruction_study.spreadsheet import study_csv
from memorymaze.results.instruction_study.study import study_instructions
from memorymaze.results.instruction_study.text import format_study
from memorymaze.sites.records import Site

StudyFormat = Literal["text", "csv", "html"]


def write_study(
    instructions: Sequence[Instruction],
    sites: Mapping[str, Site],
    form: StudyFormat,
    *,
    seed: int = 0,
) -> str:
    """Compute the statistics of instructions and return them in a format.

    Args:
        instructions: Instructions whose sites and routes exist.
        sites: Sites by name.
        form: `html` is one page that needs no other file.
        seed: Of the orders behind type-token curves, and of word clouds.

    Raises:
        InstructionFileError: There are no instructions.
        SettingsError: `html` without the packages of the extra `analysis`.
    """
    if form == "html":
        # Before the work rather than after it.
        require_extra(
            "analysis",
            "wordcloud",
            purpose="--format html",
            otherwise="choose --format text or csv",
        )
    study = study_instructions(instructions, sites, seed=seed)
    match form:
        case "text":
            return format_study(study)
        case "csv":
            return study_csv(study)
        case "html":
            from memorymaze.results.instruction_study.page import study_page

            return study_page(study, seed=seed)
