"""What a run consists of: which agent follows which instructions where, and how."""

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path

from memorymaze.agents.agent import Need, asking_of
from memorymaze.basics.errors import AnswerFileError
from memorymaze.basics.input_files import FileStamp, stamp_file
from memorymaze.basics.own_code import own_fingerprint
from memorymaze.language.models.building import replaying_model
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.runs.episodes.agent_catalogue import (
    AgentChoice,
    ChosenAgent,
    ReadyAgent,
    choose_agent,
)
from memorymaze.runs.episodes.arena import checked_eyes, looks_of_run
from memorymaze.runs.episodes.bodies import find_body
from memorymaze.runs.episodes.budgets import time_budget_for
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.people_to_ask import check_people
from memorymaze.runs.episodes.sampling import sample
from memorymaze.runs.episodes.second_tellings import (
    texts_told_once,
    with_second_tellings,
)
from memorymaze.runs.episodes.settings import (
    AgentSettings,
    AnswersTaken,
    RunDefinition,
    RunSettings,
)
from memorymaze.runs.episodes.shards import episodes_of_shard
from memorymaze.texts.corpus import Corpus, load_corpus
from memorymaze.texts.corpus.records import Episode
from memorymaze.world.looks import file_of_looks
from memorymaze.world.sites import Site
from memorymaze.world.sites.plan import plan_bytes


@dataclass(frozen=True, slots=True)
class RunPlan:
    """A run's definition, with all that it names loaded and made."""

    settings: RunDefinition
    episodes: tuple[Episode, ...]
    sites: dict[str, Site]
    """Those the episodes are on."""
    agent: ChosenAgent
    ready: ReadyAgent
    """The agent as it was made when the run was planned."""
    kept_from: tuple[Path, ...]
    """What an isolated agent may not read: the files of the corpus and of its buildings,
    and the run's folder once there is one."""


def plan_run(
    agent: AgentChoice,
    corpus: Corpus | None = None,
    settings: RunSettings | None = None,
    language_model: ModelSettings | None = None,
) -> RunPlan:
    """Check everything a run needs, before anything is written.

    Without a corpus, the shipped texts are followed; without settings, those that belong to
    the corpus hold. The language model may be among the agent's settings as well.
    """
    if corpus is None:
        corpus = load_corpus()
    settings = settings or settings_for(corpus)
    settings.check_budget(corpus.time_budget)
    checked_eyes(settings)
    body = find_body(settings.robot)
    chosen_agent = choose_agent(agent, language_model)
    if not corpus.start_heading_is_told:
        chosen_agent = chosen_agent.with_defaults(start_heading="unknown")
    check_people(settings, chosen_agent)
    plans = [Path(site.source) for site in corpus.sites.values() if site.source]
    # Absolute, because workers may be in another folder.
    kept_from = tuple(path.absolute() for path in (*corpus.files, *plans))
    ready = chosen_agent.make(isolate=settings.isolate, kept_from=kept_from)
    followed, told_once = corpus.of_split(settings.split), 0
    if settings.second_telling:
        paired = with_second_tellings(corpus).of_split(settings.split)
        followed, told_once = paired, texts_told_once(followed, paired)
    chosen = sample(followed, settings.limit)
    names = dict.fromkeys(episode.instruction.site for episode in chosen)
    sites = {name: corpus.sites[name] for name in names}
    definition = define_run(
        chosen_agent.settings,
        settings,
        chosen_agent.needs,
        sites.values(),
    )
    looks = file_of_looks(definition.looks)
    part = tuple(episodes_of_shard(chosen, settings.shard))
    definition = replace(
        definition,
        instructions=tuple(stamp_file(path) for path in corpus.files),
        sites=tuple(map(stamp_site, sites.values())),
        episodes=len(part),
        told_once=told_once,
        answers=_answers_taken(chosen_agent, ready, chosen),
        agent_files=chosen_agent.files(),
        robot_files=() if body is None else body.files(),
        detector_files=own_fingerprint(settings.detector.name),
        looks_files=() if looks is None else (stamp_file(looks),),
        option_values=chosen_agent.option_values(ready.agent),
    )
    return RunPlan(definition, part, sites, chosen_agent, ready, kept_from)


def stamp_site(site: Site) -> FileStamp:
    """Return the fingerprint of a building: of its file, or of the plan of a made one."""
    if site.source:
        return stamp_file(site.source, site.name)
    return FileStamp(site.name, hashlib.sha256(plan_bytes(site)).hexdigest())


def define_run(
    agent: AgentSettings,
    settings: RunSettings,
    needs: frozenset[Need],
    sites: Iterable[Site],
) -> RunDefinition:
    """Settle what settings leave open: the time budget, and what cameras show.

    It is that of a single episode, of which no file says anything.
    """
    budget = settings.time_budget
    if budget is None:
        routes = [route for site in sites for route in site.routes]
        budget = time_budget_for(needs, routes, settings.simulation)
    chosen = {each.name: getattr(settings, each.name) for each in fields(RunSettings)}
    chosen["simulation"] = replace(settings.simulation, time_budget=budget)
    drawn = settings.robot is None
    chosen["looks"] = looks_of_run(agent, needs, settings) if drawn else None
    return RunDefinition(
        **chosen,
        agent=agent,
        needs=tuple(sorted(needs)),
        instructions=(),
        sites=(),
        episodes=1,
    )


def settings_for(corpus: Corpus) -> RunSettings:
    """Return the settings that belong to a corpus; the defaults where it leaves them."""
    limits = ("success_distance", "time_budget", "detection_range")
    given = {name: getattr(corpus, name) for name in limits}
    return with_choices(
        RunSettings(), {name: each for name, each in given.items() if each is not None}
    )


def _answers_taken(
    agent: ChosenAgent, ready: ReadyAgent, episodes: Sequence[Episode]
) -> AnswersTaken | None:
    """Say which answers a run takes; None where it asks a model."""
    settings = agent.settings.language_model
    model = replaying_model(settings)
    file = settings.replay
    if model is None or file is None:
        return None
    versions = model.versions()
    # Whom a robot will ask on the way, and so what a model in role says, nobody knows.
    asking = episodes if agent.takes_model else ()
    wanted = list(dict.fromkeys(each.instruction.id for each in asking))
    known = {instruction for instruction, _ in versions}
    missing = [each for each in wanted if versions and each not in known]
    if missing and model.file.is_by_hand:
        raise AnswerFileError(
            f"{file}: expected an answer for each of {len(wanted)} "
            f"instructions, got none for {len(missing)}: "
            f"{', '.join(missing[:10])}{', …' if len(missing) > 10 else ''}; for one "
            "that the model failed on write a record with `error`"
        )
    prompts = asking_of(ready.agent, episodes[0].instruction.text).prompts
    other = unknown = 0
    for each in wanted:
        answered = [
            (versions.get((each, stage)) or versions.get((each, plain), set()), prompt)
            for stage, prompt in prompts.items()
            for plain in [stage.partition("+")[0]]
        ]
        differing = [
            found for found, prompt in answered if found and prompt not in found
        ]
        unknown += any(None in found for found in differing)
        other += bool(differing) and not any(None in found for found in differing)
    stamp = stamp_file(file)
    return AnswersTaken(stamp.name, stamp.sha256, len(missing), other, unknown)
