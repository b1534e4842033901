"""The NavGPT agent: a language model picks the next viewpoint, step by step."""

from memorymaze.agents.navgpt.agent import NavGPTAgent
from memorymaze.agents.navgpt.settings import LoopLimits, NavGPTOptions

__all__ = ["LoopLimits", "NavGPTAgent", "NavGPTOptions"]
