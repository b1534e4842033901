"""Agents that follow route instructions; one line in `AGENTS` makes one known."""

from collections.abc import Callable

from memorymaze.agents.agent import Agent, Journal
from memorymaze.agents.rules import RulesAgent
from memorymaze.agents.stop import StopAgent

__all__ = ["AGENTS", "Agent", "Journal", "RulesAgent", "StopAgent"]

AGENTS: dict[str, Callable[[], Agent]] = {
    "rules": RulesAgent,
    "stop": StopAgent,
}
"""Makers of agents by the name they have on the command line."""
