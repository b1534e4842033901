"""What a walkthrough looks like."""

import math
from dataclasses import dataclass

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.video_file import check_picture, check_ranges
from memorymaze.world.looks.kinds_of_looks import OWN, Looks

EYE_HEIGHT = 1.6
"""Metres over the floor: eyes of somebody who walks, or a camera held there."""


@dataclass(frozen=True, slots=True)
class WalkthroughSettings:
    """What a walkthrough looks like.

    Raises:
        SettingsError: A value has no meaning; the message names it and the range.
    """

    size: tuple[int, int] | None = None
    """Width and height, pixels, even; None for 960 x 540, all round 1280 x 640."""
    panorama: bool = False
    """Whether it looks all round (equirectangular, for players of 360-degree videos)."""
    fps: float = 20.0
    """Frames per second."""
    speed: float = 1.0
    """Times as fast as the robot drives, which is up to 1 m/s."""
    height: float = EYE_HEIGHT
    """Of the eyes over the floor, metres."""
    horizontal_fov: float = math.pi / 2
    """Radians; of no meaning in a panorama."""
    multisamples: int = 4
    """Samples per pixel that smooth edges; of no meaning in a panorama."""
    looks: Looks = OWN
    """How things look: `own`, `mesh`, or the path of a GLB file with models."""

    @property
    def pixels(self) -> tuple[int, int]:
        """Width and height of its frames."""
        return self.size or ((1280, 640) if self.panorama else (960, 540))

    def __post_init__(self) -> None:
        """Check every value."""
        check_picture("walkthrough", self.pixels, smallest=16)
        width, height = self.pixels
        if self.panorama and width != 2 * height:
            raise SettingsError(
                "walkthrough: expected a panorama twice as wide as high, got "
                f"{width}x{height}"
            )
        check_ranges(
            self, "walkthrough", fps=(1, 120), speed=(0.1, 20), height=(0.2, 2.5)
        )
