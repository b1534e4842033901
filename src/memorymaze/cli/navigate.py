"""`memorymaze navigate`: one instruction, with a picture of the walk."""

import argparse
import contextlib
import sys
from datetime import datetime
from pathlib import Path
from urllib.parse import quote

from memorymaze.cli.agent_options import (
    add_agent_options,
    add_episode_options,
    agent_settings,
    episode_settings,
)
from memorymaze.cli.plan_argument import plan_path
from memorymaze.cli.verbs import Verbs

__all__ = ["add_parser"]


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "navigate",
        help="run one instruction and draw the walk",
        description="Run one instruction from the start of a route; write trajectory, "
        "trace and a picture.",
        epilog="example: memorymaze navigate university R1 "
        "'Follow the corridor, turn left at its end.'",
    )
    parser.add_argument("site", metavar="SITE", help="a shipped site, or a plan file")
    parser.add_argument(
        "route", metavar="ROUTE", help="R1, R2, … or the id of a route in the plan"
    )
    parser.add_argument("text", metavar="TEXT", help="the instruction")
    add_agent_options(parser, default="rules")
    parser.add_argument(
        "--out", metavar="DIR", help="folder (default: runs/navigate-SITE-ROUTE-TIME)"
    )
    add_episode_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.evaluation.navigation import (
        check_folder,
        find_route,
        navigate,
        write_navigation,
    )
    from memorymaze.sites import load_site

    site = load_site(plan_path(options.site))
    route = find_route(site, options.route)
    folder = Path(options.out or _default_folder(site.name, route.id))
    check_folder(folder)
    # What a user's agent prints is no result.
    with contextlib.redirect_stdout(sys.stderr):
        run = navigate(
            site,
            route,
            options.text,
            agent_settings(options),
            **episode_settings(options),
        )
    result = run.result
    outcome = "arrived" if result.success else "did not arrive"
    print(f"{outcome}; stopped by {result.stopped_by}")
    if result.error:
        print(result.error)
    print(
        f"SPD {result.spd:.2f} m, oracle success {'yes' if result.oracle_success else 'no'}, "
        f"CLS {result.cls:.3f}, SPL {result.spl:.3f}, nDTW {result.ndtw:.3f}\n"
        f"{result.path_length:.2f} m in {result.duration_s:.1f} s simulated, "
        f"{result.collisions} collisions, turns in order {result.turns_in_order:.2f}"
    )
    if result.model_calls:
        print(
            f"language model: {result.model_calls} calls, {result.tokens} tokens, "
            f"{result.cost_usd:.4f} USD, {result.inference_s:.1f} s of inference; the "
            f"user stands waiting {result.standing_s:.1f} s"
        )
    for path in write_navigation(run, site, route, folder):
        print(path)
    return 0


def _default_folder(site: str, route: str) -> Path:
    # A plan may be called anything, also `../../x`.
    names = quote(f"{site}-{route}", safe="")[:100]
    return Path("runs") / f"navigate-{names}-{datetime.now():%Y%m%d-%H%M%S}"
