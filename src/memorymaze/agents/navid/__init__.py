"""The NaVid protocol: pictures so far and an instruction in, one short motion out."""

from memorymaze.agents.navid.agent import NavidAgent
from memorymaze.agents.navid.options import NavidOptions

__all__ = ["NavidAgent", "NavidOptions"]
