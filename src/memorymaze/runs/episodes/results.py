"""What came of one episode: its walk as metrics see it, a flat record, a line of JSON."""

import json
from bisect import bisect_left
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from typing import Annotated, Any, Literal, get_type_hints

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import FiniteFloat, TypeAdapter, ValidationError

from memorymaze.basics.errors import RunFolderError, UndefinedMetricError
from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.runs.metrics import turns
from memorymaze.runs.metrics.score import MetricValues, score_walk
from memorymaze.runs.metrics.turns import TurnAtPlace
from memorymaze.texts.corpus.records import Episode, Followers
from memorymaze.world.sites import Route, Site

Shown = Literal["paper", "compared", "spread", "episode", "costs"]


@dataclass(frozen=True)
class FinishedWalk:
    """A walk that is over, and all that metrics may compare it with."""

    site: Site
    grid: FloorGrid
    """The site's walkable floor."""
    episode: Episode
    trajectory: Trajectory
    stopped_by: str
    """Who or what ended it; only `agent` can be a success."""
    success_distance: float
    """Metres."""
    left_floor_at: XY | None = None
    """Where it went on off the floor, of which nothing is here."""

    def while_on_floor(self) -> "FinishedWalk":
        """Return it up to where it leaves the floor, then ended by a crash; or as it is.

        Raises:
            UndefinedMetricError: The reference path leaves the floor.
        """
        if not self._is_off:
            return self
        # Where the start alone cannot be measured, the reference path is at fault.
        _ = self._first(1).scores
        poses = self.trajectory.poses
        on_floor = 1 + bisect_left(
            range(2, len(poses)), True, key=lambda count: self._first(count)._is_off
        )
        beyond = poses[on_floor]
        return replace(
            self._first(on_floor),
            stopped_by="crash",
            left_floor_at=(beyond.x, beyond.y),
        )

    def _first(self, count: int) -> "FinishedWalk":
        """Return it with so many of its poses."""
        return replace(self, trajectory=Trajectory(self.trajectory.poses[:count]))

    @property
    def _is_off(self) -> bool:
        try:
            _ = self.scores
        except UndefinedMetricError:
            return True
        return False

    @property
    def points(self) -> NDArray[np.float64]:
        """Positions in the order of time, metres, shape (N, 2)."""
        return self.trajectory.points

    @property
    def reference_route(self) -> Route:
        """The way described."""
        return self.site.find_route(self.episode.instruction.reference_route)

    @cached_property
    def scores(self) -> MetricValues:
        """The published metrics; UndefinedMetricError where a path leaves the floor."""
        values = score_walk(
            self.grid, self.episode.reference_path, self.points, self.success_distance
        )
        return values if self.stopped_by == "agent" else values.without_success()

    def distances_to_goal(self, places: ArrayLike) -> NDArray[np.float64]:
        """Return the shortest walks from places, shape (k, 2), to the goal, metres."""
        return self.grid.walks.distances_to(self.episode.goal, np.asarray(places))


@dataclass(frozen=True, slots=True)
class Measure:
    """What is said of a field of `EpisodeResult`, in whose type it stands."""

    short: str = ""
    """As papers write it."""
    meaning: str = ""
    better: Literal["higher", "lower"] | None = None
    unit: str = ""
    digits: int = 2
    shown: tuple[Shown, ...] = ()
    """In the paper's tables and leaderboards; in comparisons of runs, which test it; by
    reports, as its spread over episodes and on the pages of episodes; as the costs of a
    language model. Summaries and data frames have every measure."""
    of_walk: Callable[[FinishedWalk], float] | None = None
    """Works it out; None for what the run itself counts."""
    is_amount: bool = False
    """Whether summaries tell its sum as well."""
    is_rechecked: bool = True
    """Whether `runs check` finds it again in poses of whole millimetres."""
    name: str = ""
    """In the columns of tables; that of the field where it is not given."""
    field: str = ""
    """Of `EpisodeResult`; filled in from there."""

    @property
    def heading(self) -> str:
        """What stands above its column."""
        return f"{self.short} ({self.unit})" if self.unit else self.short

    @property
    def title(self) -> str:
        """What stands above a part of a page about it."""
        return f"{self.short}: {self.meaning}"


def site_turns_taken(site: Site, walk: Trajectory) -> list[TurnAtPlace]:
    """Return the turns of a walk in the site's turning points, in their order.

    See `metrics.turns` for what a turn is.
    """
    places = [(place.id, place.polygon) for place in site.turning_points]
    return turns.turns_taken(places, walk)


