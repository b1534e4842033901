"""Stations: a hall, a bent concourse with stairs to platforms, a slanted passage."""

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


def station(rng: np.random.Generator) -> Layout:
    """Draw a station."""
    layout = Layout()
    side = either(rng)
    hall = WingFrame()
    before = drawn_between(rng, 38, 44)
    concourse = bent(
        hall,
        (before, 0),
        (drawn_between(rng, 32, 38), side * drawn_between(rng, 18, 30)),
    )
    layout.street(concourse, drawn_between(rng, 6.2, 7.8), "concourse", 0, "Concourse")
    layout.hall(
        hall.octagon(3, -11, drawn_between(rng, 17, 20), 11, 4), "Main Hall", "hall", 0
    )
    layout.entrances.append((concourse[0], "Main Entrance"))

    gate = frame_on(concourse, 10.5)
    north = bent(
        gate.moved(0, 0, 90),
        (drawn_between(rng, 17, 20), 0),
        (drawn_between(rng, 12, 15), drawn_between(rng, 30, 45)),
    )
    layout.street(north, 3.6, "passage", 1, "North Passage")
    layout.entrances.append((north[-1], "North Exit"))
    stub(
        layout,
        frame_on(north, 15).moved(0, 0, -90),
        drawn_between(rng, 7, 9),
        2.4,
        "service",
        1,
    )
    south = bent(
        gate.moved(0, 0, -90),
        (drawn_between(rng, 18, 22), 0),
        (drawn_between(rng, 14, 18), drawn_between(rng, 38, 48)),
        (drawn_between(rng, 9, 12), drawn_between(rng, 35, 45)),
    )
    tie = before + drawn_between(rng, 8, 14)
    south = (*south, frame_on(concourse, tie).origin)
    layout.street(south, 4.2, "passage", 2, "South Passage")
    side_hall(
        layout,
        frame_on(south, 16).moved(0, 0, -90),
        4.2,
        8.0,
        4.5,
        "Ticket Office",
        "shops",
        2,
    )
    layout.street(
        bent(frame_on(south, 25).moved(0, 0, -90), (9.0, 0), (8.0, 45)),
        2.2,
        "service",
        2,
        signed=False,
    )
    spacing = drawn_between(rng, 6.0, 6.6)
    stairs = [drawn_between(rng, 24, 25) + number * spacing for number in range(6)]
    stairs = [at for at in stairs if abs(at - before) > 6.5 and abs(at - tie) > 6.5]
    for number, at in enumerate(stairs):
        sign = 1 if number % 2 or at > 32 else -1
        stub(
            layout,
            frame_on(concourse, at).moved(0, 0, sign * drawn_between(rng, 76, 90)),
            drawn_between(rng, 10, 15),
            drawn_between(rng, 2.6, 3.4),
            "platform",
            0,
            f"Platforms {2 * number + 1}-{2 * number + 2}",
        )

    end = frame_on(concourse, 66)
    layout.street(
        bent(
            end.moved(0, 0, 90 * side),
            (drawn_between(rng, 12, 15), 0),
            (10.0, 45 * side),
        ),
        3.2,
        "passage",
        3,
        "East Passage",
    )
    return layout
