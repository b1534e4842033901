"""SAIL: mazes and instructions of "Walk the Talk", as sites and a corpus."""

from memorymaze.texts.corpus.sail.episodes import (
    DEVELOPMENT,
    paragraph_of,
    sail_corpus,
    sail_episodes,
)
from memorymaze.texts.corpus.sail.folder import is_sail_folder, load_sail
from memorymaze.texts.corpus.sail.records import Paragraph
from memorymaze.texts.corpus.sail.sites import EDGE, maze_site

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
