"""What a report is made from: runs, the instructions they followed, the plans."""

import string
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.wording import counted
from memorymaze.runs.story.recorded_episode import site_of
from memorymaze.runs.tables import MeasuredRun, load_runs
from memorymaze.runs.work.run_folder import read_instructions, read_plans
from memorymaze.texts.corpus.records import Instruction
from memorymaze.world.sites import Site


@dataclass(frozen=True, slots=True)
class ReportRun(MeasuredRun):
    """A run of a report."""

    letter: str = ""
    """`A`, `B`, …: how it is called where its name is too long."""

    @property
    def title(self) -> str:
        """Letter and method."""
        return f"{self.letter}: {self.label}"


@dataclass(frozen=True, slots=True)
class Sources:
    """All that a report tells of."""

    runs: tuple[ReportRun, ...]
    sites: dict[str, Site]
    instructions: dict[str, Instruction]
    """By id."""
    notes: tuple[str, ...]
    """What readers should know."""


def read_sources(
    folders: Sequence[str | Path], *, exclude_dev: bool = False
) -> Sources:
    """Read runs with the instructions and plans that they keep.

    Args:
        folders: Run folders, at least one.
        exclude_dev: Whether to leave out instructions that prompts may be built from.

    Raises:
        RunFolderError: A folder is no run, has no result to show, or does not keep what
            it was made with.
        SettingsError: A folder is named twice.
        SitePlanError: A plan cannot be used.
    """
    runs = tuple(
        replace(run, letter=_letter(number))
        for number, run in enumerate(
            load_runs(folders, ReportRun, exclude_dev=exclude_dev)
        )
    )
    sites: dict[str, Site] = {}
    instructions: dict[str, Instruction] = {}
    notes: list[str] = []
    for run in runs:
        plans = read_plans(run.folder)
        for result in run.results:
            site = site_of(result, plans, run.folder)
            sites.setdefault(site.name, site)
            site_of(result, sites, run.folder)
        notes += [
            f"The plan of {name} in run {run.letter} is another one than before; its "
            "walks are drawn on that of the first run."
            for name, site in plans.items()
            if name in sites and sites[name] != site
        ]
        told = {each.id: each for each in read_instructions(run.folder)}
        for result in run.results:
            if result.instruction_id not in told:
                raise RunFolderError(
                    f"{run.folder}: expected instruction {result.instruction_id!r} of "
                    f"episode {result.episode_id!r} among those that the run keeps"
                )
        others = [
            name
            for name in told.keys() & instructions.keys()
            if told[name].text != instructions[name].text
        ]
        if others:
            notes.append(
                f"{counted(len(others), 'instruction')} of run {run.letter} had another "
                f"text than before, such as {min(others)}; that of the first run is shown."
            )
        instructions = told | instructions
    return Sources(runs, sites, instructions, tuple(notes))


def _letter(number: int) -> str:
    letters = string.ascii_uppercase
    after, first = divmod(number, len(letters))
    return letters[first] if after == 0 else f"{letters[first]}{after + 1}"
