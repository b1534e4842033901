"""Schools: a bent main hallway, classroom wings round a courtyard, a gym wing."""

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


def school(rng: np.random.Generator) -> Layout:
    """Draw a school."""
    layout = Layout()
    side = either(rng)
    main = bent(
        WingFrame(),
        (drawn_between(rng, 30, 34), 0),
        (drawn_between(rng, 24, 30), -side * drawn_between(rng, 22, 34)),
    )
    wide = drawn_between(rng, 3.0, 3.6)
    layout.street(main, wide, "main", 0, "Main Hallway")
    layout.entrances.append((main[0], "Main Entrance"))
    layout.hall(WingFrame().box(2.5, -5.5, 11.5, 5.5), "Entrance Hall", "hall", 0)

    near, far = drawn_between(rng, 14.5, 16), drawn_between(rng, 26, 27.5)
    lean = drawn_between(rng, 3, 9)
    west = bent(
        frame_on(main, near).moved(0, 0, side * (90 + lean)),
        (drawn_between(rng, 25, 28), 0),
        (drawn_between(rng, 8, 11), side * drawn_between(rng, 35, 60)),
    )
    layout.street(west, 2.6, "classes", 1, "Blue Hallway")
    east = bent(
        frame_on(main, far).moved(0, 0, side * (90 - lean)),
        (drawn_between(rng, 25, 29), 0),
    )
    layout.street(east, 2.6, "classes", 2, "Green Hallway")
    layout.entrances.append((east[-1], "Playground Entrance"))
    tie = drawn_between(rng, 20, 22)
    layout.street(
        (frame_on(west, tie).origin, frame_on(east, tie).origin),
        2.4,
        "library",
        1,
        "Library Hallway",
    )
    stub(
        layout,
        frame_on(west, drawn_between(rng, 9, 12)).moved(0, 0, side * 90),
        drawn_between(rng, 9, 12),
        2.2,
        "classes",
        1,
    )
    stub(
        layout,
        frame_on(east, drawn_between(rng, 12, 14)).moved(0, 0, -side * 90),
        drawn_between(rng, 9, 12),
        2.2,
        "classes",
        2,
    )

    gym = bent(
        frame_on(main, drawn_between(rng, 19, 22)).moved(
            0, 0, -side * drawn_between(rng, 72, 90)
        ),
        (drawn_between(rng, 13, 16), 0),
        (drawn_between(rng, 12, 15), side * drawn_between(rng, 28, 45)),
    )
    layout.street(gym, 3.0, "sports", 3, "Gym Hallway")
    stub(
        layout,
        frame_on(gym, 8.5).moved(0, 0, side * 90),
        drawn_between(rng, 7, 9),
        2.0,
        "sports",
        3,
    )
    side_hall(
        layout,
        frame_on(main, drawn_between(rng, 41, 44)).moved(0, 0, side * 90),
        wide,
        8.0,
        5.5,
        "Cafeteria",
        "hall",
        0,
    )
    science = bent(
        frame_on(main, drawn_between(rng, 49, 51)).moved(
            0, 0, -side * drawn_between(rng, 76, 90)
        ),
        (drawn_between(rng, 14, 18), 0),
        (drawn_between(rng, 12, 16), -side * drawn_between(rng, 40, 60)),
    )
    layout.street(science, 2.4, "labs", 4, "Science Hallway")
    stub(
        layout,
        frame_on(science, 9).moved(0, 0, 90 * side),
        drawn_between(rng, 8, 11),
        2.2,
        "labs",
        4,
    )
    return layout
