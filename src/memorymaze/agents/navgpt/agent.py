"""The loop of NavGPT: observe, ask the model, go where it says, until it says "there".

Zhou, Hong, Wu 2024, "NavGPT: Explicit Reasoning in Vision-and-Language Navigation with
Large Language Models" (AAAI). What is as in its released code and what is not:
`docs/model_agents.md`.
"""

from dataclasses import asdict, dataclass, field
from typing import ClassVar, Literal

import numpy as np

from memorymaze.agents.agent import Asking, FairLimits, Journal, Need
from memorymaze.agents.navgpt.observation import (
    ObservedPlace,
    Scratchpad,
    compass_degrees,
    history_line,
    observation_text,
    summary_text,
    ways_text,
)
from memorymaze.agents.navgpt.replies import (
    MOVE_ACTION,
    Finish,
    Move,
    Unreadable,
    navgpt_reply_grammar,
    read_navgpt_reply,
    thought_in_reply,
)
from memorymaze.agents.notes import (
    BlockedMoveNote,
    FinalAnswerNote,
    NavGPTCountsNote,
    ObservationNote,
    ParseFailureNote,
    RefusedMoveNote,
    ThoughtNote,
    ViewpointMoveNote,
)
from memorymaze.basics.errors import EpisodeOver, SettingsError
from memorymaze.basics.options import check_least, check_number
from memorymaze.language.models.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    ModelQuestion,
)
from memorymaze.language.models.prompt_texts import load_prompt, prompt_version
from memorymaze.robot.api.viewpoints import Journey, ViewpointRobot

RELEASED_ITERATIONS = 10
RELEASED_SCRATCHPAD = 7000
FAIR_FAILURES = 10
"""As many as the released budget has requests in all."""


@dataclass(frozen=True, slots=True)
class CaptionOptions:
    """Who describes viewpoints to an agent on a graph; a run goes by these options."""

    captions: Literal["templates", "vision"] = "templates"
    """Who describes what is seen: templates filled with what the camera truly sees, or a
    vision model that is shown pictures."""
    caption_model: str | None = None
    """Vision model of the captions; none for the agent's own model."""

    @property
    def needs(self) -> frozenset[Need]:
        """What the agent needs with these options."""
        return frozenset({"language_model"} if self.captions == "vision" else ())


