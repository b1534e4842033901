"""Memory-Maze: guide robots that follow route instructions given from memory."""

__version__ = "0.1.0"

__all__ = ["__version__"]
