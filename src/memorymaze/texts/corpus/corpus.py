"""What agents are evaluated on: texts made into episodes on their sites."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from memorymaze.basics.errors import InstructionFileError, SettingsError, did_you_mean
from memorymaze.basics.input_files import refusal
from memorymaze.basics.options import check_kind
from memorymaze.texts.corpus.files import (
    BUILTIN_CORPUS,
    TEXT_ENDINGS,
    Findings,
    load_instructions,
    placed,
    repeated_ids,
)
from memorymaze.texts.corpus.record_format import tidied
from memorymaze.texts.corpus.records import Corpus, Episode, Instruction
from memorymaze.texts.corpus.sail import is_sail_folder, sail_corpus
from memorymaze.world.sites import Route, Site, load_sites


def load_corpus(
    source: str | Path | Sequence[str | Path] | None = None,
    *,
    sites: str | Path | Iterable[Site] | None = None,
) -> Corpus:
    """Load what agents are evaluated on.

    Args:
        source: Instruction files (JSONL, CSV, Parquet), one or several; or a folder: of the SAIL
            corpus, or with plans and instruction files of your own; None for the
            shipped texts.
        sites: A folder of site plans, or sites; None for the shipped ones. A folder
            has its own.

    Raises:
        InstructionFileError: A file cannot be used; names file and line.
        SitePlanError: A plan cannot be used.
        SettingsError: The source is none of these, or sites are given for a folder that
            has its own.
    """
    if (
        isinstance(source, Sequence)
        and not isinstance(source, str)
        and len(source) == 1
    ):
        [source] = source
    wanted = "instruction files, a folder, or None for the shipped texts"
    check_kind("corpus", source, str | Path | Sequence | None, wanted)
    if source is None:
        name, files = "memorymaze", [BUILTIN_CORPUS]
    elif isinstance(source, str | Path) and Path(source).is_dir():
        folder = Path(source)
        if sites is not None:
            raise SettingsError(
                f"{folder}: a folder has its own instructions and sites; leave out the "
                "sites"
            )
        if is_sail_folder(folder):
            return sail_corpus(folder)
        name, sites = folder.name, folder
        files = sorted(f for f in folder.iterdir() if f.suffix.lower() in TEXT_ENDINGS)
        if not files or not any(folder.glob("*.geojson")):
            raise InstructionFileError(
                f"{folder}: expected a folder of the SAIL corpus (docs/texts.md), or one "
                "with site plans (*.geojson) and instruction files "
                f"({', '.join(f'*{ending}' for ending in TEXT_ENDINGS)}), got none of the "
                f"{'plans' if files else 'files'}; instruction files on other sites are "
                "listed one by one"
            )
    else:
        files = [source] if isinstance(source, str | Path) else list(source)
        name = ", ".join(Path(file).name for file in files)
    if sites is None or isinstance(sites, str | Path):
        known = load_sites(sites)
    else:
        known = {site.name: site for site in sites}
    told = load_instructions(files)
    needed = {each.site for each in told}
    if source is None and not needed <= known.keys():
        names = ", ".join(sorted(needed))
        raise SettingsError(
            f"sites: the shipped instructions are of {names}, which are not all there; "
            "name the instructions of your buildings as well (--instructions FILE)"
        )
    read = episodes(told, known)
    return Corpus(
        name,
        tuple(read),
        known,
        tuple(map(Path, files)),
        was_half_read=list(map(Path, files)) == [BUILTIN_CORPUS],
    )


def episodes(
    instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> list[Episode]:
    """Turn instructions into episodes, in order.

    An episode starts where its reference route starts and its goal is that route's
    last point; its id is the instruction's. What an instruction leaves out (its id,
    the way it describes) is filled in.

    Args:
        instructions: What to follow.
        sites: Sites by name.

    Raises:
        InstructionFileError: A site or route does not exist, or an id repeats.
    """
    chosen = [_completed(each, number) for number, each in enumerate(instructions, 1)]
    problems = placed(repeated_ids(chosen), site_problems(chosen, sites))
    if problems:
        raise refusal(problems, InstructionFileError)
    return [_episode(instruction, sites) for instruction in chosen]


def _completed(each: Instruction, number: int) -> Instruction:
    """Name an instruction that was made in memory without a name."""
    name = each.id or f"instruction-{number}"
    if each.id and each.participant:
        return each
    return tidied(replace(each, id=name, participant=each.participant or name))


def site_problems(
    instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> Findings:
    """Yield the instructions whose site or route does not exist."""
    for each in instructions:
        message = _misplaced(each, sites)
        if message is not None:
            yield each, message


def _episode(instruction: Instruction, sites: Mapping[str, Site]) -> Episode:
    route = _way_of(instruction, sites[instruction.site])
    instruction = replace(instruction, reference_route=route.id)
    path = tuple((float(x), float(y)) for x, y, *_ in route.line.coords)
    return Episode(instruction.id, instruction, route.start, path[-1], path)


def _way_of(instruction: Instruction, site: Site) -> Route:
    """Return the way that an instruction describes; both exist."""
    if instruction.reference_route:
        return site.find_route(instruction.reference_route)
    return site.find_route(instruction.route)


def _misplaced(instruction: Instruction, sites: Mapping[str, Site]) -> str | None:
    site = sites.get(instruction.site)
    if site is None:
        return _not_found("site", instruction.site, sites)
    routes = {route.id: route for route in site.routes}
    names = {route.route for route in site.routes}
    if instruction.route not in names:
        return _not_found("route", instruction.route, names)
    if not instruction.reference_route:
        return None
    route = routes.get(instruction.reference_route)
    if route is None:
        return _not_found("reference_route", instruction.reference_route, routes)
    if route.route != instruction.route:
        fitting = sorted(r.id for r in site.routes if r.route == instruction.route)
        return (
            f"field 'reference_route': expected a way of {instruction.route} "
            f"({', '.join(fitting)}), got {route.id!r}, a way of {route.route}"
        )
    return None


def _not_found(field: str, got: str, known: Iterable[str]) -> str:
    names = sorted(known)
    return (
        f"field {field!r}: expected one of {', '.join(names)}, got {got!r}"
        f"{did_you_mean(got, names)}"
    )
