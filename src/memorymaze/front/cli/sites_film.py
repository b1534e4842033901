"""`memorymaze sites film`: the first-person video of a route."""

import argparse

from memorymaze.front.cli.replay import picture_size
from memorymaze.front.cli.verbs import Verbs, add_site_and_route, file_stem, given_path


def add_film(actions: Verbs) -> None:
    """Add the action to `memorymaze sites`."""
    parser = actions.add_parser(
        "film",
        help="make the first-person video of a route",
        description="Make the first-person video of a route, or a 360-degree one; "
        "needs the extra [video].",
        epilog="example: memorymaze sites film museum_5f R1 --panorama --out R1.mp4",
    )
    add_site_and_route(parser)
    parser.add_argument(
        "--out",
        metavar="FILE",
        type=given_path,
        help="video (default: walkthrough-SITE-ROUTE.mp4)",
    )
    parser.add_argument(
        "--panorama",
        action="store_true",
        help="look all round, for players of 360-degree videos",
    )
    parser.add_argument(
        "--fps", type=float, default=20.0, metavar="N", help="frames a second (20)"
    )
    parser.add_argument(
        "--speed",
        type=float,
        default=1.0,
        metavar="X",
        help="times as fast as the robot drives, which is up to 1 m/s (1)",
    )
    parser.add_argument(
        "--size",
        type=picture_size,
        metavar="WxH",
        help="pixels (960x540; with --panorama 1280x640)",
    )
    parser.add_argument(
        "--looks",
        default="own",
        metavar="LOOKS",
        help="how things look: own, mesh (PLAN.glb beside the plan), or a GLB file with "
        "models of yours over our own (docs/seeing.md)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.robot.simulation.scene import build_scene
    from memorymaze.runs.films import WalkthroughSettings
    from memorymaze.runs.films.walkthrough import film_walkthrough
    from memorymaze.world.sites import load_site

    settings = WalkthroughSettings(
        size=options.size,
        panorama=options.panorama,
        fps=options.fps,
        speed=options.speed,
        looks=options.looks,
    )
    site = load_site(options.site)
    route = site.find_route(options.route)
    name = file_stem(f"{site.name}-{options.route}")
    path = options.out or f"walkthrough-{name}.mp4"
    count = film_walkthrough(build_scene(site), route, path, settings, progress=True)
    seconds = count / settings.fps
    print(f"{path}: {seconds:.0f} s, {count} frames")
