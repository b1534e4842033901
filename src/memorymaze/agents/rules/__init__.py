"""The offline default agent: route descriptions read by grammar and followed by rules."""

from memorymaze.agents.rules.agent import RulesAgent

__all__ = ["RulesAgent"]
