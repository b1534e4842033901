"""The paper's agent: a language model writes one program, and the robot runs it.

Two requests at most, both before the robot moves: one turns the description into
numbered steps (left out without the parser), one turns them into a program.
"""

from dataclasses import dataclass

import numpy as np

from memorymaze.agents.agent import Journal
from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    Message,
)
from memorymaze.language.prompt_texts import load_prompt
from memorymaze.language.reply_reading import read_program, read_steps
from memorymaze.language.sandbox import DEFAULT_LIMITS, ProgramLimits, run_program
from memorymaze.robot.api import Robot
from memorymaze.robot.specification import api_specification

__all__ = ["CodeGenerationAgent", "CodeGenerationOptions"]


@dataclass(frozen=True, slots=True)
class CodeGenerationOptions:
    """How the language model is asked."""

    temperature: float = 0.0
    """Of all requests."""
    max_tokens: int = 4096
    """Longest reply to a request, all its parts together."""
    seed: int | None = None
    """Passed to the model; none sends no seed."""


class CodeGenerationAgent:
    """Follows an instruction by a program that a language model writes from it.

    Each request uses the paper's two-stage prompting, in one reply: a thought, a first
    output, a second thought on it, and the refined output, which is what counts.
    """

    def __init__(
        self,
        model: LanguageModel,
        *,
        parser: bool = True,
        options: CodeGenerationOptions | None = None,
        limits: ProgramLimits = DEFAULT_LIMITS,
    ) -> None:
        """Prepare the agent.

        Args:
            model: Writes the steps and the program.
            parser: Whether instructions are parsed into steps first.
            options: How the model is asked; None for the defaults.
            limits: How much a program may use.
        """
        self._model = model
        self._parser = parser
        self._limits = limits
        self._options = options or CodeGenerationOptions()
        self._parsing_prompt = load_prompt("parse_instruction")
        self._program_prompt = load_prompt(
            "write_program", api_specification=api_specification().strip()
        )

    @property
    def name(self) -> str:
        """`code_generation[model]`, with `+parser` when instructions are parsed."""
        return f"code_generation[{self._model.name}]" + "+parser" * self._parser

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Have a program written for an instruction and run it.

        Notes in the journal: `model_reply` for each request, `steps`, `program`, and
        what the sandbox tells of its run.

        Raises:
            LanguageModelError: The model did not answer, or not with what was asked.
            ProgramError: The program is wrong, failed, or reached outside the API.
            EpisodeOver: The program or a budget ended the episode.
        """
        way = instruction
        if self._parser:
            reply = self._ask(
                "parse", self._parsing_prompt, f"Description:\n{_quote(way)}", journal
            )
            steps = read_steps(reply)
            journal.note("steps", steps=steps)
            way = "\n".join(f"{number}. {step}" for number, step in enumerate(steps, 1))
        reply = self._ask(
            "program", self._program_prompt, f"Way:\n{_quote(way)}", journal
        )
        program = read_program(reply)
        journal.note("program", program=program)
        run_program(program, robot, self._limits, lambda event: journal.note(**event))

    def _ask(self, stage: str, prompt: str, task: str, journal: Journal) -> str:
        request = CompletionRequest(
            messages=(Message("system", prompt), Message("user", task)),
            temperature=self._options.temperature,
            max_tokens=self._options.max_tokens,
            seed=self._options.seed,
        )
        journal.model_calls += 1
        completion = self._model.complete(request)
        _count(completion, journal)
        journal.note(
            "model_reply",
            stage=stage,
            model=completion.model,
            text=completion.text,
            prompt_tokens=completion.usage.prompt_tokens,
            completion_tokens=completion.usage.completion_tokens,
            cost_usd=completion.usage.cost_usd,
            latency=completion.latency,
        )
        return completion.text


def _count(completion: Completion, journal: Journal) -> None:
    usage = completion.usage
    journal.tokens += usage.prompt_tokens + usage.completion_tokens
    journal.cost_usd += usage.cost_usd or 0.0


def _quote(text: str) -> str:
    return f'"""\n{text.strip()}\n"""'
