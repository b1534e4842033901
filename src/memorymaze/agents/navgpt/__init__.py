"""The NavGPT agent: a language model picks the next viewpoint, step by step."""

from memorymaze.agents.navgpt.agent import LoopLimits, NavGPTAgent, NavGPTOptions

__all__ = ["LoopLimits", "NavGPTAgent", "NavGPTOptions"]
