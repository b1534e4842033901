"""Whose body a robot has: the simulated one, CARLA's, or a user's own.

A body is named by `module:factory` or `file.py:factory`, or by a name from `BODIES`, with its
own options behind it: `carla,carla_host=localhost`. The factory is called once an episode,

    factory(site, start, settings, rng)                   # without Options
    factory(site, start, settings, rng, options=options)  # with a dataclass `Options`

with a `Site`, the `Pose` on its plan where the body is to stand, the run's
`SimulationSettings` and a generator for all that is random, and gives a `SensorsAndMotion`.
That may have `pose_in_site()`, the pose on the plan where it truly is, and `close()`, which
is called when the episode is over.
"""

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from memorymaze.basics.errors import RobotBodyError, SettingsError, did_you_mean
from memorymaze.basics.failures import failure_line
from memorymaze.basics.input_files import FileStamp
from memorymaze.basics.own_code import (
    checked_options,
    find_own,
    own_fingerprint,
    parse_own_options,
)

if TYPE_CHECKING:
    import numpy as np

    from memorymaze.basics.geometry.pose import Pose
    from memorymaze.robot.api.sensors_and_motion import SensorsAndMotion
    from memorymaze.robot.simulation.settings import SimulationSettings
    from memorymaze.world.sites import Site

BODIES = {"carla": "memorymaze.robot.carla:CarlaBody"}
"""Those that come with the package, besides the simulated one."""


@dataclass(frozen=True, slots=True)
class BodySettings:
    """Whose body robots have in a run, as it was given."""

    name: str
    """From `BODIES`, or `module:factory` or `file.py:factory`."""
    options: str = ""
    """Its own, as `NAME=VALUE,NAME=VALUE`."""

    def __str__(self) -> str:
        """Return them as `parse_body` reads them."""
        return f"{self.name},{self.options}" if self.options else self.name

    @property
    def place(self) -> str:
        """Where its factory is."""
        return BODIES.get(self.name, self.name)

    @property
    def label(self) -> str:
        """What it is called in tables."""
        return self.name.rpartition("/")[2]


def parse_body(text: str) -> BodySettings:
    """Read a body as the command line gives it: `NAME` or `NAME,OPTION=VALUE,…`.

    Raises:
        SettingsError: It is neither a name nor a place of a factory.
    """
    name, _, options = (part.strip() for part in text.partition(","))
    if name not in BODIES and ":" not in name:
        raise SettingsError(
            f"robot: expected one of {', '.join(BODIES)}, or your own as module:factory or "
            f"file.py:factory, got {name!r}{did_you_mean(name, BODIES)}"
        )
    return BodySettings(name, options)


@dataclass(frozen=True, slots=True)
class BodyMaker:
    """Makes the body of each episode."""

    settings: BodySettings
    factory: Any
    options: Any
    """Of its dataclass `Options`; None where it has none."""

    def make(
        self,
        site: "Site",
        start: "Pose",
        settings: "SimulationSettings",
        rng: "np.random.Generator",
    ) -> "SensorsAndMotion":
        """Put a body at the start of an episode.

        Raises:
            RobotBodyError: The factory raised, or gave something else.
        """
        from memorymaze.robot.api.sensors_and_motion import SensorsAndMotion

        named = {} if self.options is None else {"options": self.options}
        try:
            body = self.factory(site, start, settings, rng, **named)
        except RobotBodyError:
            raise
        except Exception as error:
            raise RobotBodyError(
                f"robot {self.settings.name!r}: cannot be put at {start} of {site.name} "
                f"({failure_line(error)})"
            ) from error
        if not isinstance(body, SensorsAndMotion):
            raise RobotBodyError(
                f"robot {self.settings.name!r}: expected a body with odometry, drive, "
                f"lidar_scan and camera_picture, got {type(body).__name__}"
            )
        return body

    def files(self) -> tuple[FileStamp, ...]:
        """Return the fingerprints of the files of a user's own."""
        return own_fingerprint(self.settings.place)


def find_body(settings: BodySettings | None) -> BodyMaker | None:
    """Return what makes the bodies of a run; None for the simulated one.

    Raises:
        SettingsError: There is no such factory, or it has no such options.
    """
    if settings is None:
        return None
    factory = find_own("robot", settings.place)
    options = parse_own_options("robot", settings.name, factory, settings.options)
    return BodyMaker(settings, factory, options)


def options_of_body(settings: BodySettings) -> frozenset[str]:
    """Return the names of the options that a body has."""
    kind = checked_options("robot", settings.name, find_own("robot", settings.place))
    return frozenset(() if kind is None else (each.name for each in fields(kind)))
