"""What instructions say, in numbers: Table I, words, marks of speech, distances.

`study` counts, `named_things` and `stated_distances` compare texts with the building,
`tables` and `page` show. Statistics of results are in `runs.tables`.
"""

from collections.abc import Mapping, Sequence
from typing import Literal

from memorymaze.basics.extras import require_extra
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.statistics.study import (
    InstructionStudy,
    study_instructions,
)
from memorymaze.texts.statistics.tables import study_csv, study_text
from memorymaze.world.sites.records import Site

__all__ = ["InstructionStudy", "StudyFormat", "study_instructions", "write_study"]

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
            return study_text(study)
        case "csv":
            return study_csv(study)
        case "html":
            from memorymaze.texts.statistics.page import study_page

            return study_page(study, seed=seed)
