"""The agent of the NaVid protocol: shows pictures, does what is answered, and stops."""

import hashlib
import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from memorymaze.agents.agent import Asking, FairLimits, Journal, Need
from memorymaze.agents.navid.model_policy import PolicySession, version
from memorymaze.agents.navid.motions import (
    FIELD_OF_VIEW_DEG,
    HEIGHT,
    WIDTH,
    Command,
    Frame,
    Motion,
    frame_name,
)
from memorymaze.agents.navid.options import NavidOptions
from memorymaze.agents.navid.replies import read_navid_reply, read_reply_as_released
from memorymaze.agents.notes import (
    MotionsNote,
    OutOfStepsNote,
    RandomMotionNote,
    StuckNote,
)
from memorymaze.basics.errors import (
    CommandError,
    EpisodeOver,
    LanguageModelError,
    SettingsError,
)
from memorymaze.language.models.model import LanguageModel, takes_pictures
from memorymaze.robot.api.control import Robot
from memorymaze.robot.api.steps import SteppingRobot

STILL_METRES = 0.01
"""A step ahead of less is none."""

RANDOM_MOTIONS: tuple[Motion, ...] = ("forward", "left", "right")


class NavidAgent:
    """Follows an instruction by asking a model for one short motion after another.

    A picture is taken after every primitive motion. The model is asked when what it
    asked for last is done, and answers with up to three primitives of a kind, or stop.
    """

    Options = NavidOptions
    needs: ClassVar[frozenset[Need]] = frozenset({"language_model", "camera", "steps"})

    def __init__(self, options: NavidOptions, model: LanguageModel) -> None:
        """Prepare to ask a model, which must see pictures where it is shown some."""
        if not options.is_blind and not takes_pictures(model):
            raise SettingsError(
                f"--model {model.name}: models that run here see no pictures; name a "
                "vision model on a server (--base-url), or leave pictures out with "
                "--set pictures=none"
            )
        self.options = options
        """What was set."""
        self._model = model

    @property
    def name(self) -> str:
        """`NaVid protocol with <model>+<budget>`, and what else changes the rules."""
        options = self.options
        given = f"+max_steps={options.max_steps}" if options.max_steps else ""
        return (
            f"NaVid protocol with {self._model.name}{', blind' * options.is_blind}"
            f"+{options.budget}{given}{'+faithful' * options.faithful}"
        )

    def asking(self, instruction: str, limits: FairLimits | None) -> Asking:
        """Tell with which prompt it asks, how often, and how far an answer gets it."""
        motions = self.options.motions
        return Asking(
            {"act": version(self.options.prompt)},
            stride=(motions.most * motions.forward_m, motions.most * motions.turn_deg),
            most=self.options.step_limit(limits),
        )

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Drive the robot as the model says, and stop where it says so.

        Notes in the journal: `model_reply` for each answer, and `decision` with what
        was read from it.

        The generator gives the episode a number, by which its pictures are named, and
        draws motions where `faithful` asks for it.
        """
        if not isinstance(robot, SteppingRobot):
            raise CommandError(
                "NaVid protocol: expected a robot with primitive motions and a camera "
                f"(memorymaze.robot.api.steps), got {type(robot).__name__}"
            )
        episode = str(rng.integers(2**31))
        session = PolicySession(self._model, self.options, instruction)
        limit = self.options.step_limit(journal.limits)
        _Walk(session, robot, journal, rng, self.options, limit, episode).run()
        robot.stop()


@dataclass
class _Walk:
    """The walk of one episode."""

    session: PolicySession
    robot: SteppingRobot
    journal: Journal
    rng: np.random.Generator
    options: NavidOptions
    limit: int | None
    episode: str
    steps: int = 0
    still: int = 0
    """Steps in a row without one ahead."""
    unreadable: int = 0
    """Decisions in a row."""
    picture_name: str = ""

    def run(self) -> None:
        """Walk until the model says stop."""
        frame = self._picture(None)
        while True:
            # Where no answer can be read, a step is spent without a motion.
            queue = self._decide(frame) or [None]
            for number, motion in enumerate(queue, 1):
                if motion == "stop":
                    return
                self._take_step(motion)
                frame = self._picture(motion)
                if number < len(queue):
                    self.session.observe(frame)

    def _decide(self, frame: Frame) -> list[Motion]:
        """Return the primitives to do next; none where no answer could be read."""
        problem: str | None = None
        name = ""
        seen = hashlib.sha256(frame.rgb.tobytes()).hexdigest()[:16]
        for _ in range(1 if self.options.faithful else 2):
            completion = self.session.act(frame, problem)
            self.journal.count(completion, stage="act")
            name = completion.model
            try:
                command = self._read(completion.text)
            except ValueError as error:
                problem = str(error)
                self.journal.add(MotionsNote(frame.step, seen, problem=problem))
                continue
            motions = ((command.motion, command.count),)
            self.journal.add(MotionsNote(frame.step, seen, motions=motions))
            self.unreadable = 0
            return [command.motion] * command.count
        if self.options.faithful:
            drawn = RANDOM_MOTIONS[int(self.rng.integers(len(RANDOM_MOTIONS)))]
            self.journal.add(RandomMotionNote(frame.step, drawn))
            return [drawn]
        self.unreadable += 1
        if self.unreadable >= self.options.failures:
            raise LanguageModelError(
                f"{name}: {self.unreadable} decisions in a row could not be read, each "
                f"asked for twice; the last time {problem}"
            )
        return []

    def _read(self, text: str) -> Command:
        reader = read_reply_as_released if self.options.faithful else read_navid_reply
        return reader(text, self.options.motions)

    def _take_step(self, motion: Motion | None) -> None:
        """Do a primitive, or nothing, within the budgets."""
        if self.limit is not None and self.steps >= self.limit:
            self.journal.add(OutOfStepsNote(self.steps, self.limit))
            raise EpisodeOver("budget")
        motions, moved = self.options.motions, False
        turn = math.radians(motions.turn_deg)
        if motion == "forward":
            moved = self.robot.step_forward(motions.forward_m) > STILL_METRES
        elif motion is not None:
            self.robot.rotate(turn if motion == "left" else -turn)
        self.steps += 1
        self.still = 0 if moved else self.still + 1
        if self.still >= self.options.still_steps:
            self.journal.add(StuckNote(self.steps, self.still))
            raise EpisodeOver("stuck")

    def _picture(self, after: Motion | None) -> Frame:
        rgb = self.robot.camera_picture(
            WIDTH, HEIGHT, math.radians(FIELD_OF_VIEW_DEG)
        ).rgb
        done = f"{after} {self.options.turn_deg}" if after else f"none {self.steps}"
        self.picture_name = frame_name(self.episode, self.picture_name, done)
        return Frame(self.steps, after, rgb, self.picture_name)
