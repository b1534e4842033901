"""An episode's trace as a story: the walk, what was called and seen, what was understood.

What agents and models wrote is kept as text and never trusted.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.drawing.shapes import ThingInTheWay
from memorymaze.errors import RunFolderError
from memorymaze.geometry.trajectory import TimedPose, Trajectory
from memorymaze.results.story.events import Event, events_of
from memorymaze.results.story.understanding import Understanding, understood

LARGEST = 1e6
"""Metres, seconds and radians of a story; larger numbers cannot be drawn."""
NOT_OURS = (
    KeyError,
    IndexError,
    TypeError,
    ValueError,
    OverflowError,
    AttributeError,
    RecursionError,
)
"""Errors in reading entries that no episode leaves."""


@dataclass(frozen=True, slots=True, eq=False)
class Story:
    """What a reader sees of an episode of one run."""

    entries: tuple[Mapping[str, Any], ...]
    """The trace, see `docs/data_formats.md`."""
    walk: Trajectory
    events: tuple[Event, ...]
    """In the order of the trace."""
    understanding: Understanding
    instruction: str | None
    """The text as the trace has it."""
    things: dict[str, ThingInTheWay]
    """Left in the way, by id; only in runs with obstacles."""
    people: dict[str, NDArray[np.float64]]
    """Who walked about: times, x and y, shape (3, N)."""


def story_of(entries: Iterable[Mapping[str, Any]], place: str) -> Story:
    """Read the entries of a trace.

    Args:
        entries: Of the trace, from the first to the last.
        place: Its file, for errors.

    Raises:
        RunFolderError: The entries are none that an episode leaves.
    """
    listed = tuple(entries)
    try:
        poses = next(each["poses"] for each in listed if each["kind"] == "trajectory")
        opening = listed[0].get("instruction")
        return Story(
            entries=listed,
            walk=Trajectory([TimedPose(*map(_number, pose)) for pose in poses]),
            events=tuple(map(_checked, events_of(listed))),
            understanding=understood(listed),
            instruction=opening if isinstance(opening, str) else None,
            things={
                thing["object_id"]: ThingInTheWay(
                    str(thing["category"]),
                    *map(_number, thing["pose"]),
                    *map(_number, thing["size"][:2]),
                )
                for entry in listed
                if entry["kind"] == "things"
                for thing in entry["things"]
            },
            people={
                name: _places(walk)
                for entry in listed
                if entry["kind"] == "people"
                for name, walk in entry["walks"].items()
            },
        )
    except StopIteration:
        raise RunFolderError(f"{place}: expected a trajectory, got none") from None
    except NOT_OURS as error:
        raise RunFolderError(
            f"{place}: expected entries as memorymaze writes them, got others "
            f"({type(error).__name__}: {error})"
        ) from None


def _number(value: Any) -> float:
    """Return a number that can be drawn."""
    if not abs(float(value)) <= LARGEST:
        raise ValueError(f"expected a number up to {LARGEST:.0e}, got {value!r}")
    return float(value)


def _places(walk: Any) -> NDArray[np.float64]:
    places = np.array([[_number(number) for number in place] for place in walk])
    if places.ndim != 2 or places.shape[1] != 3:
        raise ValueError(f"expected times and places of a person, got {places.shape}")
    return places.T


def _checked(event: Event) -> Event:
    for number in (event.time, *(number for each in event.seen for number in each[:2])):
        _number(number)
    return event
