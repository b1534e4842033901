"""Offices: wings at odd angles round a core, an atrium lobby, meeting nooks."""

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


def office(rng: np.random.Generator) -> Layout:
    """Draw an office floor."""
    layout = Layout()
    deep, half, cut = (
        drawn_between(rng, 20, 24),
        drawn_between(rng, 11, 13),
        drawn_between(rng, 4, 5),
    )
    core = WingFrame(heading_deg=drawn_between(rng, -12, 12))
    loop = core.line(
        (0, -half + cut),
        (cut, -half),
        (deep, -half),
        (deep, half - cut),
        (deep - cut, half),
        (0, half),
        (0, -half + cut),
    )
    layout.street(loop, 2.6, "core", 0, "Core Corridor")
    cross = deep * drawn_between(rng, 0.45, 0.6)
    layout.street(
        core.line((cross, -half), (cross, half)), 3.4, "lifts", 0, "Lift Lobby"
    )
    entry = core.moved(0, drawn_between(rng, -2, 2), 180)
    layout.street(entry.line((0, 0), (15, 0)), 3.0, "lobby", 0, "Reception")
    layout.entrances.append((entry.at(15), "Main Entrance"))
    layout.hall(entry.octagon(3.5, -6, 13, 6.5, 1.8), "Atrium", "lobby", 0)

    side = either(rng)
    east = core.moved(deep, 0, drawn_between(rng, 8, 20) * side)
    wing = bent(
        WingFrame(core.at(deep, side * drawn_between(rng, 0, 3)), east.heading_deg),
        (drawn_between(rng, 18, 22), 0),
        (drawn_between(rng, 14, 20), -side * drawn_between(rng, 30, 48)),
    )
    layout.street(wing, 2.2, "desks", 1, "East Wing")
    stub(layout, frame_on(wing, 9).moved(0, 0, 90), 8.0, 1.9, "desks", 1)
    side_hall(
        layout,
        frame_on(wing, 14).moved(0, 0, -90),
        2.2,
        5.5,
        3.5,
        "East Lounge",
        "lounge",
        1,
    )

    north = WingFrame(
        core.at(deep * 0.22, half), core.heading_deg + drawn_between(rng, 70, 90)
    )
    south = WingFrame(
        core.at(deep * 0.72, -half), core.heading_deg - drawn_between(rng, 70, 90)
    )
    long, short = drawn_between(rng, 16, 20), drawn_between(rng, 9, 12)
    upper = bent(north, (long, 0), (short, -drawn_between(rng, 25, 50)))
    layout.street(upper, 2.2, "desks", 2, "North Wing")
    stub(
        layout,
        frame_on(upper, 8.5).moved(0, 0, 90),
        drawn_between(rng, 6, 9),
        2.0,
        "desks",
        2,
    )
    lower = bent(south, (drawn_between(rng, 18, 22), 0))
    layout.street(lower, 2.4, "meeting", 3, "Meeting Wing")
    branch = bent(
        frame_on(lower, 13).moved(0, 0, -90),
        (drawn_between(rng, 10, 14), 0),
        (8.0, -40),
    )
    layout.street(branch, 2.0, "meeting", 3)
    side_hall(
        layout,
        frame_on(lower, 7.5).moved(0, 0, 90),
        2.4,
        4.5,
        3.0,
        "Coffee Corner",
        "lounge",
        3,
    )
    return layout
