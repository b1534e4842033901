"""How noisy LiDAR and odometry are in a run: levels with a name, or errors by name."""

import math
from dataclasses import dataclass, fields

from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.basics.options import check_number, parse_options, write_options
from memorymaze.robot.simulation.senses.lidar_settings import LidarSettings
from memorymaze.robot.simulation.senses.odometry import OdometrySettings


@dataclass(frozen=True, slots=True)
class NoiseSettings:
    """The errors of LiDAR and odometry in a run; there is at least one.

    Raises:
        SettingsError: A value has no meaning, or all are 0.
    """

    lidar_range_noise: float = 0.0
    """Standard deviation of a measured range, metres."""
    lidar_drop_out: float = 0.0
    """Probability of a ray to give no return although something is there."""
    odometry_scale_error: float = 0.0
    """Relative error of every distance: 0.01 measures 1.01 m for each metre."""
    odometry_heading_drift_deg: float = 0.0
    """Degrees of heading gained per metre driven, left positive."""
    odometry_turn_scale_error: float = 0.0
    """Relative error of every change of heading."""
    odometry_distance_noise: float = 0.0
    """Standard deviation of the error over one metre, metres."""
    odometry_heading_noise_deg: float = 0.0
    """Standard deviation of the heading's error over one metre, degrees."""

    def __post_init__(self) -> None:
        """Check every value."""
        bounds = {
            "lidar_drop_out": (0, 1),
            "odometry_scale_error": (-1, math.inf),
            "odometry_heading_drift_deg": (-math.inf, math.inf),
            "odometry_turn_scale_error": (-1, math.inf),
        }
        for each in fields(self):
            least, most = bounds.get(each.name, (0, math.inf))
            value = getattr(self, each.name)
            check_number(f"noise setting {each.name}", value, least, most)
        if not self._errors:
            raise SettingsError(
                "noise: expected an error of LiDAR or odometry other than 0, got none; "
                "leave noise out for exact senses"
            )

    def __str__(self) -> str:
        """Return what is not 0 as `parse_noise` reads it."""
        return write_options(self, self._errors)

    @property
    def lidar(self) -> LidarSettings:
        """What the LiDAR then measures."""
        return LidarSettings(noise=self.lidar_range_noise, drop_out=self.lidar_drop_out)

    @property
    def odometry(self) -> OdometrySettings:
        """How far odometry is then off."""
        return OdometrySettings(
            scale_error=self.odometry_scale_error,
            heading_drift=math.radians(self.odometry_heading_drift_deg),
            turn_scale_error=self.odometry_turn_scale_error,
            distance_noise=self.odometry_distance_noise,
            heading_noise=math.radians(self.odometry_heading_noise_deg),
        )

    @property
    def called(self) -> str:
        """In a few words: `heavy noise`, or `noise` and its errors."""
        for level, settings in NOISE_LEVELS.items():
            if self == settings:
                return f"{level} noise"
        return f"noise {self}"

    @property
    def _errors(self) -> list[str]:
        return [each.name for each in fields(self) if getattr(self, each.name)]


NOISE_LEVELS = {
    "light": NoiseSettings(
        lidar_range_noise=0.01,
        lidar_drop_out=0.01,
        odometry_scale_error=0.002,
        odometry_heading_drift_deg=0.03,
        odometry_distance_noise=0.003,
        odometry_heading_noise_deg=0.1,
    ),
    "heavy": NoiseSettings(
        lidar_range_noise=0.03,
        lidar_drop_out=0.05,
        odometry_scale_error=0.02,
        odometry_heading_drift_deg=0.3,
        odometry_distance_noise=0.01,
        odometry_heading_noise_deg=0.3,
    ),
}
"""Settings that have a name; where their values come from is in `docs/lab/lidar.md`."""


def parse_noise(text: str) -> NoiseSettings:
    """Read settings as the command line gives them.

    A level, or errors joined by commas, or both: `light`, `lidar_drop_out=0.1`,
    `heavy,lidar_range_noise=0.02`. Without a level, what is left out is exact.

    Raises:
        SettingsError: A part is neither a level nor an error, or has no meaning.
    """
    level, _, rest = (part.strip() for part in text.partition(","))
    if "=" in level:
        return parse_options(NoiseSettings, text, subject="noise setting")
    if level not in NOISE_LEVELS:
        raise SettingsError(
            f"noise: expected a level ({', '.join(NOISE_LEVELS)}), errors such as "
            f"lidar_range_noise=0.02, or both joined by a comma, got {level!r}"
            f"{did_you_mean(level, NOISE_LEVELS)}"
        )
    return parse_options(
        NoiseSettings, rest, subject="noise setting", start=NOISE_LEVELS[level]
    )
