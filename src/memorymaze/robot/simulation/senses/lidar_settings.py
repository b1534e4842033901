"""What a LiDAR measures and how well; read without a simulator at hand."""

import math
from dataclasses import dataclass, fields

from memorymaze.basics.options import check_number


@dataclass(frozen=True, slots=True)
class LidarSettings:
    """What a LiDAR measures and how well."""

    rays: int = 360
    """Per beam, evenly round the full circle."""
    beams: int = 1
    """Evenly from `-elevation` to `elevation`; 1 scans the horizontal plane."""
    elevation: float = math.radians(15)
    """Of the outermost beams, radians; of no meaning with one beam."""
    height: float = 0.4
    """Of the sensor over the floor, on the robot's axis, metres."""
    nearest: float = 0.1
    """Metres; what is nearer gives no return."""
    farthest: float = 20.0
    """Metres; what is farther gives no return."""
    noise: float = 0.0
    """Standard deviation of a measured range, metres."""
    drop_out: float = 0.0
    """Probability of a ray to give no return although something is there."""

    @classmethod
    def sixteen_beams(cls, rays: int = 900) -> "LidarSettings":
        """Return a 3D LiDAR's settings: 16 beams from -15 to 15 degrees."""
        return cls(rays=rays, beams=16)

    def __post_init__(self) -> None:
        """Check every value."""
        bounds = {
            "rays": (1, math.inf),
            "beams": (1, math.inf),
            "elevation": (0, math.pi / 2),
            "nearest": (0, self.farthest),
            "drop_out": (0, 1),
        }
        for each in fields(self):
            least, most = bounds.get(each.name, (0, math.inf))
            whole = each.name in ("rays", "beams")
            value = getattr(self, each.name)
            check_number(f"LiDAR setting {each.name}", value, least, most, whole=whole)
