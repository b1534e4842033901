"""`memorymaze navigate`: one instruction, with a picture of the walk."""

import argparse
import contextlib
import sys
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from memorymaze.basics.wording import counted
from memorymaze.front.cli.agent_options import (
    add_agent_name,
    add_agent_options,
    add_episode_options,
    agent_settings,
    one_episode_settings,
)
from memorymaze.front.cli.verbs import Verbs, add_site_and_route, file_stem, given_path

if TYPE_CHECKING:
    from memorymaze.runs.story.onlooker import Onlooker


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    verbs.add_parser(
        "navigate",
        help="run one instruction and draw the walk",
        description="Run one instruction from the start of a route; write trajectory, "
        "trace and a picture.",
        epilog="example: memorymaze navigate university R1 "
        "'Follow the corridor, turn left at its end.'",
        options=_add_options,
    )


def _add_options(parser: argparse.ArgumentParser) -> None:
    parser.usage = "%(prog)s SITE ROUTE TEXT [OPTION …]"
    add_site_and_route(parser)
    parser.add_argument("text", metavar="TEXT", help="the instruction")
    add_agent_name(parser.add_argument, default="guide")
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=given_path,
        help="folder (default: runs/navigate-SITE-ROUTE-TIME)",
    )
    add_agent_options(parser)
    add_episode_options(parser)
    parser.add_argument(
        "--watch",
        action="store_true",
        help="tell what the robot does while it drives, line by line on stderr. For a "
        "page with the plan see memorymaze try",
    )
    parser.add_argument(
        "--pace",
        type=float,
        metavar="X",
        help="with --watch: simulated seconds per second (1 is how fast the robot really "
        "is; default: as fast as it goes)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    import memorymaze as mm
    from memorymaze.runs.episodes.in_words import amount_lines
    from memorymaze.runs.episodes.navigation import check_folder
    from memorymaze.runs.episodes.trace_entries import kept_traceback

    settings = one_episode_settings(options)
    site = mm.load_site(options.site)
    route = site.find_route(options.route)
    folder: Path = options.out or _default_folder(site.name, route.id)
    check_folder(folder)
    onlooker = _onlooker(options)
    # What a user's agent prints is no result.
    with contextlib.redirect_stdout(sys.stderr):
        walk = mm.follow(
            options.text,
            agent_settings(options),
            site=site,
            route=route.id,
            settings=settings,
            watcher=onlooker,
        )
    if onlooker is not None:
        onlooker.end()
    if onlooker is not None and onlooker.trouble is not None:
        print(
            f"memorymaze: note: could not show it all ({onlooker.trouble})",
            file=sys.stderr,
        )
    for line in kept_traceback(walk.run.trace):
        print(line, file=sys.stderr)
    result = walk.result
    outcome = "arrived" if result.success else "did not arrive"
    print(f"{outcome}; stopped by {result.stopped_by}")
    if result.error:
        print(result.error)
    print(
        f"SPD {result.spd:.2f} m, oracle success {'yes' if result.oracle_success else 'no'}, "
        f"CLS {result.cls:.3f}, SPL {result.spl:.3f}, nDTW {result.ndtw:.3f}\n"
        f"{result.path_length:.2f} m in {result.duration_s:.1f} s simulated, "
        f"{counted(result.collisions, 'collision')}, turns in order {result.turns_in_order:.2f}"
    )
    for line in amount_lines(settings, [result]):
        print(line)
    for path in walk.save(folder):
        print(path)


def _onlooker(options: argparse.Namespace) -> "Onlooker | None":
    """Return what tells of the episode while it goes on, where that is wanted."""
    from memorymaze.basics.errors import SettingsError
    from memorymaze.runs.story.onlooker import Onlooker, PlainView

    if options.watch:
        return Onlooker(PlainView(sys.stderr), options.pace)
    if options.pace is not None:
        raise SettingsError("--pace: expected with --watch, got it alone")
    return None


def _default_folder(site: str, route: str) -> Path:
    names = file_stem(f"{site}-{route}")
    return Path("runs") / f"navigate-{names}-{datetime.now():%Y%m%d-%H%M%S}"
