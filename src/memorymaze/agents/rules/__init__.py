"""The rules agent: follows route descriptions without any model."""

from memorymaze.agents.rules.agent import RulesAgent, RulesOptions

__all__ = ["RulesAgent", "RulesOptions"]
