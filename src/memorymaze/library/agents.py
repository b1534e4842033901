"""What one may give as an agent: a name, settings, a class or an object."""

import inspect

from memorymaze.agents.agent import Agent
from memorymaze.agents.own_agents import checked_agent
from memorymaze.errors import SettingsError
from memorymaze.evaluation.settings import AgentSettings

AgentChoice = str | AgentSettings | Agent | type[Agent]
"""An agent by its name, with settings, as a class or as an object."""


def chosen_agent(agent: AgentChoice) -> AgentSettings | Agent:
    """Return an agent as runs take it.

    A class is called without arguments, or with its dataclass `Options` as it stands.

    Raises:
        SettingsError: It is no agent, or cannot be made.
    """
    if isinstance(agent, AgentSettings):
        return agent
    if isinstance(agent, str):
        return AgentSettings(agent)
    if not inspect.isclass(agent):
        return checked_agent(type(agent).__qualname__, agent)
    options = getattr(agent, "Options", None)
    try:
        made = agent() if options is None else agent(options())  # pyright: ignore[reportCallIssue]
    except TypeError as error:
        raise SettingsError(
            f"agent {agent.__qualname__}: cannot be made without arguments ({error}); "
            "hand over an object instead"
        ) from error
    return checked_agent(agent.__qualname__, made)
