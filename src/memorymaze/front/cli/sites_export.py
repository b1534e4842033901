"""`memorymaze sites export`: a site in the format of another program."""

import argparse
import sys
from pathlib import Path

from memorymaze.front.cli.verbs import Verbs, add_plan, given_path


def add_export(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "export",
        help="write a site in the format of another program",
        description=(
            "Write a building with its materials, textures, names and ids for another "
            "program (docs/simulators.md), and print the file to open there first."
        ),
        epilog="example: memorymaze sites export museum_5f --to gltf --out museum_5f.glb",
        options=_add_options,
    )
    parser.set_defaults(run=_export)


def _add_options(parser: argparse.ArgumentParser) -> None:
    from memorymaze.world.exporting import FORMATS

    add_plan(parser)
    parser.add_argument("--to", choices=FORMATS, required=True, help="the format")
    parser.add_argument(
        "--out",
        metavar="PATH",
        type=given_path,
        help="file or folder to make, which must not be there (default: the site's name "
        "with what the format's files end in)",
    )
    parser.add_argument(
        "--resolution",
        metavar="METRES",
        type=float,
        help="metres per pixel of a ROS map (default: 0.05)",
    )
    parser.add_argument(
        "--lanes",
        choices=("sidewalk", "driving"),
        help="for whom the lanes for CARLA are (default: sidewalk)",
    )


def _export(args: argparse.Namespace) -> None:
    from memorymaze.world.exporting import FILE_ENDINGS, export_site
    from memorymaze.world.sites import load_site

    site = load_site(args.site)
    out: Path = args.out or Path(f"{Path(site.source).stem}{FILE_ENDINGS[args.to]}")
    files = export_site(
        site, args.to, out, resolution=args.resolution, lanes=args.lanes
    )
    print(files[0])
    if args.to == "carla" and not any(each.suffix == ".fbx" for each in files):
        from memorymaze.world.exporting.carla import WITHOUT_ASSIMP

        print(WITHOUT_ASSIMP, file=sys.stderr)
