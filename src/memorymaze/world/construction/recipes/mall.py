"""Malls: concourses round long atria with bridges, slanted arcades, a food court."""

import numpy as np

from memorymaze.world.construction.layout import Layout, WingFrame
from memorymaze.world.construction.pieces import (
    bent,
    drawn_between,
    either,
    frame_on,
    side_hall,
    stub,
)


def mall(rng: np.random.Generator) -> Layout:
    """Draw a mall."""
    layout = Layout()
    side = either(rng)
    long, half, tip = (
        drawn_between(rng, 38, 46),
        drawn_between(rng, 6, 7.5),
        drawn_between(rng, 5, 7),
    )
    lean = side * drawn_between(rng, 2, 5)
    loop = (
        (0.0, 0.0),
        (tip, -half),
        (long / 2, -half + lean),
        (long - tip, -half),
        (long, 0.0),
        (long - tip, half),
        (long / 2, half + lean),
        (tip, half),
        (0.0, 0.0),
    )
    layout.street(loop, 5.0, "concourse", 0, "Concourse", rooms="right")
    for x in (
        long * drawn_between(rng, 0.3, 0.36),
        long * drawn_between(rng, 0.64, 0.7),
    ):
        low, high = _on(loop[1:4], x), _on(loop[5:8], x)
        layout.street((low, high), 2.4, "bridge", 0, "Bridge")

    west = bent(WingFrame((0.0, 0.0), 180), (drawn_between(rng, 18, 22), 0))
    layout.street(west, 5.0, "concourse", 1, "West Arcade")
    for end, name, zone in ((0.0, "West Court", 1), (long, "East Court", 2)):
        layout.hall(
            WingFrame((end, 0.0)).octagon(-7.5, -7.5, 7.5, 7.5, 3.0),
            name,
            "court",
            zone,
        )
    layout.entrances.append((west[-1], "West Entrance"))

    east = bent(
        WingFrame((long, 0.0), 0),
        (drawn_between(rng, 20, 23), 0),
        (drawn_between(rng, 13, 17), side * drawn_between(rng, 28, 42)),
    )
    layout.street(east, 5.0, "concourse", 2, "East Arcade")
    layout.entrances.append((east[-1], "East Entrance"))
    side_hall(
        layout,
        frame_on(east, 14).moved(0, 0, -side * 90),
        5.0,
        drawn_between(rng, 9, 11),
        5.0,
        "Food Court",
        "court",
        2,
    )

    for zone, x, sign, piece in (
        (3, long * drawn_between(rng, 0.42, 0.46), 1, loop[5:8]),
        (4, long * drawn_between(rng, 0.54, 0.6), -1, loop[1:4]),
    ):
        arcade = bent(
            WingFrame(_on(piece, x), sign * drawn_between(rng, 70, 88)),
            (drawn_between(rng, 16, 19), 0),
            (drawn_between(rng, 11, 15), sign * side * drawn_between(rng, 30, 48)),
        )
        layout.street(
            arcade, drawn_between(rng, 3.4, 4.4), "arcade", zone, ARCADES[zone]
        )
        stub(
            layout,
            frame_on(arcade, drawn_between(rng, 9.5, 11)).moved(0, 0, 90),
            drawn_between(rng, 8, 11),
            2.2,
            "service",
            zone,
        )
        back = frame_on(arcade, drawn_between(rng, 22, 24)).moved(
            0, 0, -sign * side * 90
        )
        layout.street(
            bent(back, (7.0, 0), (7.0, 40 * side)), 2.0, "service", zone, signed=False
        )
    return layout


def _on(line: tuple[tuple[float, float], ...], x: float) -> tuple[float, float]:
    """Return the place on a line with this x."""
    xs, ys = zip(*sorted(line), strict=True)
    return (round(x, 3), round(float(np.interp(x, xs, ys)), 3))


ARCADES = ("", "", "", "North Arcade", "South Arcade")
