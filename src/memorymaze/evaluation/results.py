"""What came of one episode, as a flat record and as a line of JSON."""

import json
from dataclasses import asdict, dataclass
from typing import Literal

from pydantic import FiniteFloat, TypeAdapter, ValidationError

from memorymaze.errors import RunFolderError
from memorymaze.instructions.records import Followers

StoppedBy = Literal["agent", "budget", "stuck", "crash", "unsafe", "model_error"]
"""Who or what ended an episode; only `agent` can be a success."""


@dataclass(frozen=True, slots=True)
class EpisodeResult:
    """What came of one episode; one line of `episodes.jsonl`.

    Fields with a default are not in the lines of runs by older versions.
    """

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
    success: bool
    """Stopped by itself, nearer to the goal than the success distance."""
    oracle_success: bool
    """Was at any moment nearer to the goal than the success distance."""
    spd: FiniteFloat
    """Shortest walk from where the robot stands at the end to the goal, metres."""
    cls: FiniteFloat
    """Coverage weighted by length score, 0 to 1."""
    spl: FiniteFloat
    ndtw: FiniteFloat
    sdtw: FiniteFloat
    path_length: FiniteFloat
    """Metres driven."""
    collisions: int
    turns_in_order: FiniteFloat
    """Share of the reference route's turns that were taken, in their order, 0 to 1."""
    duration_s: FiniteFloat
    """Simulated seconds."""
    wall_s: FiniteFloat
    """Real seconds; the only field that differs between equal runs."""
    api_calls: int
    """Calls of the robot's control API."""
    model_calls: int
    tokens: int
    cost_usd: FiniteFloat
    error: str | None
    """One line on what went wrong, for the endings that are errors."""
    person_collisions: int = 0
    """Of the collisions those with people."""
    near_misses: int = 0
    """Times a person and the robot were closer than 0.3 m."""
    waiting_s: FiniteFloat = 0.0
    """Simulated seconds the robot stood because people were in the way."""
    refused_turns: int = 0
    """Calls of `turn` that found no way in that direction, or were no direction."""
    inference_s: FiniteFloat = 0.0
    """Real seconds that the language model took for its replies."""
    standing_s: FiniteFloat = 0.0
    """Simulated seconds the user stood while the model thought; in `duration_s`, but
    not against the time budget."""
    followers: Followers | None = None
    """How people fared who followed the instruction, where its corpus tells."""
    error_kinds: tuple[str, ...] | None = None
    """Kinds of the significant errors in the instruction; None in older runs."""
    pair: str | None = None
    """Shared with the same instruction without, or with, its errors."""


_RESULT = TypeAdapter(EpisodeResult)


def result_to_line(result: EpisodeResult) -> str:
    """Write a result as one line of JSON, without the line end.

    Raises:
        ValueError: A number is not finite.
    """
    return json.dumps(asdict(result), ensure_ascii=False, allow_nan=False)


def result_from_line(line: str, place: str) -> EpisodeResult:
    """Read a result from one line of JSON.

    Raises:
        RunFolderError: The line is not an episode's result; names place and field.
    """
    try:
        return _RESULT.validate_json(_renamed(line), strict=True)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"]) or "the line"
        raise RunFolderError(
            f"{place}: expected an episode's result, got one where {field} is wrong "
            f"({first['msg']}); delete the line, and --resume runs the episode again"
        ) from None


def _renamed(line: str) -> str:
    """Return a line with the fields of older versions as they are now."""
    if '"human_trials"' not in line:
        return line
    try:
        content = json.loads(line)
        told = [content.pop(name) for name in ("usable", "human_trials", "human_found")]
    except (AttributeError, KeyError, TypeError, ValueError):
        # What is wrong with it, checking says.
        return line
    if told[0] is not None:
        content["followers"] = dict(
            zip(("usable", "tried", "arrived"), told, strict=True)
        )
    return json.dumps(content)
