"""Memory-Maze: guide robots that follow route instructions given from memory.

    import memorymaze as mm

    walk = mm.follow("Along the hall, then left.", site="university", route="R1")
    run = mm.evaluate(MyAgent(), mm.load_corpus(), limit=60, out="runs/mine")
    print(run.table())

See `docs/python.md`. What is named here is loaded when it is first used.
"""

import importlib
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from memorymaze.agents.agent import Agent, Journal
    from memorymaze.basics.tables import Table
    from memorymaze.front.library.runs import (
        Comparison,
        Run,
        compare,
        evaluate,
        load_run,
    )
    from memorymaze.front.library.walks import Walk, follow, make_robot
    from memorymaze.language.models.model_settings import ModelSettings
    from memorymaze.robot.api.control import Robot
    from memorymaze.robot.api.steps import SteppingRobot
    from memorymaze.robot.simulation.obstacles import ObstacleSettings
    from memorymaze.robot.simulation.settings import SimulationSettings
    from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
    from memorymaze.texts.corpus.corpus import load_corpus
    from memorymaze.texts.corpus.records import Corpus, Episode, Instruction
    from memorymaze.world.construction import make_building
    from memorymaze.world.exporting import export_site
    from memorymaze.world.importing import import_site
    from memorymaze.world.sites.loading import load_site
    from memorymaze.world.sites.records import Site

__version__ = "0.2.0"

__all__ = [
    "Agent",
    "AgentSettings",
    "Comparison",
    "Corpus",
    "Episode",
    "Instruction",
    "Journal",
    "ModelSettings",
    "ObstacleSettings",
    "Robot",
    "Run",
    "RunSettings",
    "SimulationSettings",
    "Site",
    "SteppingRobot",
    "Table",
    "Walk",
    "__version__",
    "compare",
    "evaluate",
    "export_site",
    "follow",
    "import_site",
    "load_corpus",
    "load_run",
    "load_site",
    "make_building",
    "make_robot",
]

_ROOMS = {
    "agents.agent": ("Agent", "Journal"),
    "world.construction": ("make_building",),
    "runs.episodes.settings": ("AgentSettings", "RunSettings"),
    "world.exporting": ("export_site",),
    "world.importing": ("import_site",),
    "texts.corpus.corpus": ("load_corpus",),
    "texts.corpus.records": ("Corpus", "Episode", "Instruction"),
    "language.models.model_settings": ("ModelSettings",),
    "front.library.runs": ("Comparison", "Run", "compare", "evaluate", "load_run"),
    "front.library.walks": ("Walk", "follow", "make_robot"),
    "robot.api.control": ("Robot",),
    "robot.api.steps": ("SteppingRobot",),
    "robot.simulation.obstacles": ("ObstacleSettings",),
    "robot.simulation.settings": ("SimulationSettings",),
    "world.sites.loading": ("load_site",),
    "world.sites.records": ("Site",),
    "basics.tables": ("Table",),
}
_MODULE_OF = {name: room for room, names in _ROOMS.items() for name in names}


def __getattr__(name: str) -> Any:
    """Load what is named on the front door, from its room."""
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'memorymaze' has no attribute {name!r}")
    value = getattr(importlib.import_module(f"memorymaze.{_MODULE_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Return the names of the front door."""
    return sorted({*globals(), *__all__})


# `gymnasium.make("memorymaze:MemoryMaze/University-v0")` imports this package to have
# its environments registered. Without Gymnasium nothing of it is loaded.
if "gymnasium" in sys.modules:
    importlib.import_module("memorymaze.gym")