def route_turns_in_order(site: Site, route: Route, walk: Trajectory) -> float:
    """Return the share of a route's turns that a walk took, in their order.

    Slight turns count as left or right. 1 for a route without turns.
    """
    wanted = [
        TurnAtPlace(turn.at, "left" if turn.direction.endswith("left") else "right")
        for turn in route.turns
    ]
    return turns.turns_in_order(wanted, site_turns_taken(site, walk))


StoppedBy = Literal["agent", "budget", "stuck", "crash", "unsafe", "model_error"]
"""Who or what ended an episode; only `agent` can be a success."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EpisodeResult:
    """What came of one episode; one line of `episodes.jsonl`."""

    episode_id: str
    instruction_id: str
    site: str
    route: str
    reference_route: str
    """Route id of the way described, which the paths are compared with."""
    study: str
    """Such as `online` or `onsite`; a corpus of another origin has its own."""
    iteration: Literal[1, 2]
    participant: str
    source: Literal["human", "llm", "synthetic"]
    """Who wrote the instruction."""
    split: str
    agent: str
    stopped_by: StoppedBy
    success: Annotated[
        bool,
        Measure(
            "SR",
            "success rate",
            "higher",
            name="sr",
            shown=("paper", "compared"),
            of_walk=lambda walk: walk.scores.success == 1.0,
        ),
    ]
    """Stopped by itself, nearer to the goal than the success distance."""
    oracle_success: Annotated[
        bool,
        Measure(
            "OSR",
            "oracle success rate",
            "higher",
            name="osr",
            shown=("paper", "compared"),
            of_walk=lambda walk: walk.scores.oracle_success == 1.0,
        ),
    ]
    """Was at any moment nearer to the goal than the success distance."""
    spd: Annotated[
        FiniteFloat,
        Measure(
            "SPD",
            "shortest walk left to the goal",
            "lower",
            unit="m",
            shown=("paper", "compared", "spread", "episode"),
            of_walk=lambda walk: walk.scores.ne,
        ),
    ]
    """Shortest walk from where the robot stands at the end to the goal, metres."""
    cls: Annotated[
        FiniteFloat,
        Measure(
            "CLS",
            "coverage weighted by length",
            "higher",
            shown=("paper", "compared", "spread", "episode"),
            of_walk=lambda walk: walk.scores.cls,
        ),
    ]
    """Coverage weighted by length score, 0 to 1."""
    spl: Annotated[
        FiniteFloat,
        Measure("SPL", shown=("episode",), of_walk=lambda walk: walk.scores.spl),
    ]
    ndtw: Annotated[
        FiniteFloat,
        Measure(
            "nDTW",
            "dynamic time warping",
            "higher",
            shown=("compared", "episode"),
            of_walk=lambda walk: walk.scores.ndtw,
        ),
    ]
    sdtw: Annotated[FiniteFloat, Measure(of_walk=lambda walk: walk.scores.sdtw)]
    path_length: Annotated[
        FiniteFloat,
        Measure(
            "Path length",
            "the way driven",
            unit="m",
            digits=1,
            shown=("spread", "episode"),
            of_walk=lambda walk: walk.scores.path_length,
            is_rechecked=False,
        ),
    ]
    """Metres driven."""
    collisions: Annotated[
        int, Measure("Collisions", digits=0, shown=("episode",), is_amount=True)
    ]
    turns_in_order: Annotated[
        FiniteFloat,
        Measure(
            "Turns in order",
            shown=("episode",),
            of_walk=lambda walk: route_turns_in_order(
                walk.site, walk.reference_route, walk.trajectory
            ),
            is_rechecked=False,
        ),
    ]
    """Share of the reference route's turns that were taken, in their order, 0 to 1."""
    duration_s: Annotated[
        FiniteFloat,
        Measure(
            "Duration",
            "simulated time",
            unit="s",
            digits=0,
            name="duration",
            shown=("spread", "episode"),
            is_amount=True,
        ),
    ]
    """Simulated seconds."""
    wall_s: Annotated[FiniteFloat, Measure(is_amount=True)]
    """Real seconds; the only field that differs between equal runs."""
    api_calls: Annotated[int, Measure(is_amount=True)]
    """Calls of the robot's control API."""
    model_calls: Annotated[
        int, Measure("calls", digits=1, shown=("costs",), is_amount=True)
    ]
    tokens: Annotated[
        int, Measure("tokens", digits=0, shown=("costs",), is_amount=True)
    ]
    cost_usd: Annotated[
        FiniteFloat, Measure("US$", digits=4, shown=("costs",), is_amount=True)
    ]
    error: str | None
    """One line on what went wrong, for the endings that are errors."""
    person_collisions: Annotated[int, Measure(is_amount=True)] = 0
    """Of the collisions those with people."""
    near_misses: Annotated[int, Measure(is_amount=True)] = 0
    """Times a person and the robot were closer than 0.3 m."""
    waiting_s: Annotated[FiniteFloat, Measure(is_amount=True)] = 0.0
    """Simulated seconds the robot stood because people were in the way."""
    refused_turns: Annotated[int, Measure(is_amount=True)] = 0
    """Calls of `turn` that found no way in that direction, or were no direction."""
    inference_s: Annotated[
        FiniteFloat, Measure("inference s", digits=1, shown=("costs",), is_amount=True)
    ] = 0.0
    """Real seconds that the language model took for its replies."""
    standing_s: Annotated[
        FiniteFloat, Measure("standing s", digits=1, shown=("costs",), is_amount=True)
    ] = 0.0
    """Simulated seconds the user stood while the model thought; in `duration_s`, but
    not against the time budget."""
    followers: Followers | None = None
    """How people fared who followed the instruction, where its corpus tells."""
    error_kinds: tuple[str, ...] = ()
    """Kinds of the significant errors in the instruction."""
    errors_of_tellings: tuple[int, ...] = ()
    """How many of these are in the first and in the second telling, where the agent was
    handed both; else empty."""
    pair: str | None = None
    """Shared with the same instruction without, or with, its errors."""
    way_m: FiniteFloat
    """Metres of the way described."""
    confidence: Annotated[
        FiniteFloat | None,
        Measure("Confidence", "the agent's own, that it is there", shown=("episode",)),
    ] = None
    """How probable the agent thought it that it is there, 0 to 1; None where it tells
    nothing."""
    gave_up: Annotated[bool, Measure("Gave up", digits=0)] = False
    """Stopped by itself, saying that it is not there."""
    questions: Annotated[int, Measure("Questions", digits=1, is_amount=True)] = 0
    """Asked of passers-by and answered."""
    asked_in_vain: Annotated[int, Measure(is_amount=True)] = 0
    """Questions with nobody near, which cost none."""
    wrong_answers: Annotated[int, Measure(is_amount=True)] = 0
    """Answers that say something wrong; not those who do not know."""
    strangers_s: Annotated[
        FiniteFloat, Measure("strangers' s", digits=1, is_amount=True)
    ] = 0.0
    """Simulated seconds that passers-by stood and spoke; in `duration_s`, but not against
    the time budget."""
    strangers_tokens: Annotated[int, Measure(is_amount=True)] = 0
    """Of the language model that played passers-by; apart from the agent's `tokens`."""
    strangers_cost_usd: Annotated[FiniteFloat, Measure(is_amount=True)] = 0.0
    """What that cost; apart from the agent's `cost_usd`."""
    by_odometry: bool = False
    """Whether the walk is as the odometry of a body of a user's own tells it, which may
    drift; else it is where the robot truly was."""
    answers_left_m: tuple[FiniteFloat, ...] = ()
    """Shortest walk left to the goal when each answer came, metres."""

    @property
    def claims_arrival(self) -> bool:
        """Whether the agent stopped as one that is there."""
        return self.stopped_by == "agent" and not self.gave_up

    @property
    def is_false_arrival(self) -> bool:
        """Whether the agent stopped as one that is there, and was not."""
        return self.claims_arrival and not self.success


