"""Make instructions as a request says, by the grammar or a language model."""

from collections.abc import Iterator
from dataclasses import dataclass

from memorymaze.basics.errors import LanguageModelError, SettingsError
from memorymaze.language.models.model import LanguageModel
from memorymaze.texts.corpus.corpus import episodes
from memorymaze.texts.corpus.files import load_instructions
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.writing.editing import with_errors
from memorymaze.texts.writing.grammar import write_texts
from memorymaze.texts.writing.model_engine import written_by_model
from memorymaze.texts.writing.request import PER_CELL, GenerationRequest
from memorymaze.texts.writing.sampling import Outline, cells_of, sample_outlines
from memorymaze.world.sites import Site, load_sites


@dataclass(frozen=True, slots=True)
class Made:
    """What came of a request."""

    instructions: tuple[Instruction, ...]
    problems: tuple[str, ...]
    """One line for every text that could not be made."""


def make_instructions(
    request: GenerationRequest, model: LanguageModel | None = None
) -> Made:
    """Make instructions.

    Args:
        request: What is wanted.
        model: Writes the texts; None for the grammar.

    Raises:
        SettingsError: There is no such site or route.
        SitePlanError: A plan is not sound, or a route cannot be described.
        InstructionFileError: The files to put errors into cannot be used.
    """
    sites = load_sites(request.sites_folder)
    if request.site is not None and request.site not in sites:
        raise SettingsError(
            f"--site: expected one of {', '.join(sorted(sites))}, got {request.site!r}"
        )
    if request.site is not None:
        sites = {request.site: sites[request.site]}
    if request.instruction_files:
        return _from_files(request, sites, model)
    made: list[Instruction] = []
    problems: list[str] = []
    for outline in _outlines(request, sites):
        if model is None:
            made += write_texts(outline, paired=request.paired)
            continue
        try:
            made += written_by_model(outline, model, paired=request.paired)
        except LanguageModelError as error:
            problems.append(f"{outline.id}: {error}")
    return Made(tuple(made), tuple(problems))


def _outlines(request: GenerationRequest, sites: dict[str, Site]) -> Iterator[Outline]:
    found = False
    for site in sites.values():
        cells = cells_of(
            site,
            route=request.route,
            studies=("online", "onsite") if request.study is None else (request.study,),
            iterations=(1, 2) if request.iteration is None else (request.iteration,),
        )
        for cell in cells:
            found = True
            yield from sample_outlines(
                cell, request.rates, request.per_cell or PER_CELL, request.seed
            )
    if not found:
        routes = {route.route for site in sites.values() for route in site.routes}
        known = ", ".join(sorted(routes)) or "none at all"
        raise SettingsError(
            f"--route: expected a route of {', '.join(sites) or 'the sites'} "
            f"({known}), got {request.route!r}"
        )


def _from_files(
    request: GenerationRequest, sites: dict[str, Site], model: LanguageModel | None
) -> Made:
    if model is not None:
        raise SettingsError(
            "--from: texts are edited or told anew by the grammar; leave out --engine"
        )
    read = load_instructions(request.instruction_files)
    chosen = [
        each
        for each in read
        if request.site in {None, each.site}
        and request.route in {None, each.route}
        and request.study in {None, each.study}
        and request.iteration in {None, each.iteration}
    ]
    chosen = [each.instruction for each in episodes(chosen, sites)]
    made = with_errors(
        chosen, sites, request.rates, request.seed, paired=request.paired
    )
    return Made(tuple(made), ())
