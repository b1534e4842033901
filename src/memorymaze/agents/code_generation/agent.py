"""The agent: asks for steps and a program, and runs the program.

All requests come before the robot moves, unless a program that fails may be mended.
"""

from collections.abc import Callable, Collection
from dataclasses import fields, is_dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, cast

import numpy as np

from memorymaze.agents.agent import (
    Asking,
    FairLimits,
    Journal,
    Need,
    prompt_versions,
    tellings_of,
)
from memorymaze.agents.code_generation.replies import read_program, read_steps
from memorymaze.agents.code_generation.requests import (
    CodeGenerationOptions,
    CodeGenerationRequests,
)
from memorymaze.agents.code_generation.sandbox import run_program
from memorymaze.agents.notes import ProgramNote, ProgramRepairNote, StepsNote
from memorymaze.basics.errors import InterpreterLostError, ProgramError
from memorymaze.language.models.model import (
    CompletionRequest,
    LanguageModel,
    stages_answered,
)
from memorymaze.language.models.prompt_texts import numbered
from memorymaze.robot.api.asking import can_ask
from memorymaze.robot.api.control import Robot
from memorymaze.robot.api.specification import API_NAMES, ASKING_NAMES

MOST_CALLS_TOLD = 200
"""Of what a failed program did, the model is told this many calls at most."""


class CodeGenerationAgent:
    """Follows an instruction by a program that a language model writes from it.

    Each request uses the paper's two-stage prompting, in one reply: a thought, a first
    output, a second thought on it, and the refined output, which is what counts.
    """

    Options = CodeGenerationOptions
    needs: ClassVar[frozenset[Need]] = frozenset({"language_model"})

    def __init__(self, options: CodeGenerationOptions, model: LanguageModel) -> None:
        """Prepare the agent; recorded answers may settle whether it parses first."""
        if options.parser is None:
            options = replace(options, parser=_parses_first(stages_answered(model)))
        self.options = options
        """What was set, and settled."""
        self._model = model
        self._requests = CodeGenerationRequests(options)

    @property
    def name(self) -> str:
        """`code_generation[model]`, with `+parser` when instructions are parsed, …."""
        return f"code_generation[{self._model.name}]{self._requests.variant}"

    def asking(self, instruction: str, limits: FairLimits | None) -> Asking:
        """Tell what it will ask, with the instruction, told once, in the place of steps."""
        requests = self._requests
        asked: list[CompletionRequest] = []
        if requests.parser:
            asked = [requests.parse(instruction)]
            instruction = tellings_of(instruction)[-1]
        asked += [requests.program(instruction)] * (1 + self.options.repair)
        return Asking(prompt_versions(asked), not self.options.repair, asked)

    @cached_property
    def _with_people(self) -> CodeGenerationRequests:
        """What it asks in the track with people one can ask."""
        return CodeGenerationRequests(self.options, with_people=True)

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Have a program written for an instruction and run it.

        Notes in the journal: `model_reply` for each request, `steps`, `program`,
        `repair`, and what the sandbox tells of the program's run.
        """
        requests = self._with_people if can_ask(robot) else self._requests
        way = instruction
        if requests.parser:
            reply = journal.ask(self._model, requests.parse(instruction), "parse")
            steps = read_steps(reply)
            journal.add(StepsNote(steps))
            way = numbered(steps)
        reply = journal.ask(self._model, requests.program(way), "program")
        if not requests.options.repair:
            self._run(reply, robot, journal)
            return
        witness = _Witness(robot)
        try:
            self._run(reply, cast(Robot, witness), journal)
        except ProgramError as error:
            # What reaches outside gets no second chance, and a lost process says
            # nothing about the program.
            if error.unsafe or isinstance(error, InterpreterLostError):
                raise
            journal.add(ProgramRepairNote(str(error), len(witness.done)))
            asked = requests.repair(way, reply, str(error), witness.told())
            reply = journal.ask(self._model, asked, "repair")
            self._run(reply, robot, journal)

    def _run(self, reply: str, robot: Robot, journal: Journal) -> None:
        program = read_program(reply)
        journal.add(ProgramNote(program))
        run_program(
            program,
            robot,
            on_event=lambda event: journal.note(event.pop("kind"), **event),
        )


def _parses_first(answered: Collection[str]) -> bool:
    """Tell whether instructions are parsed, by the stages that there are answers to."""
    return "parse" in answered or "program" not in answered


class _Witness:
    """A robot that remembers the calls of its control API."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.done: list[str] = []

    def __getattr__(self, name: str) -> Any:
        method: Callable[..., Any] = getattr(self._robot, name)
        if name not in (*API_NAMES, *ASKING_NAMES):
            return method

        def call(*args: Any, **kwargs: Any) -> Any:
            result = method(*args, **kwargs)
            given = ", ".join(map(_brief, (*args, *kwargs.values())))
            self.done.append(f"{name}({given}) -> {_brief(result)}")
            return result

        return call

    def told(self) -> list[str]:
        """Return the calls; of very many the last, and how many came before them."""
        left_out = len(self.done) - MOST_CALLS_TOLD
        if left_out <= 0:
            return self.done
        return [f"… {left_out} earlier calls …", *self.done[-MOST_CALLS_TOLD:]]


def _brief(value: object) -> str:
    """Write a value as Python does, numbers to the centimetre."""
    if isinstance(value, float):
        return f"{value:.2f}"
    if isinstance(value, list):
        return f"[{', '.join(map(_brief, cast(list[object], value)))}]"
    if is_dataclass(value):
        shown = [f"{f.name}={_brief(getattr(value, f.name))}" for f in fields(value)]
        return f"{type(value).__name__}({', '.join(shown)})"
    return repr(value)
