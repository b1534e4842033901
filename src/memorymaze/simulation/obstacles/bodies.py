"""Movables as bodies of the physics model, whose places an episode sets."""

from collections.abc import Sequence

import mujoco

from memorymaze.simulation.motion.wheeled_base import SOLID_CONTACT
from memorymaze.simulation.obstacles.kinds import Movable

MOVABLE_GROUP = 4
"""Geom group of things and people."""
PARKED = -30.0
"""Height in metres at which those wait that an episode has no place for."""


def add_movables(spec: mujoco.MjSpec, movables: Sequence[Movable]) -> None:
    """Add a body per movable, driven from outside, with one geom; of its name.

    A thing is a box, a person an upright cylinder. Both touch the robot.
    """
    kinds = mujoco.mjtGeom
    for number, each in enumerate(movables):
        length, depth, height = each.size
        body = spec.worldbody.add_body(
            name=each.id, mocap=True, pos=[3.0 * number, 0, PARKED]
        )
        body.add_geom(
            type=kinds.mjGEOM_CYLINDER if each.is_person else kinds.mjGEOM_BOX,
            size=[each.radius, height / 2, 0]
            if each.is_person
            else [depth / 2, length / 2, height / 2],
            group=MOVABLE_GROUP,
            contype=SOLID_CONTACT,
            conaffinity=0,
        )
