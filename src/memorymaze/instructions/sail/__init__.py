"""SAIL: mazes and instructions of "Walk the Talk", as sites and a corpus."""

from memorymaze.instructions.sail.episodes import (
    DEVELOPMENT,
    paragraph_of,
    sail_corpus,
    sail_episodes,
)
from memorymaze.instructions.sail.folder import is_sail_folder, load_sail
from memorymaze.instructions.sail.records import Paragraph
from memorymaze.instructions.sail.sites import EDGE, maze_site

__all__ = [
    "DEVELOPMENT",
    "EDGE",
    "Paragraph",
    "is_sail_folder",
    "load_sail",
    "maze_site",
    "paragraph_of",
    "sail_corpus",
    "sail_episodes",
]
