"""What determines the results of a run, checked, compared and kept in `run.json`."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

from memorymaze.agents.agent import Need
from memorymaze.basics.errors import SettingsError
from memorymaze.basics.input_files import FileStamp
from memorymaze.basics.options import check_kind, check_number, check_whole, check_word
from memorymaze.basics.wording import counted
from memorymaze.language.models.model_settings import NOT_COMPARED as MODEL_NOT_COMPARED
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.robot.perception.eyes import (
    TRUTH,
    DetectorSettings,
    SignSource,
    parse_detector,
)
from memorymaze.robot.simulation.obstacles import (
    ObstacleSettings,
    PassersBy,
    parse_obstacles,
)
from memorymaze.robot.simulation.senses.noise import NoiseSettings, parse_noise
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.bodies import BodySettings, parse_body
from memorymaze.runs.metrics.success import SUCCESS_DISTANCE
from memorymaze.world.looks import Looks

BudgetBy = Literal["way", "longest"]
WALL_LIMIT = 3600.0
"""Real seconds an episode may take when nobody says otherwise."""
OF_MANY_EPISODES = ("limit", "shard", "split", "second_telling", "wall_limit")
"""Settings that say which episodes a run has, and how long one waits for each."""
Track = Literal["default", "obstacles", "people"]
"""Results of different tracks are not compared: as in the plan; with things and people in
the way; with people one can ask."""


@dataclass(frozen=True, slots=True)
class AnswersTaken(FileStamp):
    """Answers of a language model that were given before the run."""

    missing: int = 0
    """Instructions without any."""
    other_prompt: int = 0
    """Instructions with answers that were given to another version of the prompt."""
    unknown_prompt: int = 0
    """Instructions with answers that do not say to which version they were given."""

    def __str__(self) -> str:
        """Say where the answers come from, and to which prompts they were given."""
        parts = [f"answers given before the run, from {self.name} ({self.sha256[:12]})"]
        if self.missing:
            parts.append(f"{counted(self.missing, 'instruction')} WITHOUT AN ANSWER")
        if self.other_prompt:
            parts.append(
                f"those to {counted(self.other_prompt, 'instruction')} were given to "
                "ANOTHER VERSION OF THE PROMPT"
            )
        if self.unknown_prompt:
            parts.append(
                f"those to {counted(self.unknown_prompt, 'instruction')} do not say to "
                "which version of the prompt they were given"
            )
        return "; ".join(parts)


@dataclass(frozen=True, slots=True)
class AgentSettings:
    """Which agent follows the instructions, and what it is given."""

    name: str
    """A name from `agent_names`, or `module:Class` or `file.py:Class`."""
    options: tuple[tuple[str, str], ...] = ()
    """Names and values of the agent's own options, as they were given."""
    language_model: ModelSettings = field(default_factory=ModelSettings)
    """Which language model it asks, how, and what that may cost."""

    @property
    def is_own(self) -> bool:
        """Whether the agent is a user's own."""
        return ":" in self.name


@dataclass(frozen=True, slots=True)
class Shard:
    """One of several parts of a run, such as the second of eight.

    Raises:
        SettingsError: There is no such part.
    """

    number: int
    """From 1 on."""
    of: int

    def __post_init__(self) -> None:
        """Refuse parts that are none."""
        check_whole("shard", self.number, least=1)
        check_whole("shards", self.of, least=1)
        if self.number > self.of:
            raise SettingsError(
                f"shard: expected one from 1/{self.of} to {self.of}/{self.of}, got {self}"
            )

    def __str__(self) -> str:
        """Return what is given for it: `2/8`."""
        return f"{self.number}/{self.of}"


def parse_shard(text: str) -> Shard:
    """Read `2/8`.

    Raises:
        SettingsError: It says something else.
    """
    number, slash, of = text.partition("/")
    if not (slash and number.isdecimal() and of.isdecimal()):
        raise SettingsError(f"shard: expected one such as 2/8, got {text!r}")
    return Shard(int(number), int(of))


