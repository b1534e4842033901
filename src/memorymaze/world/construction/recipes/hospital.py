"""Hospitals: a main street with a bend, wards as rings, clinics in slanted wings."""

import numpy as np

from memorymaze.world.construction.layout import Layout, WingFrame
from memorymaze.world.construction.pieces import (
    bent,
    drawn_between,
    either,
    frame_on,
    ring_of_streets,
    stub,
)


def hospital(rng: np.random.Generator) -> Layout:
    """Draw a hospital."""
    layout = Layout()
    side = either(rng)
    before, after = drawn_between(rng, 36, 44), drawn_between(rng, 26, 34)
    main = bent(WingFrame(), (before, 0), (after, side * drawn_between(rng, 20, 36)))
    layout.street(main, drawn_between(rng, 3.4, 4.4), "main", 0, "Main Street")
    layout.entrances.append((main[0], "Main Entrance"))
    layout.hall(
        WingFrame().octagon(3.5, -6.0, drawn_between(rng, 12, 14), 6.0, 2.0),
        "Entrance Hall",
        "hall",
        0,
    )

    ward = frame_on(main, before - drawn_between(rng, 12, 16)).moved(0, 0, -90 * side)
    depth, half = drawn_between(rng, 16, 22), drawn_between(rng, 7.5, 9.5)
    ring_of_streets(layout, ward, 8.0, depth, half, 2.4, "ward", 1, "Ward North")
    middle = 8.0 + depth * drawn_between(rng, 0.4, 0.6)
    layout.street(
        ward.line((middle, -half), (middle, half)), 2.2, "ward", 1, "Ward North"
    )
    stub(
        layout,
        ward.moved(8.0 + depth, half * 0.3),
        drawn_between(rng, 6, 9),
        2.2,
        "ward",
        1,
    )

    far = frame_on(main, before + after - drawn_between(rng, 7, 10))
    ring_of_streets(
        layout,
        far.moved(0, 0, 90 * side),
        7.0,
        drawn_between(rng, 14, 18),
        drawn_between(rng, 7, 8.5),
        2.4,
        "ward",
        2,
        "Ward East",
        cut=drawn_between(rng, 4, 5),
    )

    clinic = frame_on(main, before - drawn_between(rng, 17, 20)).moved(
        0, 0, side * drawn_between(rng, 75, 90)
    )
    wing = bent(
        clinic,
        (drawn_between(rng, 14, 18), 0),
        (drawn_between(rng, 10, 14), side * drawn_between(rng, 25, 40)),
    )
    layout.street(wing, 2.6, "clinic", 3, "Clinic Corridor")
    stub(
        layout,
        frame_on(wing, drawn_between(rng, 8, 10)).moved(0, 0, 90),
        drawn_between(rng, 8, 10),
        2.0,
        "clinic",
        3,
    )
    stub(
        layout,
        frame_on(main, drawn_between(rng, 17, 19)).moved(0, 0, -90 * side),
        drawn_between(rng, 6, 8),
        3.0,
        "main",
        0,
        "Lift Lobby",
    )
    return layout
