"""Pieces that recipes share: wings, rings, stubs, and numbers drawn for them."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to
from memorymaze.world.construction.layout import (
    Layout,
    WingFrame,
)


def drawn_between(rng: np.random.Generator, low: float, high: float) -> float:
    """Return a length, in decimetres, or an angle drawn between two."""
    return round(float(rng.uniform(low, high)), 1)


def either(rng: np.random.Generator) -> int:
    """Return 1 or -1."""
    return 1 if rng.random() < 0.5 else -1


def frame_on(line: Sequence[XY], distance: float) -> WingFrame:
    """Return the frame so many metres along a line, facing ahead."""
    left = distance
    for start, end in pairwise(line):
        step = math.dist(start, end)
        heading = math.degrees(heading_to(start, end))
        if left <= step:
            return WingFrame(WingFrame(start, heading).at(left), heading)
        left -= step
    raise ValueError(f"expected a distance on the line, got {left:.1f} m too many")


def bent(frame: WingFrame, *legs: tuple[float, float]) -> tuple[XY, ...]:
    """Return the line that goes ahead from a frame and turns before each next leg.

    Legs are metres and the turn in degrees before them.
    """
    places = [frame.at(0.0)]
    for length, turn in legs:
        frame = frame.moved(0.0, 0.0, turn)
        places.append(frame.at(length))
        frame = WingFrame(places[-1], frame.heading_deg)
    return tuple(places)


def stub(
    layout: Layout,
    frame: WingFrame,
    length: float,
    width: float,
    program: str,
    zone: int,
    name: str | None = None,
) -> None:
    """Add a short blind side corridor."""
    layout.street(
        frame.line((0, 0), (length, 0)), width, program, zone, name, signed=False
    )


def ring_of_streets(
    layout: Layout,
    frame: WingFrame,
    stem: float,
    depth: float,
    half: float,
    width: float,
    program: str,
    zone: int,
    name: str | None = None,
    *,
    cut: float = 0.0,
) -> None:
    """Add a stem ahead of a frame and a loop at its end, its far corners cut or not."""
    near, far = stem, stem + depth
    if cut:
        loop = frame.line(
            (near, -half),
            (far - cut, -half),
            (far, -half + cut),
            (far, half - cut),
            (far - cut, half),
            (near, half),
            (near, -half),
        )
    else:
        loop = frame.line(
            (near, -half), (far, -half), (far, half), (near, half), (near, -half)
        )
    layout.street(frame.line((0, 0), (near, 0)), width, program, zone, name)
    layout.street(loop, width, program, zone, name)


def side_hall(
    layout: Layout,
    frame: WingFrame,
    width: float,
    depth: float,
    half: float,
    name: str,
    program: str,
    zone: int,
    *,
    open_air: bool = False,
) -> None:
    """Add a hall beside a street of this width, ahead of a frame on its middle line."""
    near = width / 2
    layout.hall(
        frame.box(near - 0.4, -half, near + depth, half),
        name,
        program,
        zone,
        [frame.line((0, 0), (near + depth / 2, 0))],
        open_air=open_air,
    )
