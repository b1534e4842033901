"""SAIL: mazes and instructions of "Walk the Talk", as sites and episodes."""

from memorymaze.instructions.sail.episodes import (
    DEVELOPMENT,
    HEADINGS,
    paragraph_of,
    sail_episodes,
)
from memorymaze.instructions.sail.folder import load_sail
from memorymaze.instructions.sail.records import (
    Cell,
    Corpus,
    Hall,
    Maze,
    Node,
    Paragraph,
)
from memorymaze.instructions.sail.sites import EDGE, HALL_WIDTH, maze_plan, maze_site

__all__ = [
    "DEVELOPMENT",
    "EDGE",
    "HALL_WIDTH",
    "HEADINGS",
    "Cell",
    "Corpus",
    "Hall",
    "Maze",
    "Node",
    "Paragraph",
    "load_sail",
    "maze_plan",
    "maze_site",
    "paragraph_of",
    "sail_episodes",
]
