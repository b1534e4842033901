"""Hospitals: a main street with a bend, wards as rings, clinics in slanted wings."""

import numpy as np

from memorymaze.construction.layout import Frame, Layout
from memorymaze.construction.pieces import bent, between, either, frame_on, ring, stub


def hospital(rng: np.random.Generator) -> Layout:
    """Draw a hospital."""
    layout = Layout()
    side = either(rng)
    before, after = between(rng, 36, 44), between(rng, 26, 34)
    main = bent(Frame(), (before, 0), (after, side * between(rng, 20, 36)))
    layout.street(main, between(rng, 3.4, 4.4), "main", 0, "Main Street")
    layout.entrances.append((main[0], "Main Entrance"))
    layout.hall(
        Frame().octagon(3.5, -6.0, between(rng, 12, 14), 6.0, 2.0),
        "Entrance Hall",
        "hall",
        0,
    )

    ward = frame_on(main, before - between(rng, 12, 16)).moved(0, 0, -90 * side)
    depth, half = between(rng, 16, 22), between(rng, 7.5, 9.5)
    ring(layout, ward, 8.0, depth, half, 2.4, "ward", 1, "Ward North")
    middle = 8.0 + depth * between(rng, 0.4, 0.6)
    layout.street(
        ward.line((middle, -half), (middle, half)), 2.2, "ward", 1, "Ward North"
    )
    stub(
        layout, ward.moved(8.0 + depth, half * 0.3), between(rng, 6, 9), 2.2, "ward", 1
    )

    far = frame_on(main, before + after - between(rng, 7, 10))
    ring(
        layout,
        far.moved(0, 0, 90 * side),
        7.0,
        between(rng, 14, 18),
        between(rng, 7, 8.5),
        2.4,
        "ward",
        2,
        "Ward East",
        cut=between(rng, 4, 5),
    )

    clinic = frame_on(main, before - between(rng, 17, 20)).moved(
        0, 0, side * between(rng, 75, 90)
    )
    wing = bent(
        clinic,
        (between(rng, 14, 18), 0),
        (between(rng, 10, 14), side * between(rng, 25, 40)),
    )
    layout.street(wing, 2.6, "clinic", 3, "Clinic Corridor")
    stub(
        layout,
        frame_on(wing, between(rng, 8, 10)).moved(0, 0, 90),
        between(rng, 8, 10),
        2.0,
        "clinic",
        3,
    )
    stub(
        layout,
        frame_on(main, between(rng, 17, 19)).moved(0, 0, -90 * side),
        between(rng, 6, 8),
        3.0,
        "main",
        0,
        "Lift Lobby",
    )
    return layout
