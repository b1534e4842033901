"""Airports: a check-in hall, a bent concourse, two piers with lounges at gates."""

import numpy as np

from memorymaze.basics.geometry.points import XY
from memorymaze.world.construction.layout import (
    Layout,
    WingFrame,
)
from memorymaze.world.construction.pieces import (
    bent,
    drawn_between,
    either,
    frame_on,
    side_hall,
    stub,
)


def airport(rng: np.random.Generator) -> Layout:
    """Draw a terminal."""
    layout = Layout()
    side = either(rng)
    concourse = bent(
        WingFrame(),
        (drawn_between(rng, 26, 30), 0),
        (drawn_between(rng, 18, 22), side * drawn_between(rng, 15.5, 24)),
    )
    layout.street(concourse, 6.0, "concourse", 0, "Main Concourse")
    layout.entrances.append((concourse[0], "Terminal Entrance"))
    layout.hall(
        WingFrame().box(3, -9, drawn_between(rng, 15, 17), 9),
        "Check-in Hall",
        "check_in",
        0,
    )
    check = frame_on(concourse, 9.5)
    for sign, name in ((1, "North Exit"), (-1, "South Exit")):
        way = bent(
            check.moved(0, 0, sign * 90),
            (drawn_between(rng, 15, 18), 0),
            (drawn_between(rng, 9, 12), -sign * drawn_between(rng, 35, 50)),
        )
        layout.street(
            way, 3.2, "landside", 1 if sign > 0 else 2, name.split()[0] + " Hallway"
        )
        layout.entrances.append((way[-1], name))
        stub(
            layout,
            frame_on(way, 13.5).moved(0, 0, sign * 90),
            drawn_between(rng, 6, 8),
            2.2,
            "service",
            1 if sign > 0 else 2,
        )
    for sign in (1, -1):
        stub(
            layout,
            frame_on(concourse, 21.0).moved(0, 0, 90 * sign),
            drawn_between(rng, 7.5, 10),
            2.4,
            "service",
            0,
        )

    fork = WingFrame(concourse[-1], side * 20.0)
    layout.hall(fork.octagon(-7, -9, 8, 9, 3), "Central Plaza", "plaza", 0)
    across = drawn_between(rng, 18, 19)
    tied: list[XY] = []
    for zone, sign in ((3, 1), (4, -1)):
        pier = bent(
            fork.moved(0, 0, sign * drawn_between(rng, 41, 46)),
            (drawn_between(rng, 25, 29), 0),
            (drawn_between(rng, 21, 25), -sign * drawn_between(rng, 25, 40)),
        )
        tied.append(frame_on(pier, across).origin)
        width = drawn_between(rng, 4.6, 5.6)
        layout.street(pier, width, "pier", zone, f"Pier {'  XAB'[zone]}")
        for distance, number in ((11.0, 1), (41.0, 2)):
            side_hall(
                layout,
                frame_on(pier, distance).moved(0, 0, sign * 90),
                width,
                drawn_between(rng, 6, 8),
                4.0,
                f"Lounge {'  XAB'[zone]}{number}",
                "lounge",
                zone,
            )
        stub(
            layout,
            frame_on(pier, 34.5).moved(0, 0, sign * 90),
            drawn_between(rng, 6, 9),
            2.2,
            "service",
            zone,
        )
    layout.street(
        bent(fork, (drawn_between(rng, 19, 24), 0)),
        4.0,
        "concourse",
        0,
        "Shopping Walk",
    )
    layout.street(tied, 3.6, "concourse", 0, "Pier Connector")
    return layout
