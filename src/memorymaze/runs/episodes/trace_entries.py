"""The entries of a trace: what writes them makes these records, what reads them gets these.

Their fields are those of the lines on disk; see `docs/formats.md`.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cache
from itertools import pairwise
from typing import Annotated, Any, Literal, TypeVar, cast

from pydantic import AfterValidator, Field, TypeAdapter

from memorymaze.agents.notes import Note, TracebackNote, note_of
from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.robot.api.control import Detection, MoveResult, SignText, TurnResult
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.steering.calls import TraceEvent
from memorymaze.runs.episodes.settings import RunDefinition
from memorymaze.texts.corpus.records import Episode
from memorymaze.texts.passers_by import Asked
from memorymaze.texts.passers_by.memory import Truth
from memorymaze.world.drawing.shapes import ThingInTheWay

LARGEST = 1e6
"""Metres, seconds and radians of an entry that is read; larger ones cannot be drawn."""

_Number = Annotated[float, Field(ge=-LARGEST, le=LARGEST, allow_inf_nan=False)]
PoseNumbers = tuple[_Number, _Number, _Number]
"""x, y and heading."""


Found = TypeVar("Found", Detection, SignText)


def _in_order(
    poses: list[tuple[float, float, float, float]],
) -> list[tuple[float, float, float, float]]:
    if any(after[0] < before[0] for before, after in pairwise(poses)):
        raise ValueError("times run backwards")
    return poses


@dataclass(frozen=True, slots=True)
class OpeningEntry:
    """What is followed, from where, by whom; and where to, if the agent is told."""

    episode_id: str
    agent: str
    site: str
    route: str
    reference_route: str
    instruction: str
    instruction_source: str
    start: PoseNumbers
    goal: tuple[_Number, _Number]
    seed: int
    destination: str | None = None
    kind: Literal["episode"] = "episode"


@dataclass(frozen=True, slots=True)
class CallEntry:
    """What was called, where the robot was then, and what came of it."""

    time: _Number
    pose: PoseNumbers
    call: str
    arguments: Mapping[str, Any]
    result: Any
    """Detections, texts of signs, moves and turns as records of the control API, other
    things as JSON knows them; `{"error": …}` where the call was refused."""
    kind: Literal["call"] = "call"

    def found(self, kind: type[Found]) -> list[Found]:
        """Return what it saw or read, where it was a look for such."""
        found = cast(list[object], self.result) if isinstance(self.result, list) else []
        return [each for each in found if isinstance(each, kind)]


@dataclass(frozen=True, slots=True)
class NoteEntry:
    """What the agent noted."""

    time: _Number
    about: str
    details: Mapping[str, Any]
    """Beside these fields in a line."""
    kind: Literal["note"] = "note"

    @property
    def note(self) -> Note:
        """The record of agents' notes that it is."""
        return note_of(self.about, self.details)


@dataclass(frozen=True, slots=True)
class AnswerEntry:
    """What was true of a passer-by's answer; the words are in the call before."""

    time: _Number
    """When the question was put."""
    place: tuple[_Number, _Number]
    person: str
    reliable: bool | None
    truth: Truth
    error: str
    """What is wrong with it; empty where nothing is."""
    seconds: _Number
    model: str | None = None
    """Language model that put it into words, where one did."""
    tokens: int | None = None
    cost_usd: float | None = None
    kind: Literal["passer_by"] = "passer_by"


@dataclass(frozen=True, slots=True)
class ThingLeft:
    """A thing in the way that no plan has."""

    object_id: str
    category: str
    size: tuple[_Number, _Number, _Number]
    """Length across the front, depth, height."""
    pose: PoseNumbers

    @property
    def shape(self) -> ThingInTheWay:
        """How it is drawn."""
        return ThingInTheWay(self.category, *self.pose, *self.size[:2])


@dataclass(frozen=True, slots=True)
class ThingsEntry:
    """What was left in the way."""

    things: Sequence[ThingLeft]
    kind: Literal["things"] = "things"


