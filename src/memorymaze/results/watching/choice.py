"""From `--watch` to the view that shows an episode."""

import sys
from collections.abc import Generator
from contextlib import contextmanager
from typing import Literal

from memorymaze.results.watching.onlooker import (
    DEFAULT_PACE,
    Onlooker,
    check_pace,
)
from memorymaze.results.watching.plain_view import PlainView
from memorymaze.sites import Route, Site

WatchKind = Literal["terminal", "browser"]


@contextmanager
def watching(
    kind: WatchKind, site: Site, route: Route, text: str, title: str, pace: float | None
) -> Generator[Onlooker]:
    """Open a view for the length of an episode; call the onlooker's `end` in it.

    In the terminal only where stdout and stderr are one; plain lines on stderr
    otherwise, which are held to a pace only when one is asked for.

    Args:
        kind: Where to show it.
        site: Where the episode takes place.
        route: The way that the text describes.
        text: The instruction.
        title: Of the view.
        pace: Simulated seconds per second; None for the view's own.

    Raises:
        SettingsError: The pace is out of range.
    """
    if pace is not None:
        check_pace(pace)
    shown_pace = DEFAULT_PACE if pace is None else pace
    if kind == "browser":
        from memorymaze.results.watching.browser_view import BrowserView

        with BrowserView(site, route, text, title) as view:
            view.wait_for_somebody()
            yield Onlooker(view, shown_pace)
    elif sys.stdout.isatty() and sys.stderr.isatty():
        from memorymaze.results.watching.terminal_view import TerminalView

        with TerminalView(site, route, text, title) as view:
            yield Onlooker(view, shown_pace)
    else:
        yield Onlooker(PlainView(sys.stderr), pace)
