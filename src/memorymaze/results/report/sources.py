"""What a report is made from: runs, the instructions they followed, the plans."""

import string
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from memorymaze.errors import SettingsError
from memorymaze.evaluation.settings import FileStamp, stamp_file
from memorymaze.instructions import load_corpus
from memorymaze.instructions.files import BUILTIN_CORPUS, load_instructions
from memorymaze.instructions.records import Instruction
from memorymaze.results.tables import MeasuredRun, load_runs
from memorymaze.sites import Site, load_sites


@dataclass(frozen=True, slots=True)
class ReportRun:
    """A run of a report."""

    letter: str
    """`A`, `B`, …: how it is called where its name is too long."""
    folder: Path
    measured: MeasuredRun

    @property
    def title(self) -> str:
        """Letter and method."""
        return f"{self.letter}: {self.measured.label}"


@dataclass(frozen=True, slots=True)
class Sources:
    """All that a report tells of."""

    runs: tuple[ReportRun, ...]
    sites: dict[str, Site]
    instructions: dict[str, Instruction]
    """By id; none of files that were not found."""
    notes: tuple[str, ...]
    """What could not be found, and what has changed since the runs."""


def read_sources(
    folders: Sequence[str | Path],
    *,
    instruction_files: Sequence[str | Path] = (),
    sites_folder: str | Path | None = None,
    sail_folder: str | Path | None = None,
    exclude_dev: bool = False,
) -> Sources:
    """Read runs with the instructions and plans that they name.

    Args:
        folders: Run folders, at least one.
        instruction_files: Where instructions are looked for besides the shipped ones;
            a file belongs to a run when its fingerprint stands in `run.json`.
        sites_folder: Plans of the runs' sites; None for the shipped ones.
        sail_folder: The SAIL corpus, for runs on it; it has sites and instructions.
        exclude_dev: Whether to leave out instructions that prompts may be built from.

    Raises:
        RunFolderError: A folder is no run, or has no result to show.
        SettingsError: A file belongs to no run, a site has no plan or another one.
        MemoryMazeError: A file cannot be used.
    """
    _check_names(folders)
    runs = tuple(
        ReportRun(_letter(number), Path(folder), measured)
        for number, (folder, measured) in enumerate(
            zip(folders, load_runs(folders, exclude_dev=exclude_dev), strict=True)
        )
    )
    if sail_folder is not None:
        corpus = load_corpus(sail_folder)
        known = {each.instruction.id: each.instruction for each in corpus.episodes}
        missing = []
        sites, changed = _sites(runs, corpus.sites)
    else:
        known, missing = _instructions(runs, instruction_files)
        sites, changed = _sites(runs, load_sites(sites_folder))
    return Sources(runs, sites, known, (*missing, *changed))


def _check_names(folders: Sequence[str | Path]) -> None:
    places = [Path(folder).resolve() for folder in folders]
    for place in places:
        if places.count(place) > 1:
            raise SettingsError(f"{place}: expected every run once, got it twice")


def _letter(number: int) -> str:
    letters = string.ascii_uppercase
    after, first = divmod(number, len(letters))
    return letters[first] if after == 0 else f"{letters[first]}{after + 1}"


def _instructions(
    runs: Sequence[ReportRun], files: Sequence[str | Path]
) -> tuple[dict[str, Instruction], list[str]]:
    wanted = _stamps(runs, "instructions")
    by_content: dict[str, Path] = {}
    for file in (BUILTIN_CORPUS, *map(Path, files)):
        try:
            stamp = stamp_file(file)
        except OSError as error:
            raise SettingsError(
                f"--instructions {file}: cannot be read ({error.strerror})"
            ) from None
        if file is not BUILTIN_CORPUS and stamp.sha256 not in wanted:
            raise SettingsError(
                f"--instructions {file}: expected a file that a run followed ("
                f"{', '.join(sorted(each.name for each in wanted.values()))}), got one "
                "with another content"
            )
        by_content.setdefault(stamp.sha256, file)
    found = [by_content[content] for content in wanted if content in by_content]
    missing = [
        f"Instruction file {stamp.name} ({stamp.sha256[:12]}) was not found, so nothing "
        "is known of errors in its instructions; name it with --instructions."
        for content, stamp in wanted.items()
        if content not in by_content
    ]
    read = load_instructions(found) if found else []
    return {each.id: each for each in read}, missing


def _sites(
    runs: Sequence[ReportRun], there: Mapping[str, Site]
) -> tuple[dict[str, Site], list[str]]:
    names = {each.site for run in runs for each in run.measured.results}
    for name in sorted(names - there.keys()):
        raise SettingsError(
            f"site {name}: expected its plan among {', '.join(there)}; name the folder "
            "with the plans of the runs with --sites, or that of SAIL with --sail"
        )
    routes = {
        (each.site, each.reference_route): each
        for run in runs
        for each in run.measured.results
    }
    for (site, route), result in routes.items():
        if route not in {each.id for each in there[site].routes}:
            raise SettingsError(
                f"site {site}: episode {result.episode_id!r} follows {route!r}, which "
                "its plan does not have; name the folder with the plans of the runs "
                "with --sites"
            )
    stamps = {stamp.name: stamp for stamp in _stamps(runs, "sites").values()}
    changed = [
        f"The plan of {name} is not the one that the runs were made on."
        for name in sorted(names & stamps.keys())
        if stamp_file(there[name].source).sha256 != stamps[name].sha256
    ]
    return {name: site for name, site in there.items() if name in names}, changed


def _stamps(runs: Sequence[ReportRun], field: str) -> Mapping[str, FileStamp]:
    return {
        stamp.sha256: stamp
        for run in runs
        for stamp in getattr(run.measured.record.settings, field)
    }
