"""How agents are made, those of the package like users' own: found, read, checked.

An agent is named by `module:Class` or `file.py:Class`. Its class may have a dataclass
`Options`, and says in `needs` what it needs besides text and robot; options may add to that
by an attribute `needs` of their own. It is called

    Class()                         # without Options
    Class(options)                  # with Options
    Class(options, model=model)     # where it needs a language model
    Class(model=model)              # without Options, where it needs one
"""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, cast, get_args

from memorymaze.agents.agent import Agent, Need
from memorymaze.basics.errors import SettingsError
from memorymaze.basics.failures import failure_line
from memorymaze.basics.options import read_options
from memorymaze.basics.own_code import checked_options, find_own
from memorymaze.language.models.model import LanguageModel


@dataclass(frozen=True, slots=True)
class AgentRecipe:
    """What an agent is made by, with its options read and its needs known."""

    name: str
    """Of the agent, for messages; where it was found, for one that is nobody's here."""
    maker: Any
    """Its class, or whatever else can be called for it."""
    given: tuple[tuple[str, str], ...]
    """Options by name, as they were given."""
    options: Any
    """Of its dataclass `Options`; None where it has none."""
    needs: frozenset[Need]
    """With what the options add."""
    handed_over: bool
    """Whether it was handed over itself, and not by its name."""

    def make(self, model: LanguageModel | None = None) -> Agent:
        """Make the agent, with a model where it takes one."""
        given = () if self.options is None else (self.options,)
        named = {} if model is None else {"model": model}
        try:
            return checked_agent(self.name, self.maker(*given, **named))
        except SettingsError:
            raise
        except (Exception, SystemExit) as error:
            how = ["from its options"] if given else []
            how += ["with model=, as it needs a language model"] if named else []
            told = " and ".join(how) or "without arguments"
            instead = "; hand over an object instead" if self.handed_over else ""
            raise SettingsError(
                f"agent {self.name!r}: cannot be made {told} ({failure_line(error)})"
                f"{instead}"
            ) from error

    def with_options(self, given: tuple[tuple[str, str], ...]) -> "AgentRecipe":
        """Return it with other options."""
        return agent_recipe(self.name, self.maker, given, handed_over=self.handed_over)

    def maker_elsewhere(self) -> Callable[[LanguageModel | None], Agent]:
        """Return what makes the agent in another process, which finds it there again."""
        if self.handed_over:
            return self.make
        return partial(_make_again, self.name, self.given)


def _make_again(
    name: str, given: tuple[tuple[str, str], ...], model: LanguageModel | None
) -> Agent:
    return agent_recipe(name, find_own("agent", name), given).make(model)


def agent_recipe(
    name: str,
    maker: Any,
    given: tuple[tuple[str, str], ...] = (),
    *,
    handed_over: bool = False,
) -> AgentRecipe:
    """Read the options of what makes an agent, and what it needs with them."""
    kind = checked_options("agent", name, maker)
    if kind is None and given:
        own = (
            "; give its class a dataclass `Options`, and it is called with one of these"
        )
        raise SettingsError(
            f"--set {given[0][0]}: the agent {name!r} has no options to set"
            + (own if ":" in name else "")
        )
    options = None if kind is None else read_options(kind, given, agent=name)
    needs = checked_needs(name, maker) | checked_needs(name, options)
    return AgentRecipe(name, maker, given, options, needs, handed_over)


def checked_needs(name: str, agent: object) -> frozenset[Need]:
    """Return what an agent, its class or its options declare in an attribute `needs`."""
    declared = getattr(agent, "needs", frozenset())
    known = get_args(Need)
    if isinstance(declared, str) or not all(each in known for each in declared):
        raise SettingsError(
            f"agent {name!r}: needs: expected a set of some of {', '.join(known)}; got "
            f"{declared!r}"
        )
    return cast(frozenset[Need], frozenset(declared))


def checked_agent(name: str, agent: Any) -> Agent:
    """Return an agent that has what every episode needs of one."""
    follow = getattr(agent, "follow", None)
    if not (callable(follow) and hasattr(agent, "name")):
        raise SettingsError(
            f"agent {name!r}: expected an agent with `name` and `follow(instruction, "
            f"robot, journal, rng)`, got {type(agent).__name__}"
        )
    called = agent.name
    if not (isinstance(called, str) and called.strip() and called.isprintable()):
        raise SettingsError(
            f"agent {name!r}: expected its `name` to be one line of text, got {called!r}"
        )
    signature = inspect.signature(follow)
    try:
        signature.bind("the text", "the robot", "the journal", "the rng")
    except TypeError:
        raise SettingsError(
            f"agent {name!r}: expected follow(instruction, robot, journal, rng), got "
            f"follow{signature}"
        ) from None
    if (
        inspect.iscoroutinefunction(follow)
        or inspect.isgeneratorfunction(follow)
        or inspect.isasyncgenfunction(follow)
    ):
        raise SettingsError(
            f"agent {name!r}: expected a follow that walks when it is called, got one "
            "with async or yield, of which nothing would run"
        )
    return agent
