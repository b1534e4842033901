"""`memorymaze sites import`: a plan from another format."""

import argparse
import sys
from dataclasses import replace
from pathlib import Path

from memorymaze.basics.wording import counted
from memorymaze.front.cli.verbs import Verbs, given_path
from memorymaze.world.importing import SOURCE_FORMATS, import_site

DONE, FAILED = 0, 1


def add_import(verbs: Verbs) -> None:
    """Add the verb to `memorymaze sites`."""
    parser = verbs.add_parser(
        "import",
        help="make a plan of a building in another format",
        description="Make a site plan of one floor of a building: CaBot or HULOP map data "
        "(MapData.geojson), an IMDF archive, OpenStreetMap indoor data (.osm or Overpass "
        "JSON), a ROS map (map.yaml), or a mesh of a floor (.glb). Prints what it took, "
        "what it guessed, what is missing, and what `sites check` finds "
        "(docs/importing.md). Exit code 1 where the plan has errors.",
        epilog="example: memorymaze sites import "
        "tests/world/importing/data/quay_house_MapData.geojson --from cabot --floor 2F "
        '--route Elevator "Rope Workshop" --out quay_house.geojson',
    )
    parser.add_argument("file", metavar="FILE", type=given_path, help="what to import")
    parser.add_argument(
        "--from",
        dest="format",
        choices=SOURCE_FORMATS,
        required=True,
        help="its format",
    )
    parser.add_argument("--floor", help="which floor, where the file has several")
    parser.add_argument(
        "--narrowest",
        type=float,
        metavar="METRES",
        help="of a ROS map, leave out what lies behind ways narrower than this, such as "
        "rooms behind doors with 1.2 (default: 0.5, what a robot needs)",
    )
    parser.add_argument(
        "--route",
        nargs=2,
        metavar=("FROM", "TO"),
        action="append",
        default=[],
        help="add a reference route: ids or names of rooms, doors or things, or x,y in "
        "metres; can be repeated",
    )
    parser.add_argument(
        "--out",
        metavar="FILE",
        type=given_path,
        required=True,
        help="plan to write (*.geojson)",
    )
    parser.set_defaults(run=_import)


def _import(args: argparse.Namespace) -> int:
    from memorymaze.basics.durable_files import check_new_file
    from memorymaze.basics.errors import SettingsError
    from memorymaze.world.sites import find_site_problems
    from memorymaze.world.sites.loading import SNAKE_CASE

    out: Path = args.out
    if not SNAKE_CASE.fullmatch(out.stem) or out.suffix != ".geojson":
        raise SettingsError(
            "--out: expected small letters, digits and underscores and .geojson, such as "
            f"annex_2.geojson, got {out.name!r}"
        )
    check_new_file(out)
    imported = import_site(
        args.file,
        args.format,
        floor=args.floor,
        narrowest=args.narrowest,
        routes=args.route,
    )
    for heading, lines in (
        ("took", imported.took),
        ("guessed", imported.guessed),
        ("missing", imported.missing),
    ):
        for line in lines:
            print(f"{heading}: {line}")
    out.parent.mkdir(parents=True, exist_ok=True)
    replace(imported.site, name=out.stem).save(out)
    problems = find_site_problems(out)
    for problem in problems:
        print(problem.line())
    errors = sum(problem.severity == "error" for problem in problems)
    print(
        f"{out}: {counted(errors, 'error')}, "
        f"{counted(len(problems) - errors, 'warning')}",
        file=sys.stderr,
    )
    return FAILED if errors else DONE
