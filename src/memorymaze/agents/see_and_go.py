"""An agent that sees: it shows a vision-language model the picture, and makes its move.

The whole agent is in this file, as an example to begin with: look, ask, go, until the
model says stop. How replies are read it shares with the NaVid protocol.
"""

import math
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from typing import ClassVar

import numpy as np

from memorymaze.agents.agent import Asking, FairLimits, Journal, Need
from memorymaze.agents.asking import ask_until_read
from memorymaze.agents.navid.motions import Command, Motions, frame_name
from memorymaze.agents.navid.replies import navid_reply_grammar, read_navid_reply
from memorymaze.agents.notes import SaidAndDoneNote
from memorymaze.basics.errors import EpisodeOver, SettingsError
from memorymaze.basics.options import check_least, check_number
from memorymaze.language.models.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    ModelQuestion,
    Picture,
    takes_pictures,
)
from memorymaze.language.models.prompt_texts import load_prompt, prompt_version
from memorymaze.robot.api.steps import SteppingRobot

MOTIONS = Motions(forward_m=0.5, turn_deg=30, most=6)
"""One move: up to 3 m ahead, or a turn on the spot by up to 180 degrees."""
STILL_METRES = 0.01
"""Who gets ahead by less stands still."""


@dataclass(frozen=True, slots=True)
class SeeAndGoOptions:
    """What can be set of the agent."""

    requests: int | None = None
    """Requests in an episode at most; none for as many as the run calls fair: two for
    each 2.25 m of the site's longest route."""
    failures: int = 10
    """Moves in a row that bring the robot not ahead, after which the episode ends as
    `stuck`."""
    memory: int = 10
    """Last moves that the model is told, with what it said."""
    temperature: float = 0.0
    """Of the requests."""
    max_tokens: int = 300
    """Longest reply."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_least(self, requests=1, failures=1, memory=0, max_tokens=1)
        check_number("--set temperature", self.temperature, 0)


class SeeAndGoAgent:
    """Follows an instruction by asking a vision-language model for each next move."""

    Options = SeeAndGoOptions
    needs: ClassVar[frozenset[Need]] = frozenset({"language_model", "camera", "steps"})

    def __init__(self, options: SeeAndGoOptions, model: LanguageModel) -> None:
        """Prepare to ask a model, which must see pictures."""
        if not takes_pictures(model):
            raise SettingsError(
                f"--model {model.name}: models that run here see no pictures; name a "
                "vision model on a server (--base-url)"
            )
        self.options = options
        self._model = model
        forward, turn = (
            ", ".join(map(str, MOTIONS.amounts(motion)))
            for motion in ("forward", "left")
        )
        self._rules = load_prompt("see_and_go_rules", forward=forward, turn=turn)
        step = load_prompt("see_and_go_step", instruction="", steps="")
        self._version = prompt_version(self._rules, step)

    @property
    def name(self) -> str:
        """`see_and_go[model]`, and what is set that changes what it does."""
        given = self.options
        told = [f"+{given.requests} requests"] if given.requests else []
        told += [f"+memory={given.memory}"] if given.memory != 10 else []
        return f"see_and_go[{self._model.name}]{''.join(told)}"

    def asking(self, instruction: str, limits: FairLimits | None) -> Asking:
        """Tell with which prompt it asks, how often, and how far an answer gets it."""
        return Asking(
            {"move": self._version},
            stride=(MOTIONS.most * MOTIONS.forward_m, MOTIONS.most * MOTIONS.turn_deg),
            most=self._most(limits),
        )

    def follow(
        self,
        instruction: str,
        robot: SteppingRobot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Look, ask and go until the model says stop, is out of requests, or stuck.

        Notes in the journal: `move` for each, with what the model said. The generator
        gives the episode a number, by which its pictures are named.
        """
        numbers = _numbers(self._most(journal.limits))
        steps = deque[str](maxlen=self.options.memory)
        episode = str(rng.integers(2**31))
        place, still = frame_name(episode, "", "start"), 0
        while still < self.options.failures:
            view = Picture.of_pixels(robot.camera_picture().rgb, place)
            task = load_prompt(
                "see_and_go_step",
                instruction=instruction.strip(),
                steps="\n".join(steps) or "(none)",
            )
            command, said = self._ask(task, view, numbers, journal)
            if command.motion == "stop":
                return robot.stop()
            ahead, done = make_move(robot, command)
            journal.add(SaidAndDoneNote(said, done))
            steps.append(f"- {said} {done}")
            still = 0 if ahead > STILL_METRES else still + 1
            place = frame_name(episode, place, done)
        raise EpisodeOver("stuck")

    def _most(self, fair: FairLimits | None) -> int | None:
        """Return the requests of an episode at most; None where nothing limits them."""
        return self.options.requests or (None if fair is None else fair.requests)

    def _ask(
        self, task: str, view: Picture, numbers: Iterator[int], journal: Journal
    ) -> tuple[Command, str]:
        """Return the next move, and what the model said."""
        request = CompletionRequest(
            (Message("system", self._rules), Message("user", task, (view,))),
            temperature=self.options.temperature,
            max_tokens=self.options.max_tokens,
            grammar=navid_reply_grammar(MOTIONS),
        )
        question = ModelQuestion("move", self._version)
        return ask_until_read(
            self._model, journal, request, question, numbers, _read_move
        )


def _numbers(limit: int | None) -> Iterator[int]:
    """Number the requests; more than the limit are not made."""
    for number in count(1):
        if limit is not None and number > limit:
            raise EpisodeOver("budget")
        yield number


def _read_move(reply: str) -> tuple[Command, str]:
    return read_navid_reply(reply, MOTIONS), " ".join(reply.split())


def make_move(robot: SteppingRobot, command: Command) -> tuple[float, str]:
    """Move the robot; return the metres it got ahead, and what happened in words."""
    if command.motion == "forward":
        wanted = command.count * MOTIONS.forward_m
        ahead = robot.step_forward(wanted)
        halted = ahead < wanted - STILL_METRES
        end = ", where something is in the way" if halted else ""
        return ahead, f"The robot went {100 * ahead:.0f} cm{end}."
    degrees = command.count * MOTIONS.turn_deg
    robot.rotate(math.radians(degrees if command.motion == "left" else -degrees))
    return 0.0, f"The robot turned {command.motion} by {degrees} degrees."
