"""How much a program may use."""

from dataclasses import dataclass

from memorymaze.errors import SettingsError

LONGEST_COMPUTING_TIME = 60.0
"""The highest computing time that can be allowed, seconds."""


@dataclass(frozen=True, slots=True)
class ProgramLimits:
    """How much a program may use; the robot's own budgets come on top."""

    computing_time: float = 5.0
    """Seconds of its own computing and of checking it; the robot's time is not in it."""
    memory: int = 64 * 2**20
    """Bytes; checking a program takes about 10 MiB of them."""
    recursion_depth: int = 200
    """Function calls inside one another."""
    calls: int = 100_000
    """Calls of the API, of which many take the robot no time."""
    printed_characters: int = 10_000
    """Characters of its printing that are kept; the rest is dropped, and said to be."""
    text_characters: int = 1_000
    """Characters in a text given to the API."""
    program_characters: int = 50_000
    """Characters of the program itself."""

    def __post_init__(self) -> None:
        """Check the limits."""
        for name in self.__slots__:
            value = getattr(self, name)
            if not value > 0:
                raise SettingsError(f"{name} must be greater than 0, not {value}")
        if self.computing_time > LONGEST_COMPUTING_TIME:
            raise SettingsError(
                f"computing_time must be at most {LONGEST_COMPUTING_TIME:g} s, "
                f"not {self.computing_time:g}"
            )


DEFAULT_LIMITS = ProgramLimits()
