"""A finder of objects of a user's own, named by `module:Class` or `file.py:Class`.

It is an `ObjectFinder`, made once in each process that runs episodes:

    MyFinder()          # without Options
    MyFinder(options)   # with a dataclass `Options`
"""

import inspect
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import DetectorError, SettingsError
from memorymaze.basics.failures import failure_line
from memorymaze.basics.own_code import find_own, parse_own_options
from memorymaze.robot.perception.picture_detector import FoundBox


@dataclass(frozen=True, slots=True)
class OwnFinder:
    """A user's finder; what it raises or gives amiss is told as a `DetectorError`."""

    name: str
    """For messages."""
    finder: Any

    def __post_init__(self) -> None:
        """Refuse what finds nothing."""
        try:
            inspect.signature(self.finder.find).bind("the picture", "the words")
        except (AttributeError, TypeError):
            raise SettingsError(
                f"detector {self.name!r}: expected a finder with `find(rgb, query)`, got "
                f"{type(self.finder).__name__}"
            ) from None

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        """Return what it finds; see `ObjectFinder.find`."""
        try:
            return [_plain(each) for each in self.finder.find(rgb, query)]
        except DetectorError:
            raise
        except Exception as error:
            raise DetectorError(
                f"detector {self.name!r} failed on {query!r} "
                f"({failure_line(error, self.finder)})"
            ) from error


def _plain(found: object) -> FoundBox:
    """Return a box in Python's own numbers, which a trace can keep."""
    if not isinstance(found, FoundBox):
        raise TypeError(f"expected find to return FoundBox, got {found!r}")
    left, top, right, bottom = map(float, found.box)
    return FoundBox((left, top, right, bottom), found.label, float(found.score))


def make_own_finder(name: str, options: str) -> OwnFinder:
    """Make a user's finder with its options, given as `NAME=VALUE,NAME=VALUE`.

    Raises:
        SettingsError: There is none, it has no such options, or it cannot be made.
    """
    maker = find_own("detector", name)
    read = parse_own_options("detector", name, maker, options)
    try:
        finder = maker() if read is None else maker(read)
    except SettingsError:
        raise
    except (Exception, SystemExit) as error:
        raise SettingsError(
            f"detector {name!r}: cannot be made ({failure_line(error)})"
        ) from error
    return OwnFinder(name, finder)
