"""Agents of users' own, from `module:Class` or `file.py:Class`."""

import importlib
import importlib.util
import inspect
import sys
from dataclasses import is_dataclass
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, cast, get_args

from memorymaze.agents.agent import Agent, Need
from memorymaze.agents.failures import failure_line
from memorymaze.errors import SettingsError
from memorymaze.options import read_options


def checked_options(name: str, agent: object) -> type | None:
    """Return the dataclass of an agent's options: its attribute `Options`, if any."""
    options = getattr(agent, "Options", None)
    if options is not None and not (
        isinstance(options, type) and is_dataclass(options)
    ):
        raise SettingsError(
            f"agent {name!r}: expected `Options` to be a dataclass, got {options!r}"
        )
    return options


def checked_needs(name: str, agent: object) -> frozenset[Need]:
    """Return what an agent, or its class, declares in its attribute `needs`."""
    declared = getattr(agent, "needs", frozenset())
    known = get_args(Need)
    if isinstance(declared, str) or not all(each in known for each in declared):
        raise SettingsError(
            f"agent {name!r}: needs: expected a set of some of {', '.join(known)}; got "
            f"{declared!r}"
        )
    return cast(frozenset[Need], frozenset(declared))


def make_own_agent(
    agent: str | type[Agent], options: tuple[tuple[str, str], ...] = ()
) -> Agent:
    """Make an agent of a user's own.

    It is a class, `package.module:Class` or `path/to/file.py:Class`. What lies beside the
    file, or for a module in the current folder, can be imported too. A class that has a
    dataclass `Options` is called with one of these; any other without arguments.
    """
    name = agent if isinstance(agent, str) else agent.__qualname__
    factory: Any = find_agent(agent) if isinstance(agent, str) else agent
    kind = checked_options(name, factory)
    if kind is None and options:
        raise SettingsError(
            f"--set {options[0][0]}: the agent {name!r} has no options to set; give its "
            "class a dataclass `Options`, and it is called with one of these"
        )
    given = () if kind is None else (read_options(kind, options, agent=name),)
    try:
        return checked_agent(name, factory(*given))
    except SettingsError:
        raise
    except (Exception, SystemExit) as error:
        how = "without arguments" if kind is None else "from its options"
        instead = "" if isinstance(agent, str) else "; hand over an object instead"
        raise SettingsError(
            f"agent {name!r}: cannot be made {how} ({failure_line(error)}){instead}"
        ) from error


def find_agent(name: str) -> Any:
    """Return what `module:Class` or `file.py:Class` names; it can be called."""
    place, _, attribute = name.rpartition(":")
    try:
        module = _load(place)
    except (Exception, SystemExit) as error:
        raise SettingsError(
            f"agent {name!r}: {place!r} cannot be imported ({failure_line(error)})"
        ) from error
    factory = getattr(module, attribute, None)
    if not callable(factory):
        raise SettingsError(
            f"agent {name!r}: expected {place!r} to have a class {attribute!r}, got "
            f"{'nothing of this name' if factory is None else repr(factory)}"
        )
    return factory


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
    return agent


def _load(place: str) -> ModuleType:
    if not place.endswith(".py"):
        _look_also_in(Path.cwd())
        return importlib.import_module(place)
    path = Path(place).absolute()
    if not path.is_file():
        raise FileNotFoundError(f"no such file: {place}")
    return _run_file(path, path.stat().st_mtime_ns)


@cache
def _run_file(path: Path, edited: int) -> ModuleType:
    """Run a file; once as long as it stays as it is."""
    # Not its bare name: a user's random.py must not stand in for the library's.
    spec = importlib.util.spec_from_file_location(f"own_agent_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise ImportError(f"cannot be loaded: {path}")
    _look_also_in(path.parent)
    module = importlib.util.module_from_spec(spec)
    # Dataclasses and pickles inside the file look their module up here.
    sys.modules[module.__name__] = module
    spec.loader.exec_module(module)
    return module


def _look_also_in(folder: Path) -> None:
    """Let imports find what lies beside a user's agent, after all that is installed."""
    if str(folder) not in sys.path:
        sys.path.append(str(folder))
