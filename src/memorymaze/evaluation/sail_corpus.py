"""Running agents on SAIL: its episodes, and the settings that belong to them."""

from dataclasses import replace
from pathlib import Path

from memorymaze.evaluation.plan import EpisodeCorpus
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.instructions.sail import EDGE, load_sail, maze_site, sail_episodes
from memorymaze.simulation.settings import SimulationSettings

SAIL_SUCCESS_DISTANCE = EDGE / 2
"""Metres: at the right node, not at its neighbour."""
SAIL_TIME_BUDGET = 400.0
"""Simulated seconds. Three times a perfect walk, as elsewhere, is 188 s; the rest is for
looking about, since nobody tells which way one faces at first."""
SAIL_DETECTION_RANGE = 40.0
"""Metres: to the end of every hall, which is how far writers and followers saw."""


def sail_corpus(folder: str | Path) -> EpisodeCorpus:
    """Read a SAIL folder; return four episodes for each paragraph.

    Raises:
        MemoryMazeError: The folder or something in it cannot be used.
    """
    corpus = load_sail(folder)
    source = corpus.files[0]
    sites = [maze_site(maze, source) for maze in corpus.mazes.values()]
    by_name = {site.name: site for site in sites}
    return EpisodeCorpus(
        sail_episodes(corpus.paragraphs, by_name), by_name, corpus.files
    )


def sail_abilities(simulation: SimulationSettings | None = None) -> SimulationSettings:
    """Return a robot that sees to the ends of halls."""
    return replace(
        simulation or SimulationSettings(), detection_range=SAIL_DETECTION_RANGE
    )


def sail_agent(agent: AgentSettings) -> AgentSettings:
    """Tell the rules agent that the start heading is not part of the task."""
    told = {name for name, _ in agent.options}
    if agent.name != "rules" or "start_heading" in told:
        return agent
    return replace(agent, options=(*agent.options, ("start_heading", "unknown")))
