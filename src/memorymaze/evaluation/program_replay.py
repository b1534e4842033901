"""Programs written elsewhere, run as if their model had just written them.

Which program belongs to an episode is known by the id of its instruction; so this stands
here and not among the agents, which see no more than a text.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from memorymaze.agents.agent import Agent, Journal
from memorymaze.errors import LanguageModelError, ProgramFileError, SettingsError
from memorymaze.evaluation.program_files import (
    ProgramFile,
    ProgramRecord,
    load_programs,
    missing_programs,
)
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.instructions.records import Episode
from memorymaze.language.json_lines import some
from memorymaze.language.sandbox import run_program
from memorymaze.language.spending import TokenPrice
from memorymaze.robot.api import Robot


class ProgramReplay:
    """Runs the program of one episode; asks no model.

    Args:
        record: The program; its replies are counted as if they came now.
        price: What replies cost; None for what the record says.
    """

    def __init__(self, record: ProgramRecord, price: TokenPrice | None = None) -> None:
        """Remember the program."""
        self._record = record
        self._price = price

    @property
    def name(self) -> str:
        """As the file says, else `programs[model]`."""
        return self._record.agent

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Count the model's replies, and run the program.

        Raises:
            LanguageModelError: The model had failed to write a program.
            ProgramError: The program is wrong, failed, or reached outside the API.
            EpisodeOver: The program or a budget ended the episode.
        """
        record = self._record
        for number, reply in enumerate(record.replies):
            if number == 1 and record.steps is not None:
                journal.note("steps", steps=list(record.steps))
            completion = reply.completion(record.model)
            if self._price is not None:
                usage = completion.usage
                cost = self._price.cost(usage.prompt_tokens, usage.completion_tokens)
                usage = replace(usage, cost_usd=cost)
                completion = replace(completion, usage=usage)
            journal.count(completion, stage=reply.stage)
        if record.program is None:
            raise LanguageModelError(record.error or "no program was written")
        journal.note("program", program=record.program)
        run_program(record.program, robot, on_event=lambda event: journal.note(**event))


def replayed_programs(
    file: ProgramFile, settings: AgentSettings
) -> Callable[[Episode], Agent]:
    """Return what gives the agent that runs an episode's program.

    Args:
        file: Programs; the agent of an episode that has none raises `KeyError`.
        settings: Of the agent; prices count here.
    """
    price = settings.asking.price
    return lambda episode: ProgramReplay(file.records[episode.instruction.id], price)


def with_programs(settings: AgentSettings) -> tuple[AgentSettings, ProgramFile | None]:
    """Return settings that say what the programs they name say, and these programs.

    Raises:
        SettingsError: The agent runs no programs, or the settings say how a model is to
            be asked.
        ProgramFileError: The file cannot be used.
    """
    if settings.programs is not None and settings.name != "code_generation":
        raise SettingsError(
            f"--programs: the agent {settings.name!r} runs no programs; leave the option "
            "out, or choose --agent code_generation"
        )
    if settings.programs is not None and settings.parser is not None:
        raise SettingsError(
            "--programs and --no-parser: the programs are written already, and their file "
            "says how; leave --no-parser out"
        )
    file = load_agents_programs(settings)
    if file is None:
        return settings, None
    return replace(settings, parser=file.first.parser), file


def load_agents_programs(settings: AgentSettings) -> ProgramFile | None:
    """Read the programs that settings name; None where they name none.

    Raises:
        SettingsError: The settings also say how a model is to be asked.
        ProgramFileError: The file cannot be used.
    """
    if settings.programs is None:
        return None
    for option in ("model", "base_url", "record", "replay"):
        if getattr(settings, option) is not None:
            raise SettingsError(
                f"--programs and --{option.replace('_', '-')}: programs that are written "
                "already need no model; leave one out"
            )
    if settings.options:
        raise SettingsError(
            f"--programs and --set {settings.options[0][0]}: options say how a model is "
            "asked, and the programs are written already; leave one out"
        )
    return load_programs(settings.programs)


def check_programs_for(file: ProgramFile, episodes: Sequence[Episode]) -> None:
    """See to it that every episode has a program.

    Raises:
        ProgramFileError: Some have none; names the first.
    """
    missing = missing_programs(file, [each.instruction.id for each in episodes])
    if missing:
        raise ProgramFileError(
            f"{file.path}: expected a program for each of {len(episodes)} episodes, got "
            f"none for {len(missing)}: {some(missing)}; for an "
            "instruction that the model failed on write a record with `error` in the "
            "place of `program`"
        )