@dataclass(frozen=True, slots=True, kw_only=True)
class RunSettings:
    """How episodes are run, whoever follows which instructions; every part has a default.

    A new setting is a field here, and what it does where it acts: the command line, the
    run folder and comparisons read it from this class. The command line has an option for
    each field with a `metavar`; all others are given with `--with NAME=VALUE`.

    Raises:
        SettingsError: A value has no meaning.
    """

    seed: int = field(default=0, metadata={"metavar": "N"})
    """of all randomness"""
    limit: int | None = field(default=None, metadata={"metavar": "N"})
    """only N episodes; alike many of every route of every study"""
    split: str | None = field(default=None, metadata={"metavar": "NAME"})
    """only this split: dev, test, developed or held_out; dev and test say whether prompts
    may be built from texts, the others are the halves of the participants whose texts were
    and were not read while the agents were developed"""
    shard: Shard | None = field(default=None, metadata={"reader": parse_shard})
    """only the I-th of N parts of the run, alike in size, given as I/N; it lies in the run's
    folder, which is read as one run when all are there (docs/runs.md)"""
    second_telling: bool = False
    """hand the agent both tellings of a way by the same person as one text; people who
    told it once are left out (docs/agents.md)"""
    success_distance: float = SUCCESS_DISTANCE
    """stopping nearer than this to the goal is success, metres"""
    time_budget: float | None = None
    """simulated time of an episode, seconds; none for three times what a perfect follower
    needs for the route that budget_by says"""
    budget_by: BudgetBy = "way"
    """which route the time is worked out from when it is not given: way, the one that an
    instruction describes, or longest, of the run's sites, the same for every episode"""
    obstacles: ObstacleSettings | None = field(
        default=None,
        metadata={"metavar": "LEVEL", "alone": "medium", "reader": parse_obstacles},
    )
    """things and people about: light, medium (alone), heavy; or settings such as
    things=4,density=1,seed=1. Results are a track of their own (docs/robot.md)"""
    noise: NoiseSettings | None = field(
        default=None, metadata={"metavar": "LEVEL", "reader": parse_noise}
    )
    """errors of LiDAR and odometry: light or heavy; or some such as lidar_range_noise=0.02,
    or both as in heavy,lidar_drop_out=0. Those of odometry act with turning_points=lidar
    alone, since the robot knows its place on the plan otherwise; those of scans also on
    agents that take scans (docs/robot.md)"""
    ask: int | None = field(default=None, metadata={"metavar": "N"})
    """the track with people to ask, so many questions; the agent is told the destination's
    name, with 0 that alone, and obstacles are as in medium where none are given
    (docs/agents.md)"""
    passers_by: PassersBy = "memory"
    """with ask: how people answer: memory, with the errors of memory; as a control wrong,
    all of them, or empty, as nobody knows anything; model, the model of --model says what
    they remember"""
    robot: BodySettings | None = field(
        default=None, metadata={"metavar": "NAME", "reader": parse_body}
    )
    """whose body: carla, or module:factory, file.py:factory; its options stand behind it
    (NAME,OPTION=VALUE) or are given with --with; the simulated one where none is given
    (docs/bodies.md)"""
    detector: DetectorSettings = field(
        default=TRUTH, metadata={"reader": parse_detector}
    )
    """what looks for objects: truth, truth:errors or truth:miss=0.2 (with mistakes),
    grounding-dino:CHECKPOINT,box_threshold=0.35 (a model, from the camera's picture), or
    your own as module:Class, file.py:Class,OPTION=VALUE; see docs/seeing.md"""
    signs: SignSource = "truth"
    """how read_signs reads: truth, or ocr (from the camera's picture)"""
    isolate: bool = False
    """run an agent of your own in a process of its own, which has no buildings and cannot
    read plans, corpora and the run's folder"""
    looks: Looks | None = None
    """how things look to cameras: own (where none is given), mesh (PLAN.glb beside the
    plan), or a GLB file with models of yours over our own (docs/seeing.md)"""
    wall_limit: float = WALL_LIMIT
    """real time after which an episode is given up as a crash, seconds"""
    simulation: SimulationSettings = field(default_factory=SimulationSettings)
    """The robot's abilities and the other limits of an episode."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_whole("seed", self.seed, least=0)
        if self.limit is not None:
            check_whole("limit", self.limit, least=1)
        check_number("wall_limit", self.wall_limit, above=0)
        if not (math.isfinite(self.success_distance) and self.success_distance > 0):
            raise SettingsError(
                "success distance: expected more than 0 metres, got "
                f"{self.success_distance!r}"
            )
        own = "by name such as 'file.py:Class'"
        for name, kind, wanted in (
            ("obstacles", ObstacleSettings | None, "ObstacleSettings, a level by name"),
            ("noise", NoiseSettings | None, "NoiseSettings, a level by name"),
            ("robot", BodySettings | None, f"BodySettings, one {own}"),
        ):
            check_kind(name, getattr(self, name), kind, f"{wanted} or None")
        wanted = f"DetectorSettings or one {own}"
        check_kind("detector", self.detector, DetectorSettings, wanted)
        check_word("budget_by", self.budget_by, BudgetBy)
        check_word("passers_by", self.passers_by, PassersBy)
        self._check_asking()
        self._check_body()
        self._check_time()
        self.simulation.check_motion(as_in_plan=self.obstacles is None)
        check_word("signs", self.signs, SignSource)

    @property
    def track(self) -> Track:
        """The track that results belong to."""
        if self.ask is not None:
            return "people"
        return "default" if self.obstacles is None else "obstacles"

    def changed(self, names: Iterable[str]) -> list[str]:
        """Return those of these settings that are not as by default, the simulation's too."""
        plain = RunSettings()
        return [each for each in names if self._named(each) != plain._named(each)]

    def check_budget(self, of_corpus: float | None = None) -> None:
        """Refuse a time budget beside `budget_by`; one that comes with a corpus may be."""
        if self.budget_by != "way" and self.time_budget not in (None, of_corpus):
            raise SettingsError(
                f"budget_by: expected way beside a time_budget, got {self.budget_by} and "
                f"time_budget {self.time_budget}; leave one of them out"
            )

    def _named(self, name: str) -> Any:
        return getattr(self if hasattr(self, name) else self.simulation, name)

    def _check_body(self) -> None:
        """Refuse what is of the simulated body where there is another one."""
        if self.robot is None:
            return
        of_simulation = ("obstacles", "noise", "motion", "wheel_noise", "looks")
        for name in self.changed(of_simulation):
            raise SettingsError(
                f"{name}: is of the simulated robot and its building, and --robot "
                f"{self.robot.name} has its own; leave one of them out"
            )

    def _check_time(self) -> None:
        """Refuse a time budget in the place where a run puts its own."""
        budget = self.simulation.time_budget
        if budget != SimulationSettings().time_budget:
            raise SettingsError(
                "simulation.time_budget: expected it left out, since a run has its own, got "
                f"{budget}; give time_budget of RunSettings"
            )

    def _check_asking(self) -> None:
        """See that there are people to ask, the usual ones where nobody says which."""
        if self.ask is None:
            if self.passers_by != "memory":
                raise SettingsError(
                    f"passers_by: {self.passers_by!r} is of the track with people one can "
                    "ask; add ask (--ask N), a number of questions"
                )
            return
        check_whole("ask", self.ask, least=0)
        if self.obstacles is None:
            object.__setattr__(self, "obstacles", ObstacleSettings())
        elif self.obstacles.people == 0 or (
            self.obstacles.people is None and not self.obstacles.people_per_100m2
        ):
            raise SettingsError(
                "ask: expected obstacles with people, got none to ask; give --obstacles a "
                "density or a number of people, or leave it out"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class RunDefinition(RunSettings):
    """Settings that leave nothing open, with all else that determines a run's results.

    All but the code, that is; where two differ, the runs are two.
    """

    agent: AgentSettings
    needs: tuple[Need, ...] = ()
    """What the agent declares that it needs, sorted."""
    agent_files: tuple[FileStamp, ...] = ()
    """Of an agent of a user's own: its file and those beside it that it imports."""
    robot_files: tuple[FileStamp, ...] = ()
    """The same of a robot's body."""
    detector_files: tuple[FileStamp, ...] = ()
    """The same of a detector."""
    looks_files: tuple[FileStamp, ...] = ()
    """The file with models of a user's own that cameras show."""
    option_values: tuple[tuple[str, str], ...] = ()
    """All options of the agent as it has them, also those that nobody gave."""
    instructions: tuple[FileStamp, ...]
    sites: tuple[FileStamp, ...]
    episodes: int
    """Episodes of the whole run."""
    told_once: int = 0
    """Texts that are left out because their person told the way only once."""
    answers: AnswersTaken | None = None
    """Answers that were given before; None where a model is asked."""

    def _check_time(self) -> None:
        """Refuse a time budget that no file can hold."""
        if not math.isfinite(self.simulation.time_budget):
            raise SettingsError(
                "time budget: expected a finite number of seconds, got "
                f"{self.simulation.time_budget!r}"
            )

    @property
    def scales_budget(self) -> bool:
        """Whether each episode has the time that its own way takes."""
        return self.time_budget is None and self.budget_by == "way"


NOT_COMPARED = {
    "time_budget",
    "wall_limit",
    *(f"agent.language_model.{name}" for name in MODEL_NOT_COMPARED),
}
"""The time budget as it was asked for, since what came of it is in `simulation`; how long
one waits for hung episodes; and how answers are come by."""


@dataclass(frozen=True, slots=True)
class Difference:
    """A setting that two runs do not share; in text `seed: 0 there, 1 here`."""

    kind: str
    """`site`, `agent file` (or robot's, detector's) or `agent option`; else the field of
    `RunDefinition`."""
    name: str
    there: Any
    """None where that run does not have it."""
    here: Any
    """None where this run does not have it."""

    def __str__(self) -> str:
        """Say what each of the runs has."""
        return f"{self.name}: {self.there!r} there, {self.here!r} here"


def differences(old: RunDefinition, new: RunDefinition) -> list[Difference]:
    """Return the settings in which two runs differ."""
    before, after = (
        {(kind, name): value for kind, name, value in _flat(asdict(run))}
        for run in (old, new)
    )
    not_compared = set(NOT_COMPARED)
    if old.scales_budget and new.scales_budget:
        # That of the longest route of all, which limits no episode.
        not_compared.add("simulation.time_budget")
    elif old.scales_budget != new.scales_budget:
        # The one of the longest route may be what the other one gives to each.
        not_compared.discard("time_budget")
    return [
        Difference(kind, name, before.get((kind, name)), after.get((kind, name)))
        for kind, name in {**before, **after}
        if name not in not_compared
        and before.get((kind, name)) != after.get((kind, name))
    ]


def _flat(
    value: Mapping[str, Any], field: str | None = None, prefix: str = ""
) -> Iterator[tuple[str, str, Any]]:
    """Yield kind, name and value of each setting."""
    for name, part in value.items():
        if name == "instructions":
            for number, stamp in enumerate(part):
                told = f"{stamp['name']} {stamp['sha256'][:12]}"
                yield name, f"{name}[{number}]", told
        elif name == "sites":
            for stamp in part:
                yield "site", f"site {stamp['name']}", stamp["sha256"][:12]
        elif name in {"agent_files", "robot_files", "detector_files", "looks_files"}:
            kind = name.partition("_")[0]
            for stamp in part:
                told = f"{kind}.file {stamp['name']}"
                yield f"{kind} file", told, stamp["sha256"][:12]
        elif name in {"options", "option_values"} and not isinstance(part, str):
            for option, given in part:
                told = f"agent.options.{option.replace('-', '_')}"
                yield "agent option", told, given
        elif isinstance(part, Mapping):
            yield from _flat(part, field or name, f"{prefix}{name}.")
        else:
            yield field or name, prefix + name, part