@dataclass(frozen=True, slots=True)
class PeopleEntry:
    """Who walked about."""

    columns: Sequence[str]
    walks: Mapping[str, Annotated[Sequence[PoseNumbers], Field(min_length=1)]]
    """Time, x and y, by person."""
    kind: Literal["people"] = "people"


@dataclass(frozen=True, slots=True)
class NearMissEntry:
    """That a person came close."""

    time: _Number
    pose: PoseNumbers
    object_id: str
    """Of the person."""
    gap: _Number
    """The least, metres."""
    kind: Literal["near_miss"] = "near_miss"


@dataclass(frozen=True, slots=True)
class CollisionEntry:
    """What the robot touched."""

    time: _Number
    pose: PoseNumbers
    with_: Annotated[str, Field(alias="with")]
    object_id: str | None
    kind: Literal["collision"] = "collision"


@dataclass(frozen=True, slots=True)
class TrajectoryEntry:
    """Where the robot went."""

    columns: Sequence[str]
    poses: Annotated[
        list[tuple[_Number, _Number, _Number, _Number]],
        Field(min_length=1),
        AfterValidator(_in_order),
    ]
    kind: Literal["trajectory"] = "trajectory"


@dataclass(frozen=True, slots=True)
class EndEntry:
    """Why the episode ended."""

    time: _Number
    stopped_by: str
    error: str | None
    kind: Literal["end"] = "end"


TraceEntry = (
    OpeningEntry
    | CallEntry
    | NoteEntry
    | AnswerEntry
    | ThingsEntry
    | PeopleEntry
    | NearMissEntry
    | CollisionEntry
    | TrajectoryEntry
    | EndEntry
)


# Lines.


def line_of(entry: TraceEntry) -> dict[str, Any]:
    """Return the fields of an entry's line; what nothing is told of is left out."""
    if isinstance(entry, NoteEntry):
        line = {"kind": entry.kind, "time": entry.time, "about": entry.about}
        # What an agent calls as the entry's own fields are called is written beside them.
        told = entry.details.items()
        return line | {
            f"{name}_" if name in line else name: what for name, what in told
        }
    line: dict[str, Any] = {"kind": entry.kind}
    for name, written, is_left_out in _fields_of(type(entry)):
        value = getattr(entry, name)
        if value is not None or not is_left_out:
            line[written] = value
    return line


@cache
def _fields_of(kind: type[TraceEntry]) -> tuple[tuple[str, str, bool], ...]:
    """Return names, what they are in a line, and whether None is left out there."""
    return tuple(
        (each.name, each.name.rstrip("_"), each.default is None)
        for each in fields(kind)
    )


def read_entry(line: object) -> TraceEntry:
    """Return the entry of a line; `ValidationError` for a line that no episode leaves."""
    if isinstance(line, dict):
        told = cast(dict[str, Any], line)
        if told.get("kind") == "note":
            own = {
                name: told[name] for name in ("kind", "time", "about") if name in told
            }
            rest = {name: what for name, what in told.items() if name not in own}
            line = own | {"details": rest}
        elif told.get("kind") == "call" and told.get("call") in _RESULTS:
            result = _RESULTS[told["call"]].validate_python(told.get("result"))
            line = told | {"result": result}
    return _ENTRY.validate_python(line)


def _drawable(found: Detection) -> Detection:
    if not max(abs(found.distance), abs(found.bearing_deg)) <= LARGEST:
        raise ValueError(f"expected numbers up to {LARGEST:.0e}")
    return found


_ENTRY: TypeAdapter[TraceEntry] = TypeAdapter(
    Annotated[TraceEntry, Field(discriminator="kind")]
)
_REFUSED = dict[str, str]
_RESULTS: Mapping[str, TypeAdapter[Any]] = {
    "detect_from_RGB_image": TypeAdapter(
        list[Annotated[Detection, AfterValidator(_drawable)]] | _REFUSED
    ),
    "read_signs": TypeAdapter(list[SignText] | _REFUSED),
    "move_forward": TypeAdapter(MoveResult | _REFUSED),
    "follow": TypeAdapter(MoveResult | _REFUSED),
    "turn": TypeAdapter(TurnResult | _REFUSED),
    "turn_by": TypeAdapter(TurnResult | _REFUSED),
}
"""What calls return that return records; by the name of the call."""


