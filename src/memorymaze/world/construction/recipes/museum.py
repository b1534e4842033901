"""Museums: galleries as halls round an atrium, slanted wings, a terrace."""

import numpy as np

from memorymaze.world.construction.layout import Layout, WingFrame
from memorymaze.world.construction.pieces import (
    bent,
    drawn_between,
    either,
    frame_on,
    side_hall,
)


def museum(rng: np.random.Generator) -> Layout:
    """Draw a museum."""
    layout = Layout()
    side = either(rng)
    deep, half, cut = (
        drawn_between(rng, 21, 25),
        drawn_between(rng, 12, 14),
        drawn_between(rng, 4, 5),
    )
    atrium = WingFrame()
    loop = atrium.line(
        (0, -half + cut),
        (cut, -half),
        (deep - cut, -half),
        (deep, -half + cut),
        (deep, half - cut),
        (deep - cut, half),
        (cut, half),
        (0, half - cut),
        (0, -half + cut),
    )
    layout.street(
        loop, drawn_between(rng, 3.6, 4.4), "atrium", 0, "Atrium Walk", rooms="right"
    )
    entry = atrium.moved(0, 0, 180)
    layout.street(entry.line((0, 0), (19, 0)), 4.0, "foyer", 0, "Foyer")
    layout.hall(entry.octagon(4.5, -8, 16, 7, 2), "Foyer", "foyer", 0)
    layout.entrances.append((entry.at(19), "Main Entrance"))

    names = [str(name) for name in rng.permutation(GALLERIES)]
    east = bent(
        WingFrame(atrium.at(deep, 0), side * drawn_between(rng, 5, 12)),
        (drawn_between(rng, 22, 26), 0),
        (drawn_between(rng, 14, 18), -side * drawn_between(rng, 28, 42)),
    )
    wide = drawn_between(rng, 4.5, 6)
    linked = either(rng)
    layout.street(east, wide, "gallery", 1, "Long Gallery")
    for distance, turn in ((10.0, 90), (16.5, -90)):
        side_hall(
            layout,
            frame_on(east, distance).moved(0, 0, turn),
            wide,
            drawn_between(rng, 7, 10),
            drawn_between(rng, 3.5, 4.5),
            names.pop(),
            "exhibits",
            1,
        )
    end = WingFrame(east[-1], frame_on(east, 35).heading_deg)
    layout.hall(
        end.octagon(-1.0, -5.5, drawn_between(rng, 9, 12), 5.5, 2),
        names.pop(),
        "exhibits",
        1,
        [end.line((0, 0), (5, 0))],
    )
    for zone, sign in ((2, 1), (3, -1)):
        out = atrium.moved(deep * 0.5, sign * half, sign * drawn_between(rng, 72, 90))
        lean = drawn_between(rng, 28, 42) * (-sign if sign == linked else sign * side)
        wing = bent(
            out, (drawn_between(rng, 15, 18), 0), (drawn_between(rng, 15, 20), lean)
        )
        if sign == linked:
            wing = (*wing, frame_on(east, drawn_between(rng, 31, 34)).origin)
        width = drawn_between(rng, 3.2, 4.6)
        layout.street(wing, width, "gallery", zone, WINGS[zone])
        layout.hall(
            WingFrame(wing[1], out.heading_deg).octagon(-4.5, -6, 6, 6, 1.5),
            names.pop(),
            "exhibits",
            zone,
        )
        side_hall(
            layout,
            frame_on(wing, 8.5).moved(0, 0, 90),
            width,
            7.0,
            drawn_between(rng, 3.0, 3.8),
            names.pop(),
            "exhibits",
            zone,
        )
        layout.street(
            bent(frame_on(wing, 24).moved(0, 0, -sign * side * 90), (9.0, 0)),
            2.2,
            "service",
            zone,
            signed=False,
        )
    return layout


GALLERIES = (
    "Hall of Planets",
    "Ocean Hall",
    "Fossil Hall",
    "Robot Gallery",
    "Energy Gallery",
    "Hall of Minerals",
    "Story of Life",
    "City Gallery",
    "Earthquake Gallery",
    "Space Hall",
)
WINGS = ("", "", "North Gallery", "South Gallery")
