"""Suites: several runs into one folder, and tables of them, as a TOML file says.

    tables = ["II", "compare"]          # `compare`: each run beside the first

    [defaults]                          # of all runs that do not say otherwise
    instructions = {answered_in = "recorded/programs.jsonl"}
    limit = 60

    [[runs]]
    name = "guide_plans"                # its folder: letters, digits, _ and -
    agent = "guide"
    set = {reader = "model"}            # options of the agent
    replay = "recorded/plans.jsonl"     # and any setting by its name

    [absent]                            # rows for methods without a run
    navid = "memorymaze evaluate --agent navid --model NAME"

Files are seen from the folder of the suite. Settings of a language model reach the runs whose
agents ask one. `answered_in` names a file of answers: the shipped texts that it is about.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from memorymaze.basics.durable_files import write_whole
from memorymaze.basics.errors import (
    AnswerFileError,
    MemoryMazeError,
    SettingsError,
    did_you_mean,
)
from memorymaze.basics.input_files import (
    field_place,
    field_problem,
    parse_record,
    read_lines,
    read_toml,
)
from memorymaze.basics.options import as_given
from memorymaze.basics.tables import Table
from memorymaze.front.library.runs import evaluate
from memorymaze.runs.episodes.agent_catalogue import choose_agent
from memorymaze.runs.episodes.named_settings import (
    GivenSetting,
    given_in_file,
    model_settings,
    run_settings,
)
from memorymaze.runs.episodes.plan import RunPlan, settings_for
from memorymaze.runs.episodes.sampling import sample
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.tables import (
    COMPARISON,
    OVERVIEW,
    TABLES,
    MeasuredRun,
    paired_table,
    run_tables,
)
from memorymaze.runs.work.worker_pool import Workforce
from memorymaze.texts.corpus import Corpus, load_corpus

COMPARE = "compare"
_FILES = {"replay", "record"}


class _AnsweredIn(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid", frozen=True)

    answered_in: str


class _Defaults(BaseModel):
    """What a run may say; members that are not here are settings."""

    model_config = ConfigDict(strict=True, extra="allow", frozen=True)

    set: dict[str, str | bool | int | float] = {}
    instructions: str | list[str] | _AnsweredIn | None = None
    sites: str | None = None


def _name_of_folder(name: str) -> str:
    if re.fullmatch(r"[\w-]+", name) is None:
        raise ValueError("expected letters, digits, _ and -")
    return name


class _RunEntry(_Defaults):
    name: Annotated[str, AfterValidator(_name_of_folder)]
    agent: str


class _SuiteFile(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid", frozen=True)

    tables: list[str] = ["II"]
    defaults: _Defaults = _Defaults()
    runs: Annotated[list[_RunEntry], Field(min_length=1)]
    absent: dict[str, str] = {}


@dataclass(frozen=True, slots=True)
class RunOfSuite:
    """One run as a suite has it, with what it takes from the defaults."""

    name: str
    agent: str
    options: tuple[tuple[str, str], ...]
    instructions: tuple[str, ...] | None
    """Files; None for the shipped ones."""
    answered_in: Path | None
    sites: str | None
    given: tuple[GivenSetting, ...]


@dataclass(frozen=True, slots=True)
class Suite:
    """Runs, and what is shown of them."""

    runs: tuple[RunOfSuite, ...]
    tables: tuple[str, ...]
    absent: dict[str, str]

    def tables_of(self, runs: Sequence[MeasuredRun], name: str) -> list[Table]:
        """Return one of its tables, of finished runs."""
        if name != COMPARE:
            return run_tables(runs, name, self.absent)
        if len(runs) < 2:
            raise SettingsError(f"expected two runs or more, got {len(runs)}")
        return [paired_table(runs, COMPARISON if len(runs) == 2 else OVERVIEW)]


def read_suite(path: str | Path) -> Suite:
    """Read a suite; SettingsError lists what is wrong, each with its line."""
    path = Path(path)
    fields = _SuiteFile.model_fields
    text, read = read_toml(path, _SuiteFile, SettingsError, fields)
    known = [COMPARE, "both", *TABLES]
    for name in read.tables:
        if name not in known:
            said = (
                f"expected {', '.join(known)}; got {name!r}{did_you_mean(name, known)}"
            )
            raise SettingsError(field_problem(path, text, "tables", said))
    names = [run.name for run in read.runs]
    for number, name in enumerate(names):
        if name in names[:number]:
            said = f"expected names that differ, got {name!r} again"
            raise SettingsError(field_problem(path, text, f"runs[{number}].name", said))
    shared = _given(path, text, "defaults", read.defaults)
    runs = [
        _run_of_suite(path, run, read.defaults, [*shared, *own])
        for number, run in enumerate(read.runs)
        for own in [_given(path, text, f"runs[{number}]", run)]
    ]
    return Suite(tuple(runs), tuple(read.tables), read.absent)


def _given(path: Path, text: str, table: str, part: _Defaults) -> list[GivenSetting]:
    """Return the settings of a table of the file, read once so that all can be."""
    settings: list[GivenSetting] = []
    for name, value in (part.model_extra or {}).items():
        place = field_place(path, text, f"{table}.{name}")
        if name in _FILES and isinstance(value, str):
            value = str(path.parent / value)
        setting = given_in_file(name, value, place)
        setting.read()
        settings.append(setting)
    return settings


def _run_of_suite(
    path: Path, run: _RunEntry, defaults: _Defaults, given: list[GivenSetting]
) -> RunOfSuite:
    texts = run.instructions or defaults.instructions
    sites = run.sites or defaults.sites
    file, colon, name = run.agent.rpartition(":")
    agent = f"{path.parent / file}:{name}" if file.endswith(".py") else run.agent
    answered_in, files = None, None
    match texts:
        case _AnsweredIn(answered_in=answers):
            answered_in = path.parent / answers
        case str():
            files = (str(path.parent / texts),)
        case [*several]:
            files = tuple(str(path.parent / each) for each in several)
        case _:
            pass
    return RunOfSuite(
        run.name,
        agent if colon else run.agent,
        tuple((k, as_given(v)) for k, v in {**defaults.set, **run.set}.items()),
        files,
        answered_in,
        None if sites is None else str(path.parent / sites),
        tuple(given),
    )


def run_suite(
    suite: Suite,
    out: Path,
    *,
    given: Sequence[GivenSetting] = (),
    workers: int | Workforce = 0,
    resume: bool = False,
    on_plan: Callable[[RunPlan, Path], None] | None = None,
) -> dict[str, MemoryMazeError]:
    """Do all runs of a suite, each into its folder; return why some failed, by their names.

    Settings that are given win over those of the suite. The texts of all are read first: a
    limit takes those that all follow before others, so that runs can be compared.

    Raises:
        MemoryMazeError: Texts, sites or settings cannot be used.
    """
    corpora = [_corpus_of(run, out) for run in suite.runs]
    settings = [
        run_settings(settings_for(corpus), [*run.given, *given])
        for run, corpus in zip(suite.runs, corpora, strict=True)
    ]
    samples = _sampled_alike(corpora, settings)
    failed: dict[str, MemoryMazeError] = {}
    for run, corpus, how in zip(suite.runs, samples, settings, strict=True):
        try:
            agent = AgentSettings(run.agent, run.options)
            asks = choose_agent(agent).takes_model
            evaluate(
                agent,
                corpus,
                out=out / run.name,
                settings=how,
                language_model=model_settings([*run.given, *given] if asks else ()),
                workers=workers,
                resume=resume,
                on_plan=on_plan,
            )
        except MemoryMazeError as error:
            failed[run.name] = error
    return failed


def _corpus_of(run: RunOfSuite, out: Path) -> Corpus:
    files: Any = run.instructions
    if run.answered_in is not None:
        files = _texts_answered_in(run.answered_in, out)
    return load_corpus(files, sites=run.sites)


def _sampled_alike(
    corpora: Sequence[Corpus], settings: Sequence[RunSettings]
) -> list[Corpus]:
    """Return what limits leave of corpora, of each first what is in all of them.

    Samples that are each spread over another corpus may have no text in common.
    """
    followed = [
        corpus.of_split(how.split)
        for corpus, how in zip(corpora, settings, strict=True)
    ]
    shared = set.intersection(*({each.id for each in some} for some in followed))
    samples: list[Corpus] = []
    for corpus, episodes, how in zip(corpora, followed, settings, strict=True):
        # Those that are told twice are paired before a limit is kept.
        if how.limit is not None and not how.second_telling:
            chosen = sample([each for each in episodes if each.id in shared], how.limit)
            if len(chosen) < how.limit:
                others = [each for each in episodes if each.id not in shared]
                chosen += sample(others, how.limit - len(chosen))
            corpus = replace(corpus, episodes=tuple(chosen))
        samples.append(corpus)
    return samples


def _texts_answered_in(answers: Path, out: Path) -> Path:
    """Write the lines of the shipped texts that a file of answers is about."""
    wanted: set[object] = set()
    for place, line in read_lines(answers, AnswerFileError):
        try:
            wanted.add(parse_record(line).get("instruction_id"))
        except ValueError as error:
            raise AnswerFileError(f"{place}: {error}") from None
    chosen = [
        line
        for file in load_corpus().files
        for line in file.read_text(encoding="utf-8").splitlines()
        if parse_record(line)["id"] in wanted
    ]
    path = out / f"texts-{answers.stem}.jsonl"
    out.mkdir(parents=True, exist_ok=True)
    write_whole(path, "".join(f"{line}\n" for line in chosen).encode())
    return path
