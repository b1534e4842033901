"""The closed-loop agent: a language model says at each turning point what to do next."""

from memorymaze.agents.closed_loop.agent import ClosedLoopAgent, ClosedLoopOptions

__all__ = ["ClosedLoopAgent", "ClosedLoopOptions"]
