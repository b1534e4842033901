"""What crosses between a program and the robot: arguments in, results out."""

import dataclasses
import functools
import inspect
import math
from collections import namedtuple
from numbers import Integral, Real
from typing import Any

from memorymaze.robot.api import Robot
from memorymaze.robot.specification import API_NAMES


def read_arguments(
    call: str, args: tuple[Any, ...], kwargs: dict[str, Any], text_limit: int
) -> dict[str, Any]:
    """Return a call's arguments by name, of the types the API asks for.

    Args:
        call: Name of the API function.
        args: Positional arguments as they came out of the sandbox.
        kwargs: Keyword arguments.
        text_limit: The most characters a text may have.

    Raises:
        TypeError: Arguments are missing, too many, or of another type.
        ValueError: A number is not finite, or a text too long.
    """
    signature = _signatures()[call]
    try:
        arguments = signature.bind(*args, **kwargs).arguments
    except TypeError as error:
        raise TypeError(f"{call}(): {error}") from None
    return {
        name: _read(f"{call}(): {name}", signature.parameters[name], value, text_limit)
        for name, value in arguments.items()
    }


def to_sandbox(value: Any) -> Any:
    """Turn a robot's result into what a program can hold.

    Records become named tuples: attributes by the same names, immutable, hashable.

    Raises:
        TypeError: The value is nothing the API returns: a mistake of the robot's.
    """
    match value:
        case None | bool() | str():
            return value
        case Integral():
            return int(value)
        case Real():
            return float(value)
        case list():
            return [to_sandbox(item) for item in value]
        case tuple():
            return tuple(to_sandbox(item) for item in value)
        case _ if dataclasses.is_dataclass(value) and not isinstance(value, type):
            record = _record_type(type(value))
            return record(
                *(to_sandbox(getattr(value, name)) for name in record._fields)
            )
        case _:
            raise TypeError(
                f"a robot returned {type(value).__name__}, which is not part of its API"
            )


@functools.cache
def _signatures() -> dict[str, inspect.Signature]:
    """Return each API function's signature without `self`."""
    signatures: dict[str, inspect.Signature] = {}
    for name in API_NAMES:
        whole = inspect.signature(getattr(Robot, name))
        signatures[name] = whole.replace(parameters=list(whole.parameters.values())[1:])
    return signatures


@functools.cache
def _record_type(record: type[Any]) -> Any:
    names = [field.name for field in dataclasses.fields(record)]
    # Its fields are known only when it is made, so there are no types to give.
    return namedtuple(  # pyright: ignore[reportUntypedNamedTuple]
        record.__name__, names, module="robot"
    )


def _read(
    name: str, parameter: inspect.Parameter, value: object, text_limit: int
) -> object:
    if parameter.annotation is float:
        return _read_number(name, value)
    return _read_text(name, value, text_limit)


def _read_number(name: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"{name} must be a number, not {type(value).__name__}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"{name} must be a finite number, not {number}")
    return number


def _read_text(name: str, value: object, text_limit: int) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name} must be text, not {type(value).__name__}")
    if len(value) > text_limit:
        raise ValueError(
            f"{name} must have at most {text_limit} characters, not {len(value)}"
        )
    return value
