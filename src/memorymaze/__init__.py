"""Memory-Maze: guide robots that follow route instructions given from memory."""

import importlib
import sys

__version__ = "0.1.0"

__all__ = ["__version__"]

# `gymnasium.make("memorymaze:MemoryMaze/University-v0")` imports this package to have
# its environments registered. Without Gymnasium nothing of it is loaded.
if "gymnasium" in sys.modules:
    importlib.import_module("memorymaze.gym")
