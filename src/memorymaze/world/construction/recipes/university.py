"""Universities: three halls, each its own way, joined by links."""

import numpy as np

from memorymaze.world.construction.layout import Layout, WingFrame
from memorymaze.world.construction.pieces import (
    bent,
    drawn_between,
    either,
    side_hall,
    stub,
)


def university(rng: np.random.Generator) -> Layout:
    """Draw a floor of three connected buildings."""
    layout = Layout()
    side = either(rng)
    wide, high = drawn_between(rng, 20, 24), drawn_between(rng, 24, 30)
    first = WingFrame()
    loop = first.line((0, 0), (wide, 0), (wide, high), (0, high), (0, 0))
    layout.street(loop, 2.4, "offices", 0, "Newton Hallway")
    middle = high * drawn_between(rng, 0.4, 0.6)
    layout.street(
        first.line((0, middle), (wide, middle)), 2.8, "main", 0, "Lift Hallway"
    )
    entry = WingFrame(first.at(wide * drawn_between(rng, 0.4, 0.6)), -90)
    layout.street(entry.line((0, 0), (9.5, 0)), 2.4, "main", 0, "Founders' Lobby")
    layout.hall(entry.box(1.0, -4.5, 8.0, 5.0), "Founders' Lobby", "lounge", 0)
    layout.entrances.append((entry.at(9.5), "South Entrance"))
    stub(
        layout,
        WingFrame(first.at(0, high), 180),
        drawn_between(rng, 7, 9),
        2.2,
        "offices",
        0,
    )

    link = drawn_between(rng, 11, 14)
    second = WingFrame(first.at(wide + link, middle))
    layout.street((first.at(wide, middle), second.origin), 2.8, "link", 0, "Glass Link")
    up, down = drawn_between(rng, 17, 21), drawn_between(rng, 13, 17)
    layout.street(
        second.line((0, -down), (0, up)), 2.4, "classes", 1, "Curie West Hallway"
    )
    across = drawn_between(rng, 20, 24)
    layout.street(second.line((0, 0), (across, 0)), 2.6, "classes", 1, "Curie Hallway")
    layout.street(
        bent(second.moved(across, -down, 90), (up + down - 4.0, 0)),
        2.4,
        "classes",
        1,
        "Curie East Hallway",
    )
    lower = bent(second.moved(0, -down + 6.0), (across, 0))
    layout.street(lower, 2.2, "labs", 1, "Laboratory Hallway")
    side_hall(
        layout,
        second.moved(across * 0.5, 0, 90),
        2.6,
        7.0,
        4.5,
        "Student Commons",
        "lounge",
        1,
    )

    slant = side * drawn_between(rng, 18, 30)
    start = second.at(across, drawn_between(rng, 6.5, 8))
    bridge = bent(WingFrame(start, slant), (drawn_between(rng, 13, 16), 0))
    layout.street(bridge, 2.6, "link", 1, "Garden Bridge")
    third = WingFrame(bridge[-1], slant)
    half = drawn_between(rng, 9, 12)
    layout.street(
        third.line((0, -half - 6), (0, half + 6)), 2.2, "offices", 2, "Darwin Hallway"
    )
    depth = drawn_between(rng, 11, 15)
    layout.street(
        third.line((0, half), (depth, half), (depth, -half), (0, -half)),
        2.2,
        "classes",
        2,
        "Darwin Ring",
    )
    side_hall(
        layout, third.moved(depth, 0, 0), 2.2, 6.0, 4.0, "Darwin Lounge", "lounge", 2
    )
    if rng.random() < 0.6:
        wing = bent(
            WingFrame(first.at(0, middle), 180),
            (drawn_between(rng, 13, 17), 0),
            (drawn_between(rng, 10, 14), side * drawn_between(rng, 25, 45)),
        )
        layout.street(wing, 2.2, "offices", 0, "West Wing")
    if rng.random() < 0.6:
        tail = bent(
            second.moved(0, up, 90),
            (5.0, 0),
            (drawn_between(rng, 11, 15), -drawn_between(rng, 40, 60)),
        )
        layout.street(tail, 2.4, "labs", 1, "Observatory Passage")
    return layout
