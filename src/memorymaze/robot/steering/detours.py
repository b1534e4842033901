"""How much room there is beside a line, and detours to where it is.

Detours are the cheapest sideways steps beside a line, found by a lattice: a station every
20 cm along the line, offsets every 5 cm across it. Dynamic programming weighs distance
from the line, sideways steps and nearness to things; every detour leaves the line and
comes back to it.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from memorymaze.basics.geometry import polyline
from memorymaze.basics.geometry.points import FloatArray

CLEARANCE_RANGE = 1.0
"""Metres; distances are measured up to here."""
SPACING = 0.2
"""Metres between stations."""
DETOUR_WIDTH = 2.0
"""Greatest sideways distance from the line, metres."""
RUN_UP = 4.0
"""Metres before and behind an obstacle that a detour may use."""
ON_LINE = 0.06
"""Metres from the wanted offset within which the robot is back on its line."""
BESIDE_LINE = 0.6
"""Greatest offset in metres at which a lane may end whose line stays blocked."""
WORTHWHILE = 1.0
"""Metres that ending beside the line must gain over halting on it."""
COMFORT = 0.5
"""Distance in metres to things from which on more room is no better."""
OFFSET_STEP = 0.05
MOST_STEPS = 4
"""Offsets from one station to the next at most; 45 degrees."""


class FreeSpace(Protocol):
    """How much room there is around points of a floor, by a plan or by scans."""

    def to_walls(self, points: FloatArray) -> FloatArray:
        """Return distances of points (N, 2) to the nearest wall, metres, shape (N,).

        At most `CLEARANCE_RANGE`; 0 where there is no floor.
        """
        ...

    def to_anything(self, points: FloatArray) -> FloatArray:
        """Return distances to the nearest wall or obstacle, as `to_walls` does."""
        ...

    def is_free(self, line: Sequence[tuple[float, float]], radius: float) -> bool:
        """Whether a disc of this radius, metres, can be moved along a line."""
        ...


def make_detours(
    base: FloatArray,
    normals: FloatArray,
    offsets: FloatArray,
    needed: float,
    least: FloatArray,
    clearance: FreeSpace,
) -> tuple[FloatArray, int]:
    """Change offsets from a line so that it keeps clear of everything.

    The line's stations (N, 2) are `SPACING` apart, its normals point to the left, the
    wanted offsets (N,) are metres to the left, and the first is kept. Every station
    should have the clearance `needed`, and each must have its own `least` (N,).

    Returns the new offsets and how many stations can be reached; offsets behind those
    have no meaning.
    """
    result = offsets.copy()
    reachable = len(base)
    margin = round(RUN_UP / SPACING)
    begin = 0
    while begin < reachable:
        room = clearance.to_anything(
            base[begin:] + result[begin:, None] * normals[begin:]
        )
        tight = np.flatnonzero(room < needed) + begin
        if not len(tight):
            break
        first = max(int(tight[0]) - margin, begin)
        last = int(tight[0])
        for station in tight.tolist():
            if station > last + 2 * margin:
                break
            last = station
        stop = min(last + margin + 1, len(base))
        piece = slice(first, stop)
        found = _cheapest(
            base[piece], normals[piece], result[piece], needed, least[piece], clearance
        )
        result[first : first + len(found)] = found
        if len(found) < stop - first:
            reachable = first + len(found)
        begin = stop
    return result, reachable


def _cheapest(
    base: FloatArray,
    normals: FloatArray,
    wanted: FloatArray,
    needed: float,
    least: FloatArray,
    clearance: FreeSpace,
) -> FloatArray:
    """Return the offsets of the cheapest way, as far as there is one."""
    half = round(DETOUR_WIDTH / OFFSET_STEP)
    lattice = np.arange(-half, half + 1) * OFFSET_STEP
    count, width = len(base), len(lattice)
    start = int(np.argmin(np.abs(lattice - wanted[0])))
    places = base[:, None, :] + lattice[None, :, None] * normals[:, None, :]
    room = clearance.to_anything(places.reshape(-1, 2)).reshape(count, width)
    price = (lattice[None, :] - wanted[:, None]) ** 2
    price += 20.0 * np.maximum(COMFORT - room, 0.0) ** 2
    price[room < needed] += 100.0
    price[room < least[:, None]] = np.inf
    cost = np.full(width, np.inf)
    cost[start] = 0.0
    origins = np.zeros((count, width), dtype=np.intp)
    aside = np.abs(lattice[None, :] - wanted[:, None])
    # The last station reached on the line, and within reach of it, with its column.
    on_line, beside = (0, start), (0, start)
    columns = np.arange(width)
    for station in range(1, count):
        padded = np.full(width + 2 * MOST_STEPS, np.inf)
        padded[MOST_STEPS:-MOST_STEPS] = cost
        moves = np.stack([
            padded[k : k + width] + 20.0 * ((k - MOST_STEPS) * OFFSET_STEP) ** 2
            for k in range(2 * MOST_STEPS + 1)
        ])
        choice = np.argmin(moves, axis=0)
        origins[station] = np.clip(columns + choice - MOST_STEPS, 0, width - 1)
        cost = moves[choice, columns] + price[station]
        if not np.isfinite(cost).any():
            break
        for limit in (ON_LINE, BESIDE_LINE):
            near = np.where(aside[station] <= limit, cost, np.inf)
            best = int(np.argmin(near))
            if np.isfinite(near[best]):
                if limit == ON_LINE:
                    on_line = station, best
                beside = station, best
    gain = (beside[0] - on_line[0]) * SPACING
    last, column = beside if gain >= WORTHWHILE else on_line
    chosen = np.zeros(last + 1)
    for station in range(last, -1, -1):
        chosen[station] = lattice[column]
        column = origins[station, column]
    chosen[0] = wanted[0]
    if last == count - 1 and abs(chosen[-1] - wanted[-1]) <= ON_LINE:
        end = clearance.to_anything(base[-1:] + wanted[-1] * normals[-1:])
        chosen[-1] = wanted[-1] if end[0] >= needed else chosen[-1]
    return _smoothed(chosen, base, normals, needed, clearance)


def _smoothed(
    offsets: FloatArray,
    base: FloatArray,
    normals: FloatArray,
    needed: float,
    clearance: FreeSpace,
) -> FloatArray:
    """Round the lattice's steps off, where there is room for it."""
    count = len(offsets)
    base, normals, result = base[:count], normals[:count], offsets.copy()
    room = clearance.to_anything(base + result[:, None] * normals)
    kept = np.minimum(room, needed)
    for _ in range(6):
        smooth = polyline.smoothed_rows(result)
        room = clearance.to_anything(base + smooth[:, None] * normals)
        result = np.where(room >= kept - 1e-9, smooth, result)
    return result
