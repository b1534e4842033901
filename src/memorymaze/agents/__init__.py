"""Agents that follow route instructions: a text and a robot in, motion out.

Holds the role (`agent`), the agents that come with the package, how agents of users' own
are found, made and told apart, and the process of its own that one may live in
(`isolated`). Does not hold sites or answers: agents see what their robot tells them.
"""

from memorymaze.agents.agent import Agent, Journal
from memorymaze.agents.explorer import ExplorerAgent
from memorymaze.agents.guide import GuideAgent
from memorymaze.agents.rules import RulesAgent
from memorymaze.agents.stop import StopAgent

__all__ = [
    "Agent",
    "ExplorerAgent",
    "GuideAgent",
    "Journal",
    "RulesAgent",
    "StopAgent",
]
