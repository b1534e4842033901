"""The guide agent: a belief over the way told, doubts, repair and arrival."""

from memorymaze.agents.guide.agent import GuideAgent, GuideOptions

__all__ = ["GuideAgent", "GuideOptions"]