_RESULT = TypeAdapter(EpisodeResult)

MEASURES = tuple(
    replace(told, field=field, name=told.name or field)
    for field, kind in get_type_hints(EpisodeResult, include_extras=True).items()
    for told in getattr(kind, "__metadata__", ())
    if isinstance(told, Measure)
)
"""Whatever summarises, compares or shows results reads this."""


def measure_walk(walk: FinishedWalk) -> dict[str, Any]:
    """Return the fields of a result that are worked out from the walk."""
    return {each.field: each.of_walk(walk) for each in MEASURES if each.of_walk}


def result_to_line(result: EpisodeResult) -> str:
    """Write a result as one line of JSON, without the line end."""
    return json.dumps(asdict(result), ensure_ascii=False, allow_nan=False)


def result_from_line(line: str, place: str) -> EpisodeResult:
    """Read a result from one line of JSON."""
    try:
        return _RESULT.validate_json(line, strict=True)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"]) or "the line"
        if first["type"] == "missing":
            raise RunFolderError(
                f"{place}: expected an episode's result, got one without {field}, made by "
                "another version of memorymaze; run it again"
            ) from None
        raise RunFolderError(
            f"{place}: expected an episode's result, got one where {field} is wrong "
            f"({first['msg']}); delete the line, and --resume runs the episode again"
        ) from None
