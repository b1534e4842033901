"""The guide robot's body: a suitcase on two driven wheels and two casters.

Differential drive with real contacts: the wheels' friction on the floor moves it, and
its upright shell, a cylinder of 0.25 m radius, is what bumps into walls and obstacles.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.physics_engine import about_z, mujoco
from memorymaze.basics.robot_size import CAMERA_HEIGHT, ROBOT_RADIUS
from memorymaze.robot.simulation.settings import TIMESTEP, SimulationSettings

ROBOT_GROUP = 5
"""Geom group of all parts of the robot."""
FLOOR_CONTACT, SOLID_CONTACT = 1, 2

WHEEL_RADIUS = 0.08
WHEEL_OFFSET = 0.2
CASTER_RADIUS = 0.04
CASTER_OFFSET = 0.19
SHELL_BOTTOM, SHELL_TOP = 0.07, 1.0
MOST_ACCELERATION = 10.0
"""Metres per second squared; its wheels, whose friction is 1, hold the floor no better."""
KEPT_ROOM = 0.2
"""Metres by which boxes may be nearer than the walls on the plan that they stand for,
and by which the robot may lean, at most."""
CAMERA_FIELD_OF_VIEW = 2 * math.atan(math.tan(math.pi / 4) * 480 / 640)


def add_wheeled_base(spec: mujoco.MjSpec) -> None:
    """Add the robot at the origin, with its camera `eye` and wheels `left`, `right`."""
    spec.option.timestep = TIMESTEP
    geom = mujoco.mjtGeom
    base = spec.worldbody.add_body(name="robot")
    base.add_freejoint()
    base.add_geom(
        name="shell",
        type=geom.mjGEOM_CYLINDER,
        fromto=[0, 0, SHELL_BOTTOM, 0, 0, SHELL_TOP],
        size=[ROBOT_RADIUS, 0, 0],
        mass=0,
        group=ROBOT_GROUP,
        contype=0,
        conaffinity=SOLID_CONTACT,
        priority=1,
        friction=[0.1, 0, 0],
    )
    for half_size, height, mass in (
        ((0.14, 0.16, 0.05), 0.12, 16.0),  # batteries and motors, low down
        ((0.12, 0.2, 0.35), 0.55, 9.0),  # the suitcase
        ((0.01, 0.01, 0.12), 1.11, 0.5),  # the mast
    ):
        base.add_geom(
            type=geom.mjGEOM_BOX,
            size=list(half_size),
            pos=[0, 0, height],
            mass=mass,
            group=ROBOT_GROUP,
            contype=0,
            conaffinity=0,
        )
    for offset in (-CASTER_OFFSET, CASTER_OFFSET):
        base.add_geom(
            type=geom.mjGEOM_SPHERE,
            size=[CASTER_RADIUS, 0, 0],
            pos=[offset, 0, CASTER_RADIUS],
            mass=0.5,
            group=ROBOT_GROUP,
            contype=0,
            conaffinity=FLOOR_CONTACT,
            priority=1,
            condim=1,
        )
    base.add_camera(
        name="eye",
        pos=[0, 0, CAMERA_HEIGHT],
        # Camera axes: x to the right, y up, looking along -z.
        xyaxes=[0, -1, 0, 0, 0, 1],
        fovy=math.degrees(CAMERA_FIELD_OF_VIEW),
    )
    for name, offset in (("left", WHEEL_OFFSET), ("right", -WHEEL_OFFSET)):
        wheel = base.add_body(pos=[0, offset, WHEEL_RADIUS])
        wheel.add_joint(
            name=name, type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0], armature=0.02
        )
        wheel.add_geom(
            type=geom.mjGEOM_SPHERE,
            size=[WHEEL_RADIUS, 0, 0],
            mass=1.5,
            group=ROBOT_GROUP,
            contype=0,
            conaffinity=FLOOR_CONTACT,
            priority=1,
            friction=[1.0, 0.005, 0.0001],
        )
        motor = spec.add_actuator(
            name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT
        )
        motor.set_to_velocity(kv=10)
        motor.forcelimited = True
        motor.forcerange = [-8, 8]


class WheelErrors:
    """How far the speed of each wheel is off, drawn anew for each decision."""

    def __init__(self, noise: float, rng: np.random.Generator) -> None:
        """Take the standard deviation of the relative error."""
        self._noise = noise
        self._rng = rng
        self._errors: list[float] = []

    def wheel_speeds(self, speed: float, turn_rate: float) -> tuple[float, float]:
        """Return how fast the left and the right wheel are to go, metres per second."""
        across = turn_rate * WHEEL_OFFSET
        left, right = speed - across, speed + across
        if self._noise > 0:
            if len(self._errors) < 2:
                self._errors = self._rng.normal(1.0, self._noise, 512).tolist()
            left *= self._errors.pop()
            right *= self._errors.pop()
        return left, right


class WheeledBase:
    """The moving robot in one episode: wheel speeds in, pose out.

    Time passes only in `drive` and `rest`.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        start: Pose,
        settings: SimulationSettings,
        rng: np.random.Generator,
        tangible: tuple[mujoco.MjModel, Sequence[int]] | None = None,
        open_floor: tuple[mujoco.MjModel, Callable[[XY], float]] | None = None,
    ) -> None:
        """Put the robot at rest on its start pose.

        `tangible` is the model without what nothing touches, and which geoms are left;
        it moves the robot in the place of the whole one. `open_floor` is the model of
        robot and floor alone, and how far the robot may go from a place, whichever way,
        touching nothing else; it moves one that stays within that.
        """
        self.data = mujoco.MjData(model)
        """State of the physics; read only, up to date as of the last `update_view`."""
        moving, geoms = tangible or (model, range(model.ngeom))
        data = self.data if moving is model else mujoco.MjData(moving)
        self._among_walls = moving, data
        self._open_floor = None
        if open_floor is not None:
            self._open_floor = open_floor[0], mujoco.MjData(open_floor[0])
            self._room_at = open_floor[1]
        self._asked_at, self._room = (0.0, 0.0), 0.0
        """Where it was when it was asked for its room, and that."""
        self._geoms = geoms
        self._model = model
        self._groups = moving.geom_group.tolist()
        self._errors = WheelErrors(settings.wheel_noise, rng)
        self._be_moved_by(*self._among_walls)
        address = int(model.jnt_qposadr[model.body("robot").jntadr[0]])
        if address != 0:
            raise RuntimeError("the robot's free joint is expected to come first")
        self._qpos[:7] = (start.x, start.y, 0, *about_z(start.heading))
        self._steps = 0
        self.update_view()

    @property
    def time(self) -> float:
        """Simulated seconds since the start."""
        return self._steps * TIMESTEP

    @property
    def pose(self) -> Pose:
        """Where the robot is."""
        x, y, _, w, i, j, k, *_ = self._qpos.tolist()
        return Pose(x, y, math.atan2(2 * (w * k + i * j), 1 - 2 * (j * j + k * k)))

    def drive(self, speed: float, turn_rate: float, steps: int) -> None:
        """Let the physics run for some steps, going for these speeds.

        Metres per second, negative backs up; radians per second, left positive.
        """
        left, right = self._errors.wheel_speeds(speed, turn_rate)
        if self._open_floor is not None:
            self._leave_out_what_is_far(self._open_floor, steps * TIMESTEP)
        self._ctrl[0] = left / WHEEL_RADIUS
        self._ctrl[1] = right / WHEEL_RADIUS
        mujoco.mj_step(self._moving_model, self._moving, nstep=steps)
        self._steps += steps

    def _leave_out_what_is_far(
        self, open_floor: tuple[mujoco.MjModel, mujoco.MjData], seconds: float
    ) -> None:
        """Have the model of the open floor move a robot that comes near to nothing else.

        All that the motion depends on goes along, so that it stays the same bit by bit.
        """
        here = self._qpos.item(0), self._qpos.item(1)
        reach = (self.speed + MOST_ACCELERATION * seconds / 2) * seconds
        if math.dist(self._asked_at, here) + reach > self._room:
            self._asked_at, self._room = here, self._room_at(here) - KEPT_ROOM
        has_room = math.dist(self._asked_at, here) + reach <= self._room
        model, data = open_floor if has_room else self._among_walls
        if data is not self._moving:
            before = self._moving
            self._be_moved_by(model, data)
            data.qpos[:], data.qvel[:] = before.qpos, before.qvel
            data.qacc_warmstart[:] = before.qacc_warmstart

    def _be_moved_by(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._moving_model, self._moving = model, data
        self._qpos, self._qvel, self._ctrl = data.qpos, data.qvel, data.ctrl

    @property
    def speed(self) -> float:
        """Metres per second over the floor, whichever way."""
        return math.hypot(self._qvel.item(0), self._qvel.item(1))

    @property
    def velocity(self) -> tuple[float, float]:
        """Metres per second, along x and y."""
        return self._qvel.item(0), self._qvel.item(1)

    def rest(self, steps: int) -> None:
        """Let time pass for a robot at rest in a building where nothing moves."""
        self._steps += steps

    def touched_geoms(self) -> list[int]:
        """Return the geoms, other than the floor, that the robot touches now."""
        if self._moving is not self._among_walls[1]:
            return []
        pairs = self._moving.contact.geom.tolist()
        return [
            self._geoms[first if self._groups[second] == ROBOT_GROUP else second]
            for first, second in pairs
            if first != 0 and second != 0
        ]

    def touched_places(self) -> list[tuple[float, float]]:
        """Return where the robot touches something other than the floor, metres."""
        contact = self._moving.contact
        pairs, places = contact.geom.tolist(), contact.pos.tolist()
        return [
            (place[0], place[1])
            for (first, second), place in zip(pairs, places, strict=True)
            if first != 0 and second != 0
        ]

    def update_view(self) -> None:
        """Bring the pose and speed in `data`, of camera and geoms too, up to date."""
        if self._moving is not self.data:
            self.data.qpos[:], self.data.qvel[:] = self._qpos, self._qvel
        mujoco.mj_kinematics(self._model, self.data)
        mujoco.mj_camlight(self._model, self.data)
