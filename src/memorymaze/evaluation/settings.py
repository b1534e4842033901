"""What determines the results of a run, checked, compared and kept in `run.json`."""

import hashlib
import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from memorymaze.errors import SettingsError
from memorymaze.evaluation.asking import PATIENT, AskingSettings
from memorymaze.evaluation.inference_time import MEASURED, InferenceTime
from memorymaze.options import check_whole
from memorymaze.perception.eyes import TRUTH, DetectorSettings, SignSource
from memorymaze.pictures.furniture.cache import Looks
from memorymaze.simulation.obstacles import ObstacleSettings
from memorymaze.simulation.settings import SimulationSettings


@dataclass(frozen=True, slots=True)
class FileStamp:
    """A file as it was when the run began."""

    name: str
    sha256: str


@dataclass(frozen=True, slots=True)
class AgentSettings:
    """Which agent follows the instructions, and what it is given."""

    name: str
    """A name from `AGENTS`, `oracle`, or `module:Class` or `file.py:Class`."""
    model: str | None = None
    """Language model; None for the agent's default, or where it needs none."""
    parser: bool | None = None
    """Whether instructions are parsed first; None for agents without that choice."""
    base_url: str | None = None
    """Server of the language model."""
    record: str | None = None
    """File that the model's replies are written to."""
    replay: str | None = None
    """File that replies are read from instead of asking a model."""
    options: tuple[tuple[str, str], ...] = ()
    """Names and values of the agent's own options, as they were given."""
    asking: AskingSettings = PATIENT
    """How the language model is asked, and what may be spent on it."""
    inference_time: InferenceTime = MEASURED
    """How long the robot stands while the model thinks."""
    programs: str | None = None
    """File of programs that are run instead of asking a model."""

    @property
    def is_own(self) -> bool:
        """Whether the agent is a user's own."""
        return ":" in self.name


@dataclass(frozen=True, slots=True)
class RunSettings:
    """All that determines a run's results, besides the code.

    Raises:
        SettingsError: A value has no meaning.
    """

    agent: AgentSettings
    instructions: tuple[FileStamp, ...]
    sites: tuple[FileStamp, ...]
    seed: int
    limit: int | None
    """Episodes to run, alike many of every route of every study; None for all."""
    episodes: int
    """Episodes of the whole run."""
    success_distance: float
    """Metres from the goal within which stopping is success."""
    simulation: SimulationSettings
    """The robot's abilities, and the budgets of an episode."""
    obstacles: ObstacleSettings | None = None
    """Things in the way and people; None for buildings as in their plans."""
    detector: DetectorSettings = TRUTH
    """Eyes of `detect_from_RGB_image`."""
    signs: SignSource = "truth"
    """Where `read_signs` knows texts from."""
    programs: FileStamp | None = None
    """Programs that were written elsewhere; None where a model is asked."""
    split: str | None = None
    """Split of the instructions that the run is on; None for all."""
    looks: Looks | None = None
    """How things look to the cameras; None for runs without."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_whole("seed", self.seed, least=0)
        if self.limit is not None:
            check_whole("limit", self.limit, least=1)
        if not (math.isfinite(self.success_distance) and self.success_distance > 0):
            raise SettingsError(
                "success distance: expected more than 0 metres, got "
                f"{self.success_distance!r}"
            )
        if not math.isfinite(self.simulation.time_budget):
            raise SettingsError(
                "time budget: expected a finite number of seconds, got "
                f"{self.simulation.time_budget!r}"
            )


def stamp_file(path: str | Path, name: str | None = None) -> FileStamp:
    """Return a file's name and fingerprint."""
    path = Path(path)
    return FileStamp(name or path.name, hashlib.sha256(path.read_bytes()).hexdigest())


NOT_COMPARED = {
    "agent.base_url",
    "agent.record",
    "agent.replay",
    "agent.programs",
    "agent.asking.timeout",
    "agent.asking.retries",
    "agent.asking.max_requests",
    "agent.asking.max_cost",
    "agent.asking.max_tokens_total",
    "agent.asking.shared_folder",
    "agent.asking.threads",
}
"""Where replies come from and go to, and how patiently and how long they are asked for,
which does not change what they say."""


def differences(old: RunSettings, new: RunSettings) -> list[str]:
    """Say in which settings two runs differ: `seed: 0 there, 1 here`."""
    before, after = dict(_flat(asdict(old))), dict(_flat(asdict(new)))
    names = [f for f in {**before, **after} if f not in NOT_COMPARED]
    return [
        f"{name}: {before.get(name)!r} there, {after.get(name)!r} here"
        for name in names
        if before.get(name) != after.get(name)
    ]


def _flat(value: Mapping[str, Any], prefix: str = "") -> Iterable[tuple[str, Any]]:
    for name, part in value.items():
        if name in {"instructions", "sites"}:
            for number, stamp in enumerate(part):
                yield f"{name}[{number}]", f"{stamp['name']} {stamp['sha256'][:12]}"
        elif name == "options":
            for option, given in part:
                yield f"{prefix}{name}.{option.replace('-', '_')}", given
        elif isinstance(part, Mapping):
            yield from _flat(part, f"{prefix}{name}.")
        else:
            yield prefix + name, part
