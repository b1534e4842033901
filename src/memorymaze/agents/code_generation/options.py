"""The variants of code generation, as settings."""

from dataclasses import dataclass
from typing import Literal

from memorymaze.errors import SettingsError


@dataclass(frozen=True, slots=True)
class CodeGenerationOptions:
    """How the language model is asked.

    Raises:
        SettingsError: A value has no meaning.
    """

    stages: Literal["two", "single"] = "two"
    """Prompting in two stages as in the paper (thought, output, second thought, refined
    output), or in a single one (thought, output)."""
    repair: bool = False
    """Whether a program that fails is mended once, by a second inference that is told the
    error and what the robot did until then."""
    temperature: float = 0.0
    """Of all requests."""
    max_tokens: int = 4096
    """Longest reply to a request, all its parts together."""
    seed: int | None = None
    """Passed to the model; none sends no seed."""
    grammar: bool = True
    """Whether models that can be held to a grammar (local ones, and servers with
    --grammar) are held to well-formed steps and programs, which leaves no room for
    thoughts."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        if not 0 <= self.temperature <= 2:
            raise SettingsError(
                f"--set temperature: expected 0 to 2, got {self.temperature:g}"
            )
        if self.max_tokens < 1:
            raise SettingsError(
                f"--set max_tokens: expected at least 1, got {self.max_tokens}"
            )