# What an episode writes.


def opening_entry(
    name: str, episode: Episode, settings: RunDefinition, destination: str | None
) -> OpeningEntry:
    """Say what an agent follows, and where to, if it is told."""
    told = episode.instruction
    return OpeningEntry(
        episode_id=episode.id,
        agent=name,
        site=told.site,
        route=told.route,
        reference_route=told.reference_route,
        instruction=told.text,
        instruction_source=told.source,
        start=episode.start,
        goal=episode.goal,
        seed=settings.seed,
        destination=destination,
    )


def call_entry(event: TraceEvent) -> CallEntry:
    """Say what was called, where, and what came of it."""
    pose = _rounded(event.pose)
    return CallEntry(
        round(event.time, 3), pose, event.call, event.arguments, event.result
    )


def note_entry(now: float, note: Note) -> NoteEntry:
    """Say what the agent wrote down, and when."""
    return NoteEntry(round(now, 3), note.about, note.details)


def answer_entry(asked: Asked) -> AnswerEntry:
    """Say what was true of an answer."""
    x, y = asked.place
    by_model = asked.model is not None
    return AnswerEntry(
        time=asked.time,
        place=(round(x, 3), round(y, 3)),
        person=asked.person,
        reliable=asked.reliable,
        truth=asked.truth,
        error=asked.error,
        seconds=asked.seconds,
        model=asked.model,
        tokens=asked.tokens if by_model else None,
        cost_usd=asked.cost_usd if by_model else None,
    )


def surroundings_entries(robot: SimulatedRobot) -> list[TraceEntry]:
    """Say what stood in the way and who came close; nothing in the default track."""
    if robot.surroundings is None:
        return []
    things = [
        ThingLeft(
            each.record.id, each.record.category, each.record.size, _rounded(each.pose)
        )
        for each in robot.surroundings.things
    ]
    near = [
        NearMissEntry(
            round(each.time, 3), _rounded(each.pose), each.person, round(each.gap, 3)
        )
        for each in robot.near_misses
    ]
    walks: dict[str, list[PoseNumbers]] = {}
    for time, person, x, y in robot.surroundings.walked:
        walks.setdefault(person, []).append(_rounded((time, x, y)))
    people = [PeopleEntry(("time", "x", "y"), walks)] if walks else []
    return [ThingsEntry(things), *people, *near]


def closing_entries(
    robot: SimulatedRobot, walk: Trajectory, ended: str, error: str | None
) -> list[TraceEntry]:
    """Say what was touched, where the robot went, and why it ended."""
    collisions = [
        CollisionEntry(
            round(touch.time, 3), _rounded(touch.pose), touch.kind, touch.object_id
        )
        for touch in robot.collisions
    ]
    poses = [
        (round(time, 3), round(x, 3), round(y, 3), round(heading, 3))
        for time, x, y, heading in walk.poses
    ]
    columns = ("time", "x", "y", "heading")
    return [
        *collisions,
        TrajectoryEntry(columns, poses),
        EndEntry(robot.time, ended, error),
    ]


def _rounded(numbers: tuple[float, float, float]) -> PoseNumbers:
    """Return a pose to the millimetre, which is finer than anything depends on."""
    first, second, third = numbers
    return round(first, 3), round(second, 3), round(third, 3)


# What is asked of a trace.


def kept_traceback(trace: Iterable[TraceEntry]) -> Sequence[str]:
    """Return the lines of the traceback in a trace; none where none is."""
    for entry in trace:
        if isinstance(entry, NoteEntry) and isinstance(entry.note, TracebackNote):
            return entry.note.lines
    return ()
