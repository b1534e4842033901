"""Agents that follow route instructions; one line in `AGENTS` makes one known."""

from collections.abc import Callable

from memorymaze.agents.agent import Agent, Journal
from memorymaze.agents.stop import StopAgent

__all__ = ["AGENTS", "Agent", "Journal", "StopAgent"]

AGENTS: dict[str, Callable[[], Agent]] = {
    "stop": StopAgent,
}
"""Makers of agents by the name they have on the command line."""
