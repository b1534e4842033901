"""What a replay looks like, checked."""

from dataclasses import dataclass

from memorymaze.errors import SettingsError


@dataclass(frozen=True, slots=True)
class ReplaySettings:
    """What a replay looks like.

    Raises:
        SettingsError: A value has no meaning; the message names it and the range.
    """

    size: tuple[int, int] = (1280, 720)
    """Width and height of the video, pixels, even."""
    fps: float = 10.0
    """Frames per second."""
    speed: float = 2.0
    """Simulated seconds per second of video."""
    camera: bool = True
    """Whether the robot's view is drawn anew beside the plan."""
    smooth: bool = True
    """Whether edges in that view are smoothed, which takes longer."""
    hold: float = 3.0
    """Seconds of video that the outcome stands at the end."""

    def __post_init__(self) -> None:
        """Check every value."""
        width, height = self.size
        if min(self.size) < 240 or max(self.size) > 4096 or width % 2 or height % 2:
            raise SettingsError(
                "replay: expected a size of even numbers from 240 to 4096 pixels, got "
                f"{width}x{height}"
            )
        for name, lowest, highest in (
            ("fps", 1.0, 120.0),
            ("speed", 0.1, 100.0),
            ("hold", 0.0, 60.0),
        ):
            value = getattr(self, name)
            if not lowest <= value <= highest:
                raise SettingsError(
                    f"replay: expected {name} from {lowest:g} to {highest:g}, got "
                    f"{value!r}"
                )
