"""What can be set about a robot in CARLA."""

from dataclasses import dataclass

from memorymaze.basics.options import check_number, parse_options
from memorymaze.robot.simulation.senses.odometry import OdometrySettings


@dataclass(frozen=True, slots=True)
class CarlaOptions:
    """Where the server is, and what is put into its world.

    Raises:
        SettingsError: A value has no meaning; the message names it and the range.
    """

    carla_host: str = "localhost"
    """Name or address of the machine that the server runs on."""
    carla_port: int = 2000
    """Port of the server, which uses the two after it as well."""
    carla_timeout: float = 30.0
    """Seconds after which a server that does not answer is given up."""
    carla_map: str = ""
    """A map that the server has; left out, one is generated from the site's OpenDRIVE."""
    carla_body: str = "util.actor.empty"
    """Blueprint of what is driven; the default hides nothing from its own sensors."""
    carla_pedestrians: int = 0
    """CARLA's pedestrians who walk about."""
    carla_odometry: str = "exact"
    """exact (where the body is in the building), or its wheels' from the start on, by
    their errors: scale_error=0.01+heading_noise=0.005."""

    def __post_init__(self) -> None:
        """Check every value."""
        check_number("carla_port", self.carla_port, 1, 65533, whole=True)
        check_number("carla_timeout", self.carla_timeout, above=0)
        check_number("carla_pedestrians", self.carla_pedestrians, least=0, whole=True)
        self.wheel_errors()

    def wheel_errors(self) -> OdometrySettings | None:
        """Return how far its wheels' odometry is off; None where it is exact."""
        # Commas stand between a body's options.
        errors, subject = self.carla_odometry.replace("+", ","), "carla_odometry"
        exact = errors == "exact"
        return (
            None if exact else parse_options(OdometrySettings, errors, subject=subject)
        )