@dataclass(frozen=True, slots=True)
class NavGPTOptions(CaptionOptions):
    """What can be set of the NavGPT agent."""

    budget: Literal["fair", "released"] = "fair"
    """Limits of the loop: `released` as the released code has them (10 requests, a
    scratchpad of 7000 characters), `fair` scaled to the longest route of the site."""
    iterations: int | None = None
    """Requests in an episode at most; none for what the budget says."""
    scratchpad: int | None = None
    """Characters of earlier steps that the model is shown; none for what the budget
    says."""
    failures: int | None = None
    """Replies in a row that cannot be used, or moves refused, after which the episode
    ends as `stuck`; none for what the budget says (fair: 10, released: no limit)."""
    faithful: bool = False
    """Whether two faults of the released code are kept: neighbours at headings from
    337.5 degrees on are not shown, and of things of one name in a direction only one."""
    grammar: bool = True
    """Whether local models that can be held to a grammar are held to well-formed replies
    and listed viewpoints; other models answer freely."""
    temperature: float = 0.0
    """Of the requests."""
    max_tokens: int = 1024
    """Longest reply."""
    seed: int | None = None
    """Passed to the model; none for none."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_least(self, iterations=1, scratchpad=1, failures=1, max_tokens=1)
        check_number("--set temperature", self.temperature, 0)
        if self.captions == "templates" and self.caption_model is not None:
            raise SettingsError(
                "--set caption_model: templates ask no model; add --set captions=vision"
            )


@dataclass(frozen=True, slots=True)
class LoopLimits:
    """When the loop is broken off, and how far back the model sees."""

    iterations: int
    """Requests in an episode at most."""
    scratchpad: int
    """Characters of earlier steps that the model is shown."""
    failures: int | None
    """Failures in a row after which the episode ends as `stuck`; None for no limit."""


def loop_limits(options: NavGPTOptions, fair: FairLimits | None) -> LoopLimits:
    """Return the limits of an episode.

    Fair: as many requests as the run calls fair, and a scratchpad that grows with them as
    in the released code, 700 characters for each.
    """
    iterations, scratchpad, failures = RELEASED_ITERATIONS, RELEASED_SCRATCHPAD, None
    if options.budget == "fair":
        if fair is None:
            raise SettingsError(
                "--set budget=fair: expected a run's journal, which has the limits of the "
                "site, got one without; set budget=released, or journal.limits"
            )
        iterations = fair.requests
        scratchpad = iterations * RELEASED_SCRATCHPAD // RELEASED_ITERATIONS
        failures = FAIR_FAILURES
    return LoopLimits(
        iterations=options.iterations or iterations,
        scratchpad=options.scratchpad or scratchpad,
        failures=options.failures or failures,
    )


class NavGPTAgent:
    """Follows an instruction by asking a language model for each next viewpoint.

    It drives a `ViewpointRobot`, which a run hands to agents that need a graph.
    """

    Options = NavGPTOptions
    needs: ClassVar[frozenset[Need]] = frozenset({"language_model", "graph"})

    def __init__(self, options: NavGPTOptions, model: LanguageModel) -> None:
        """Prepare the agent."""
        self.options = options
        """What was set."""
        self._model = model
        self._rules = load_prompt("navgpt_rules", move_action=MOVE_ACTION)
        step = load_prompt("navgpt_step", instruction="", start="", steps="")
        self._version = prompt_version(self._rules, step)

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

    def asking(self, instruction: str, limits: FairLimits | None) -> Asking:
        """Tell which prompt it asks with; how often, the walk decides."""
        return Asking({"step": self._version})

    def follow(
        self,
        instruction: str,
        robot: ViewpointRobot,
        journal: Journal,
        rng: np.random.Generator,
    ) -> None:
        """Go from viewpoint to viewpoint until the model says that it has arrived.

        Notes in the journal: `observation`, `model_reply`, `thought`, then `move`,
        `blocked_move`, `refused_move`, `parse_failure` or `final_answer`; at the end, in
        any case, `navgpt` with all counts.
        """
        limits = loop_limits(self.options, journal.limits)
        walk = _Walk(robot, journal, limits, faithful=self.options.faithful)
        try:
            start = walk.look(compass_degrees(robot.start_heading))
            for number in range(1, limits.iterations + 1):
                walk.counts.requests = number
                told = summary_text(start) if walk.counts.moves else walk.full(start)
                reply = self._ask(instruction, told, walk, journal)
                journal.add(ThoughtNote(thought_in_reply(reply)))
                wish = read_navgpt_reply(reply)
                if isinstance(wish, Finish):
                    return journal.add(FinalAnswerNote(wish.answer))
                walk.take(wish, reply)
            raise EpisodeOver("budget")
        finally:
            journal.add(NavGPTCountsNote(**asdict(walk.counts), **asdict(limits)))

    def _ask(
        self, instruction: str, start: str, walk: "_Walk", journal: Journal
    ) -> str:
        """Return the model's reply, given what is told of the start and of the walk."""
        task = load_prompt(
            "navgpt_step",
            instruction=instruction.strip(),
            start=start,
            steps=walk.pad.text().strip() or "(none yet)",
        )
        listed = [way.viewpoint for way in walk.place.ways]
        number = walk.counts.requests
        request = CompletionRequest(
            messages=(Message("system", self._rules), Message("user", task)),
            temperature=self.options.temperature,
            max_tokens=self.options.max_tokens,
            seed=self.options.seed,
            grammar=navgpt_reply_grammar(listed) if self.options.grammar else None,
            question=ModelQuestion("step", self._version, number),
        )
        return journal.ask(self._model, request, "step")


