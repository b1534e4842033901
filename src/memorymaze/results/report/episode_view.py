"""What an episode's page shows: the instruction, and every run's walk."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from memorymaze.drawing.svg import path_data
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.instructions.records import WRITTEN_BY, Instruction
from memorymaze.results.report.file_names import safe_name
from memorymaze.results.report.outcomes import ending_words
from memorymaze.results.report.sources import ReportRun
from memorymaze.results.report.story import Story


@dataclass(frozen=True, slots=True)
class RunInEpisode:
    """An episode of one run."""

    run: ReportRun
    number: int
    """Of the run in the report, from 0."""
    result: EpisodeResult
    story: Story | None
    """None where the trace cannot be read."""
    problem: str | None
    """Why it cannot."""
    line: np.ndarray | None
    """Places of the walk, simplified, metres."""

    @property
    def data(self) -> str:
        """Return the walk as the `d` of an SVG path."""
        return "" if self.line is None else path_data([self.line.tolist()])

    @property
    def end(self) -> tuple[float, float]:
        """Return where it ends, in the coordinates of the SVG."""
        if self.line is None:
            return 0.0, 0.0
        return float(self.line[-1][0]), -float(self.line[-1][1])

    @property
    def numbers(self) -> str:
        """Say in words and numbers what the picture of the walk shows."""
        result = self.result
        return (
            f"Walk of {self.run.title}: {result.path_length:.1f} m in "
            f"{result.duration_s:.0f} s, {ending_words(result)}, "
            f"{result.spd:.1f} m walk from the goal; {result.turns_in_order:.0%} of the "
            f"turns in order, {result.collisions} collisions."
        )

    @property
    def data_file(self) -> str:
        """Return the script that holds the story, from the site's root."""
        return f"data/{self.number}/{safe_name(self.result.episode_id)}.js"


@dataclass(frozen=True, slots=True)
class EpisodeView:
    """An episode, in all runs that have it."""

    episode_id: str
    first: EpisodeResult
    """Of any run; what belongs to the instruction is the same in all."""
    instruction: Instruction | None
    """None where its file was not found."""
    text: str
    runs: tuple[RunInEpisode, ...]

    @property
    def written_by(self) -> str:
        """Say who wrote the instruction."""
        return WRITTEN_BY[self.first.source]

    @property
    def longest(self) -> float:
        """Return the duration of the longest walk, simulated seconds."""
        return max(each.result.duration_s for each in self.runs)


@dataclass(frozen=True, slots=True)
class EpisodeRow:
    """An episode in a list."""

    episode_id: str
    first: EpisodeResult
    failures: tuple[str, ...] | None
    """Kinds of errors; None where the instruction's file was not found."""
    results: tuple[EpisodeResult | None, ...]
    """One per run of the report."""


def told_text(instruction: Instruction | None, runs: Sequence[RunInEpisode]) -> str:
    """Return the instruction's text, from its file or else from a trace."""
    if instruction is not None:
        return instruction.text
    for each in runs:
        if each.story is not None and each.story.instruction is not None:
            return each.story.instruction
    return "(neither the instruction's file nor a trace could be read)"
