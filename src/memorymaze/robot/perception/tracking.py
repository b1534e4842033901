"""Which of the things seen now were seen before, by where they stand."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

LEAST_GATE = 0.3
"""Metres; how far the middle of a small thing may seem to have moved."""


class SingleSighting(NamedTuple):
    """A thing as it was seen once."""

    kind: str
    """What it is; things of different kinds are never the same."""
    position: tuple[float, float]
    """Its middle in the world, metres."""
    length: float
    """Its longer side on the floor, metres."""


@dataclass(slots=True)
class _Track:
    kind: str
    position: tuple[float, float]
    sightings: int


class Tracker:
    """Gives each thing one number for as long as the tracker lives.

    A sighting is a thing seen before when it is of the same kind and its middle lies
    within half its length (at least `LEAST_GATE`) of where that thing stands: two
    things of one kind cannot stand inside each other. So two bins side by side stay
    two, and a door is the same from both ends of the corridor. The things of one look
    are all different.
    """

    def __init__(self) -> None:
        """Begin with nothing seen."""
        self._tracks: list[_Track] = []

    def update(self, sightings: Sequence[SingleSighting]) -> list[int]:
        """Return the numbers of the things seen in one look, from 1 up, in order."""
        pairs = sorted(
            (distance, number, index)
            for index, sighting in enumerate(sightings)
            for number, track in enumerate(self._tracks)
            if track.kind == sighting.kind
            and (distance := math.dist(track.position, sighting.position))
            <= max(LEAST_GATE, sighting.length / 2)
        )
        matched: dict[int, int] = {}
        taken: set[int] = set()
        for _, number, index in pairs:
            if index not in matched and number not in taken:
                matched[index] = number
                taken.add(number)
        for index, sighting in enumerate(sightings):
            if index in matched:
                self._note(self._tracks[matched[index]], sighting)
            else:
                matched[index] = len(self._tracks)
                self._tracks.append(_Track(sighting.kind, sighting.position, 1))
        return [matched[index] + 1 for index in range(len(sightings))]

    @staticmethod
    def _note(track: _Track, sighting: SingleSighting) -> None:
        """Move a track to the mean of all its sightings."""
        track.sightings += 1
        share = 1 / track.sightings
        x, y = track.position
        new_x, new_y = sighting.position
        track.position = (x + share * (new_x - x), y + share * (new_y - y))