@dataclass
class Counts:
    """What happened in an episode."""

    requests: int = 0
    moves: int = 0
    blocked_moves: int = 0
    refused_unknown: int = 0
    refused_not_adjacent: int = 0
    parse_failures: dict[str, int] = field(default_factory=dict[str, int])


class _Walk:
    """One episode: goes where the model says, and keeps what it is shown."""

    place: ObservedPlace
    """Where the robot is."""

    def __init__(
        self,
        robot: ViewpointRobot,
        journal: Journal,
        limits: LoopLimits,
        *,
        faithful: bool,
    ) -> None:
        self.counts = Counts()
        self.pad = Scratchpad(limits.scratchpad, whole_steps=not faithful)
        self._robot = robot
        self._journal = journal
        self._limits = limits
        self._faithful = faithful
        self._failures = 0

    def take(self, wish: Move | Unreadable, reply: str) -> None:
        """Do what a reply wishes; `EpisodeOver` after too many failures in a row."""
        if isinstance(wish, Unreadable):
            faults = self.counts.parse_failures
            faults[wish.fault] = faults.get(wish.fault, 0) + 1
            self._journal.add(ParseFailureNote(wish.fault, wish.told))
            return self._fail(reply, wish.told)
        viewpoint, before = wish.viewpoint, self.place
        journey = self._robot.go_to(viewpoint)
        if journey.end == "arrived":
            self._arrive(before, journey, reply)
        elif journey.end == "blocked":
            self.counts.blocked_moves += 1
            self._journal.add(
                BlockedMoveNote(viewpoint, journey.reason, journey.distance)
            )
            self.look(before.heading)
            self.pad.add_move(
                reply,
                f"The way to {viewpoint} is blocked ({journey.reason}). You are back.\n"
                + self.full(self.place),
                f"The way to {viewpoint} was blocked ({journey.reason}).",
            )
        else:
            self._refuse(viewpoint, journey, reply)

    def _arrive(self, before: ObservedPlace, journey: Journey, reply: str) -> None:
        self.counts.moves += 1
        self._failures = 0
        way = next(way for way in before.ways if way.viewpoint == self._robot.viewpoint)
        heading = compass_degrees(way.heading)
        self._journal.add(
            ViewpointMoveNote(
                before.viewpoint, way.viewpoint, round(heading, 2), journey.distance
            )
        )
        here = self.look(heading)
        self.pad.add_move(reply, self.full(here), history_line(before, here))

    def _refuse(self, viewpoint: str, journey: Journey, reply: str) -> None:
        if journey.end == "unknown":
            self.counts.refused_unknown += 1
            why = "There is no such viewpoint."
        else:
            self.counts.refused_not_adjacent += 1
            why = (
                "That viewpoint is not next to yours, so it cannot be gone to at once."
            )
        self._journal.add(RefusedMoveNote(viewpoint, journey.end))
        self._fail(
            reply,
            f"{why} You did not move and are still at viewpoint "
            f"{self.place.viewpoint}. From here you can go to: {ways_text(self.place)}.",
        )

    def _fail(self, reply: str, told: str) -> None:
        self.pad.add_failure(reply, told)
        self._failures += 1
        limit = self._limits.failures
        if limit is not None and self._failures >= limit:
            raise EpisodeOver("stuck")

    def look(self, heading: float) -> ObservedPlace:
        """Look about; who came by this heading, in compass degrees."""
        robot = self._robot
        ways = tuple(robot.ways_on())
        self.place = ObservedPlace(robot.viewpoint, heading, robot.look_around(), ways)
        self._journal.add(
            ObservationNote(
                self.place.viewpoint,
                self.place.panorama.described_by,
                self.full(self.place),
            )
        )
        return self.place

    def full(self, place: ObservedPlace) -> str:
        return observation_text(place, faithful=self._faithful)
