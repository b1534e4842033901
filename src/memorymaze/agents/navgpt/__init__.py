"""The NavGPT agent: a language model picks the next viewpoint, step by step."""

from memorymaze.agents.navgpt.agent import (
    CaptionOptions,
    LoopLimits,
    NavGPTAgent,
    NavGPTOptions,
)

__all__ = ["CaptionOptions", "LoopLimits", "NavGPTAgent", "NavGPTOptions"]
