"""`memorymaze sites import`: a plan from another format."""

import argparse
import json
import sys
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, cast

from memorymaze.cli.verbs import Verbs
from memorymaze.wording import counted

if TYPE_CHECKING:
    from memorymaze.importing.imported import ImportedSite
    from memorymaze.sites.plan_writing import Feature

DONE, FAILED = 0, 1
FORMATS = ("cabot", "imdf", "osm", "ros_map", "mesh")
ON_FLOORS = ("cabot", "imdf", "osm")
"""Formats that hold several floors."""


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
        epilog="example: memorymaze sites import MapData.geojson --from cabot --floor 4F "
        '--route "Main entrance" "Room 401" --out my_buildings/annex.geojson',
    )
    parser.add_argument("file", metavar="FILE", type=Path, help="what to import")
    parser.add_argument(
        "--from", dest="format", choices=FORMATS, required=True, help="its format"
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
        type=Path,
        required=True,
        help="plan to write (*.geojson)",
    )
    parser.set_defaults(run=_import)


def _import(args: argparse.Namespace) -> int:
    from memorymaze.durable_files import write_new
    from memorymaze.errors import SettingsError
    from memorymaze.importing.reference_route import reference_route
    from memorymaze.sites.checking import plan_problems
    from memorymaze.sites.loading import SNAKE_CASE, sound_site
    from memorymaze.sites.plan_writing import plan_bytes
    from memorymaze.sites.reading import understand_plan

    out: Path = args.out
    if not SNAKE_CASE.fullmatch(out.stem) or out.suffix != ".geojson":
        raise SettingsError(
            "--out: expected small letters, digits and underscores and .geojson, such as "
            f"annex_2.geojson, got {out.name!r}"
        )
    if args.floor and args.format not in ON_FLOORS:
        raise SettingsError(
            f"--floor: expected with {', '.join(ON_FLOORS)}, got {args.format}, which has "
            "one floor"
        )
    if args.narrowest is not None and args.format != "ros_map":
        raise SettingsError(f"--narrowest: expected with ros_map, got {args.format}")
    imported = _imported(args)
    for heading, lines in (
        ("took", imported.took),
        ("guessed", imported.guessed),
        ("missing", imported.missing),
    ):
        for line in lines:
            print(f"{heading}: {line}")
    features = cast("list[Feature]", imported.plan["features"])
    header = {
        name: member
        for name, member in imported.plan.items()
        if name not in ("type", "features")
    } | {"name": out.stem}
    for start, goal in args.route:
        plan = understand_plan({**imported.plan, "features": features})
        features = [*features, reference_route(sound_site(plan, str(out)), start, goal)]
    content = plan_bytes(header, features)
    problems = plan_problems(understand_plan(json.loads(content)), out)
    for problem in problems:
        print(problem.line())
    out.parent.mkdir(parents=True, exist_ok=True)
    write_new(out, content)
    errors = sum(problem.severity == "error" for problem in problems)
    print(
        f"{out}: {counted(errors, 'error')}, "
        f"{counted(len(problems) - errors, 'warning')}",
        file=sys.stderr,
    )
    return FAILED if errors else DONE


def _imported(args: argparse.Namespace) -> "ImportedSite":
    module = import_module(f"memorymaze.importing.{args.format}")
    options = {"floor": args.floor, "narrowest": args.narrowest}
    given = {name: value for name, value in options.items() if value is not None}
    return getattr(module, f"import_{args.format}")(args.file, **given)
