"""The agent of the NaVid protocol: shows pictures, does what is answered, and stops."""

import hashlib
import math
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from memorymaze.agents.agent import Journal, Need
from memorymaze.agents.navid.policy import (
    FIELD_OF_VIEW_DEG,
    HEIGHT,
    WIDTH,
    Command,
    Frame,
    Motion,
    Motions,
    Policy,
    PolicySession,
    Task,
    frame_name,
)
from memorymaze.agents.navid.replies import read_reply, read_reply_as_released
from memorymaze.errors import CommandError, EpisodeOver, LanguageModelError
from memorymaze.options import check_least, check_number
from memorymaze.robot.api import Robot
from memorymaze.robot.steps import SteppingRobot

RELEASED_STEPS = 400
"""Steps after which the released evaluation on R2R breaks off; on RxR it is 500."""


STILL_METRES = 0.01
"""A step ahead of less is none."""

RANDOM_MOTIONS: tuple[Motion, ...] = ("forward", "left", "right")


@dataclass(frozen=True, slots=True)
class NavidOptions:
    """What can be set of the NaVid protocol's agent."""

    server: str | None = None
    """Address of a policy server, such as http://localhost:8765; none asks the vision
    model named by --model."""
    budget: Literal["fair", "released"] = "fair"
    """Steps of an episode: `released` as the released code has them (400, for R2R),
    `fair` three times those of the longest route of the site."""
    max_steps: int | None = None
    """Steps of an episode at most; none for what the budget says. The released code
    has 500 for RxR."""
    still_steps: int = 25
    """Steps in a row without a step ahead after which the episode ends as `stuck`."""
    turn_deg: Literal[15, 30] = 30
    """Degrees of one turn; an answer turns by one, two or three of them."""
    faithful: bool = False
    """Whether replies are read as the released code reads them, with its faults, and
    an unreadable one becomes a random motion that is not a stop."""
    failures: int = 5
    """Unreadable decisions in a row after which the episode ends as `model_error`;
    each is asked for once more before. Not with `faithful`."""
    pictures: Literal["shown", "none"] = "shown"
    """Whether a model named by --model is shown pictures: `none` is an ablation, told
    as `blind` in tables, and the only way for models that know text alone."""
    history: int = 8
    """Past pictures that a vision model is shown: spread evenly, with the last one."""
    history_width: int = 320
    """Pixels of the width of past pictures; the current one has 640."""
    temperature: float = 0.0
    """Of a vision model. A server decides for itself (the released code: 0.2)."""
    max_tokens: int = 300
    """Longest reply of a vision model."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_least(
            self, max_steps=1, still_steps=1, failures=1, history=0, max_tokens=1
        )
        check_number("--set history_width", self.history_width, 32, WIDTH, whole=True)
        check_number("--set temperature", self.temperature, 0)

    @property
    def motions(self) -> Motions:
        """The primitive motions."""
        return Motions(turn_deg=self.turn_deg)

    def step_limit(self, fair_steps: int | None) -> int | None:
        """Return the steps of an episode at most; None where only the run's budgets count.

        `fair_steps` is what the budget `fair` allows where the robot is.
        """
        if self.max_steps is not None:
            return self.max_steps
        return RELEASED_STEPS if self.budget == "released" else fair_steps


class NavidAgent:
    """Follows an instruction by asking a policy for one short motion after another.

    The policy sees a picture after every primitive motion. It is asked when what it
    asked for last is done, and answers with up to three primitives of a kind, or stop.
    """

    needs: ClassVar[frozenset[Need]] = frozenset({"language_model", "camera", "steps"})

    def __init__(self, policy: Policy, options: NavidOptions | None = None) -> None:
        """Prepare the agent."""
        self._policy = policy
        self.options = options or NavidOptions()
        """What was set."""
        self.prompts: dict[str, str] = getattr(policy, "prompts", {})
        """Version of the prompt of a language model; answers are compared with it."""

    @property
    def name(self) -> str:
        """`NaVid protocol with <model>+<budget>`, and what else changes the rules."""
        options = self.options
        given = f"+max_steps={options.max_steps}" if options.max_steps else ""
        return (
            f"NaVid protocol with {self._policy.name}+{options.budget}{given}"
            + "+faithful" * options.faithful
        )

    def follow(
        self,
        instruction: str,
        robot: Robot,
        journal: Journal,
        rng: np.random.Generator,
        fair_steps: int | None = None,
    ) -> None:
        """Drive the robot as the policy says, and stop where it says so.

        Notes in the journal: `model_reply` for each answer, and `decision` with what
        was read from it.

        The generator seeds the policy, and draws motions where `faithful` asks for it.
        `fair_steps` is what the budget `fair` allows here; None sets no limit of steps.
        """
        if not isinstance(robot, SteppingRobot):
            raise CommandError(
                "NaVid protocol: expected a robot with primitive motions and a camera "
                f"(memorymaze.robot.steps), got {type(robot).__name__}"
            )
        seed = int(rng.integers(2**31))
        session = self._policy.begin(Task(instruction, self.options.motions, seed))
        try:
            limit = self.options.step_limit(fair_steps)
            _Walk(session, robot, journal, rng, self.options, limit, str(seed)).run()
        finally:
            session.close()
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
        """Walk until the policy says stop."""
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
        for _ in range(1 if self.options.faithful else 2):
            answer = self.session.act(frame, problem)
            self.journal.count(answer.completion, stage="act")
            name = answer.completion.model
            try:
                commands = answer.commands or (self._read(answer.text),)
            except ValueError as error:
                problem = str(error)
                self._note_decision(frame, problem=problem)
                continue
            motions = [[each.motion, each.count] for each in commands]
            self._note_decision(frame, motions=motions)
            self.unreadable = 0
            return [each.motion for each in commands for _ in range(each.count)]
        if self.options.faithful:
            drawn = RANDOM_MOTIONS[int(self.rng.integers(len(RANDOM_MOTIONS)))]
            self.journal.note("random_motion", step=frame.step, motion=drawn)
            return [drawn]
        self.unreadable += 1
        if self.unreadable >= self.options.failures:
            raise LanguageModelError(
                f"{name}: {self.unreadable} decisions in a row could not be read, each "
                f"asked for twice; the last time {problem}"
            )
        return []

    def _read(self, text: str) -> Command:
        reader = read_reply_as_released if self.options.faithful else read_reply
        return reader(text, self.options.motions)

    def _note_decision(self, frame: Frame, **read: object) -> None:
        seen = hashlib.sha256(frame.rgb.tobytes()).hexdigest()[:16]
        self.journal.note("decision", step=frame.step, picture=seen, **read)

    def _take_step(self, motion: Motion | None) -> None:
        """Do a primitive, or nothing, within the budgets."""
        if self.limit is not None and self.steps >= self.limit:
            self.journal.note("out_of_steps", step=self.steps, limit=self.limit)
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
            self.journal.note("stuck", step=self.steps, still_steps=self.still)
            raise EpisodeOver("stuck")

    def _picture(self, after: Motion | None) -> Frame:
        rgb = self.robot.camera_picture(
            WIDTH, HEIGHT, math.radians(FIELD_OF_VIEW_DEG)
        ).rgb
        done = f"{after} {self.options.turn_deg}" if after else f"none {self.steps}"
        self.picture_name = frame_name(self.episode, self.picture_name, done)
        return Frame(self.steps, after, rgb, self.picture_name)
