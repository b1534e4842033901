"""The loop of NavGPT: observe, ask the model, go where it says, until it says "there".

Zhou, Hong, Wu 2024, "NavGPT: Explicit Reasoning in Vision-and-Language Navigation with
Large Language Models" (AAAI). What is as in its released code and what is not:
`docs/navgpt.md`.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field

from memorymaze.agents.agent import Journal
from memorymaze.agents.navgpt.directions import compass_degrees
from memorymaze.agents.navgpt.observation import (
    Place,
    history_line,
    observation_text,
    summary_text,
    ways_text,
)
from memorymaze.agents.navgpt.parsing import (
    MOVE_ACTION,
    Finish,
    Unreadable,
    read_reply,
    thought_of,
)
from memorymaze.agents.navgpt.reply_grammar import reply_grammar
from memorymaze.agents.navgpt.scratchpad import Scratchpad
from memorymaze.agents.navgpt.settings import LoopLimits, NavGPTOptions
from memorymaze.errors import EpisodeOver
from memorymaze.language.model import CompletionRequest, LanguageModel, Message
from memorymaze.language.prompt_texts import load_prompt
from memorymaze.robot.viewpoints import Journey, ViewpointRobot

__all__ = ["NavGPTAgent"]


class NavGPTAgent:
    """Follows an instruction by asking a language model for each next viewpoint.

    It drives a `ViewpointRobot`; in a run, one is put round the simulated robot for it.
    """

    def __init__(
        self,
        model: LanguageModel,
        options: NavGPTOptions | None = None,
        *,
        seed: int | None = None,
    ) -> None:
        """Prepare the agent.

        Args:
            model: Is asked once per step.
            options: The defaults when None.
            seed: Passed to the model.
        """
        self.options = options or NavGPTOptions()
        """What was set."""
        self._model = model
        self._seed = seed
        self._rules = load_prompt("navgpt_rules", move_action=MOVE_ACTION)

    @property
    def name(self) -> str:
        """`navgpt[model]+fair`, and what else is set that changes what it does."""
        options = self.options
        numbers = (
            f"+{name}={value}"
            for name in ("iterations", "scratchpad", "failures")
            if (value := getattr(options, name)) is not None
        )
        return (
            f"navgpt[{self._model.name}]+{options.budget}"
            + "+faithful" * options.faithful
            + "+vision" * (options.captions == "vision")
            + (f"[{options.caption_model}]" if options.caption_model else "")
            + "".join(numbers)
        )

    def follow(
        self,
        instruction: str,
        robot: ViewpointRobot,
        journal: Journal,
        limits: LoopLimits,
    ) -> None:
        """Go from viewpoint to viewpoint until the model says that it has arrived.

        Notes in the journal: `observation`, `model_reply`, `thought`, then `move`,
        `blocked_move`, `refused_move`, `parse_failure` or `final_answer`; at the end, in
        any case, `navgpt` with all counts.

        Raises:
            LanguageModelError: The model did not answer.
            EpisodeOver: `budget` after the last iteration, `stuck` after too many
                failures in a row, or what the robot says.
        """
        walk = _Walk(self, instruction, robot, journal, limits)
        try:
            walk.run()
        finally:
            journal.note("navgpt", **asdict(walk.counts), **asdict(limits))

    def ask(
        self,
        instruction: str,
        start: str,
        scratchpad: str,
        listed: Sequence[str],
        journal: Journal,
    ) -> str:
        """Return the model's next reply; counted in the journal.

        Args:
            instruction: As it was given.
            start: What is told of the place where the walk began.
            scratchpad: Earlier steps; empty before the first.
            listed: Ids of the viewpoints that the robot can go to.
            journal: Of the episode.
        """
        task = load_prompt(
            "navgpt_step",
            instruction=instruction.strip(),
            start=start,
            steps=scratchpad.strip() or "(none yet)",
        )
        completion = self._model.complete(
            CompletionRequest(
                messages=(Message("system", self._rules), Message("user", task)),
                temperature=self.options.temperature,
                max_tokens=self.options.max_tokens,
                seed=self._seed,
                grammar=reply_grammar(listed) if self.options.grammar else None,
            )
        )
        journal.count(completion, stage="step")
        return completion.text


@dataclass
class _Counts:
    """What happened in an episode."""

    requests: int = 0
    moves: int = 0
    blocked_moves: int = 0
    refused_unknown: int = 0
    refused_not_adjacent: int = 0
    parse_failures: dict[str, int] = field(default_factory=dict[str, int])


class _Walk:
    """One episode."""

    def __init__(
        self,
        agent: NavGPTAgent,
        instruction: str,
        robot: ViewpointRobot,
        journal: Journal,
        limits: LoopLimits,
    ) -> None:
        self.counts = _Counts()
        self._agent = agent
        self._instruction = instruction
        self._robot = robot
        self._journal = journal
        self._limits = limits
        self._faithful = agent.options.faithful
        self._pad = Scratchpad(limits.scratchpad, whole_steps=not self._faithful)
        self._failures = 0

    def run(self) -> None:
        """Ask and go until the model says that it has arrived."""
        self._place = self._look(compass_degrees(self._robot.start_heading))
        start = self._place
        for _ in range(self._limits.iterations):
            moved = self.counts.moves > 0
            told = summary_text(start) if moved else self._full(start)
            self.counts.requests += 1
            listed = [way.viewpoint for way in self._place.ways]
            reply = self._agent.ask(
                self._instruction, told, self._pad.text(), listed, self._journal
            )
            self._journal.note("thought", text=thought_of(reply))
            wish = read_reply(reply)
            if isinstance(wish, Finish):
                self._journal.note("final_answer", text=wish.answer)
                return
            if isinstance(wish, Unreadable):
                faults = self.counts.parse_failures
                faults[wish.fault] = faults.get(wish.fault, 0) + 1
                self._journal.note("parse_failure", fault=wish.fault, told=wish.told)
                self._fail(reply, wish.told)
            else:
                self._go(wish.viewpoint, reply)
        raise EpisodeOver("budget")

    def _go(self, viewpoint: str, reply: str) -> None:
        before = self._place
        journey = self._robot.go_to(viewpoint)
        if journey.end == "arrived":
            self._arrive(before, journey, reply)
        elif journey.end == "blocked":
            self.counts.blocked_moves += 1
            self._journal.note(
                "blocked_move",
                viewpoint=viewpoint,
                reason=journey.reason,
                distance=journey.distance,
            )
            self._place = self._look(before.heading)
            self._pad.add_move(
                reply,
                f"The way to {viewpoint} is blocked ({journey.reason}). You are back.\n"
                + self._full(self._place),
                f"The way to {viewpoint} was blocked ({journey.reason}).",
            )
        else:
            self._refuse(viewpoint, journey, reply)

    def _arrive(self, before: Place, journey: Journey, reply: str) -> None:
        self.counts.moves += 1
        self._failures = 0
        way = next(way for way in before.ways if way.viewpoint == self._robot.viewpoint)
        self._journal.note(
            "move",
            start=before.viewpoint,
            end=way.viewpoint,
            heading_deg=round(compass_degrees(way.heading), 2),
            distance=journey.distance,
        )
        self._place = self._look(compass_degrees(way.heading))
        self._pad.add_move(
            reply, self._full(self._place), history_line(before, self._place)
        )

    def _refuse(self, viewpoint: str, journey: Journey, reply: str) -> None:
        if journey.end == "unknown":
            self.counts.refused_unknown += 1
            why = "There is no such viewpoint."
        else:
            self.counts.refused_not_adjacent += 1
            why = (
                "That viewpoint is not next to yours, so it cannot be gone to at once."
            )
        self._journal.note("refused_move", viewpoint=viewpoint, why=journey.end)
        self._fail(
            reply,
            f"{why} You did not move and are still at viewpoint "
            f"{self._place.viewpoint}. From here you can go to: "
            f"{ways_text(self._place)}.",
        )

    def _fail(self, reply: str, told: str) -> None:
        self._pad.add_failure(reply, told)
        self._failures += 1
        limit = self._limits.failures
        if limit is not None and self._failures >= limit:
            raise EpisodeOver("stuck")

    def _look(self, heading: float) -> Place:
        robot = self._robot
        place = Place(
            robot.viewpoint, heading, robot.look_around(), tuple(robot.ways_on())
        )
        self._journal.note(
            "observation",
            viewpoint=place.viewpoint,
            described_by=place.panorama.described_by,
            text=self._full(place),
        )
        return place

    def _full(self, place: Place) -> str:
        return observation_text(place, faithful=self._faithful)
