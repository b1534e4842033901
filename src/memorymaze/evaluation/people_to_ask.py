"""Whom the robot of an episode can ask, as the settings say."""

from collections.abc import Callable
from dataclasses import replace
from statistics import fmean
from typing import Literal

from memorymaze.errors import SettingsError
from memorymaze.evaluation.agent_catalogue import ChosenAgent
from memorymaze.evaluation.arena import Arena
from memorymaze.evaluation.settings import AgentSettings, RunDefinition, RunSettings
from memorymaze.instructions.records import Episode, Instruction
from memorymaze.language.answers import AboutInstruction
from memorymaze.language.building import build_language_model
from memorymaze.language.model import LanguageModel
from memorymaze.passers_by import (
    Briefing,
    Meet,
    Memory,
    ModelInRole,
    PersonAnswering,
    load_bank,
)
from memorymaze.writing.request import cell_rates

PutTo = Callable[[Briefing], str]
"""Has a person answer for those whom the robot asks; nothing for who does not know."""


def check_people(
    settings: RunSettings,
    agent: ChosenAgent,
    put_to: PutTo | None = None,
) -> None:
    """Refuse people who cannot answer, and a language model that nobody asks."""
    if model_of_people(settings, agent.settings) is None:
        agent.refuse_unused_model()
    if (settings.passers_by == "keyboard") == (put_to is not None):
        return
    if put_to is None:
        raise SettingsError(
            "passers_by: 'keyboard' is for one walk that a person looks on at; use "
            "memorymaze navigate in a terminal, or give follow() put_to, a function that "
            "has somebody answer"
        )
    raise SettingsError(
        "put_to: expected with passers_by='keyboard', got it with "
        f"{settings.passers_by!r}, who answer by themselves"
    )


def people_of_episode(
    arena: Arena,
    episode: Episode,
    settings: RunDefinition,
    seed: tuple[int, ...],
    put_to: PutTo | None,
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
        case "keyboard":
            if put_to is None:
                raise ValueError("expected put_to, which has a person answer, got None")
            person = PersonAnswering(arena.floor, put_to)
            return lambda _person, _question: person
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


def model_of_people(
    settings: RunSettings, agent: AgentSettings
) -> LanguageModel | None:
    """Return the model that plays people; None where they answer otherwise.

    Raises:
        SettingsError: No model is named, or it cannot be used.
    """
    if settings.passers_by != "model":
        return None
    return build_language_model(agent.language_model)
