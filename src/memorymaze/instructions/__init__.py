"""What people said: instructions, the episodes made of them, and their statistics."""

from memorymaze.instructions.corpus import BUILTIN_CORPUS, load_instructions
from memorymaze.instructions.episodes import episodes
from memorymaze.instructions.records import Episode, Failure, Instruction

__all__ = [
    "BUILTIN_CORPUS",
    "Episode",
    "Failure",
    "Instruction",
    "episodes",
    "load_instructions",
]
