"""Whom the robot of an episode can ask, as the settings say."""

from dataclasses import replace
from statistics import fmean
from typing import Literal

from memorymaze.language.models.answers import AboutInstruction
from memorymaze.runs.episodes.agent_catalogue import ChosenAgent
from memorymaze.runs.episodes.arena import Arena, model_of_people
from memorymaze.runs.episodes.settings import RunDefinition, RunSettings
from memorymaze.texts.corpus.records import Episode, Instruction
from memorymaze.texts.passers_by import (
    Meet,
    Memory,
    ModelInRole,
    load_bank,
)
from memorymaze.texts.writing.request import cell_rates


def check_people(settings: RunSettings, agent: ChosenAgent) -> None:
    """Refuse a language model that nobody asks."""
    if model_of_people(settings, agent.settings) is None:
        agent.refuse_unused_model()


def people_of_episode(
    arena: Arena,
    episode: Episode,
    settings: RunDefinition,
    seed: tuple[int, ...],
) -> Meet:
    """Return who answers in an episode for the people that the robot asks."""
    one = Memory(
        seed,
        arena.floor,
        load_bank(),
        _share_unreliable(episode.instruction),
        settings.success_distance,
    )

    def remembering(person: int, kind: Literal["memory", "wrong", "empty"]) -> Memory:
        return replace(one, seed=(*one.seed, person), kind=kind)

    match settings.passers_by:
        case "model":
            if arena.people_model is None:
                raise ValueError("expected an arena with a model that plays people")
            model = AboutInstruction(arena.people_model, episode.instruction.id)
            return lambda person, question: ModelInRole(
                remembering(person, "memory"), model, question
            )
        case "memory" | "wrong" | "empty" as kind:
            return lambda person, _: remembering(person, kind)


def _share_unreliable(told: Instruction) -> float:
    """Return the share of texts of the route that had an error, told onsite."""
    return fmean(
        cell_rates("onsite", iteration, told.site, told.route, turns=0).failure
        for iteration in (1, 2)
    )
