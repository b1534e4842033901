"""`memorymaze sites`: list, begin, edit, make, import, export, check and draw plans."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from memorymaze.basics.wording import counted
from memorymaze.front.cli.sites_edit import add_edit
from memorymaze.front.cli.sites_export import add_export
from memorymaze.front.cli.sites_film import add_film
from memorymaze.front.cli.sites_import import add_import
from memorymaze.front.cli.verbs import Verbs, add_plan, given_path

if TYPE_CHECKING:
    from memorymaze.world.sites import Site

DONE, FAILED = 0, 1


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "sites",
        help="list, begin, edit, make, import, export, check, draw and film site plans",
        description="List, begin, edit, make, check, draw and film site plans "
        "(docs/buildings.md), import them from other formats (docs/importing.md) and "
        "export them (docs/simulators.md).",
        epilog="example: memorymaze sites draw university",
    )
    parts = parser.add_subparsers(title="verbs", metavar="VERB", required=True)
    _add_list(parts)
    _add_new(parts)
    add_edit(parts)
    _add_generate(parts)
    _add_check(parts)
    _add_draw(parts)
    add_import(parts)
    add_export(parts)
    add_film(parts)


def _add_list(verbs: Verbs) -> None:
    parser = verbs.add_parser(
        "list",
        help="what sites there are, with their routes",
        description="Show name, title, size, counts and routes of sites.",
        epilog="example: memorymaze sites list",
    )
    parser.add_argument(
        "--sites",
        metavar="DIR",
        type=given_path,
        help="a folder with plans (*.geojson); without it, the benchmark's own sites",
    )
    parser.set_defaults(run=_list)


def _add_new(verbs: Verbs) -> None:
    parser = verbs.add_parser(
        "new",
        help="write a small plan to begin with",
        description="Write a small plan that is right in every part: two corridors, a "
        "corner, a door, a bench and a route. Change it into your building; "
        "docs/buildings.md explains every member.",
        epilog="example: memorymaze sites new annex --out annex.geojson",
    )
    parser.add_argument("name", metavar="NAME", help="what instructions will call it")
    parser.add_argument(
        "--out",
        metavar="FILE",
        type=given_path,
        help="file to write (default: NAME.geojson)",
    )
    parser.set_defaults(run=_new)


def _add_generate(verbs: Verbs) -> None:
    parser = verbs.add_parser(
        "generate",
        help="make plans of buildings that no one built",
        description="Make plausible floors of large public buildings, with rooms, signs, "
        "things and routes, each as KIND_SEED.geojson (docs/buildings.md). The same "
        "kind and seed give the same file, byte for byte.",
        epilog="example: memorymaze sites generate --kind hospital --count 3 --out made",
        options=_add_generate_options,
    )
    parser.set_defaults(run=_generate)


def _add_generate_options(parser: argparse.ArgumentParser) -> None:
    from memorymaze.world.construction import BUILDING_KINDS

    parser.add_argument(
        "--kind",
        choices=(*BUILDING_KINDS, "all"),
        required=True,
        help="kind of building",
    )
    parser.add_argument(
        "--seed", type=int, default=0, metavar="N", help="the first seed (default: 0)"
    )
    parser.add_argument(
        "--count",
        type=int,
        default=1,
        metavar="K",
        help="buildings of each kind, with seeds N, N+1, … (default: 1)",
    )
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=given_path,
        required=True,
        help="folder to write into",
    )


def _add_check(verbs: Verbs) -> None:
    parser = verbs.add_parser(
        "check",
        help="find everything wrong with site plans",
        description=(
            "Print every problem as one line: file:feature:rule: severity: message. "
            "The rules are explained in docs/buildings.md. Exit code 0 when there is "
            "no error, 1 when there is one; warnings do not count."
        ),
        epilog="example: memorymaze sites check university",
    )
    parser.add_argument(
        "plans",
        metavar="FILE|NAME|DIR",
        nargs="+",
        help="a plan, a benchmark's site such as university, or a folder of plans",
    )
    parser.set_defaults(run=_check)


def _add_draw(verbs: Verbs) -> None:
    parser = verbs.add_parser(
        "draw",
        help="draw a site as PNG, SVG or PDF",
        description="Draw a site and print the name of the file written.",
        epilog="example: memorymaze sites draw university --route R1 --out r1.svg",
    )
    add_plan(parser)
    parser.add_argument(
        "--out",
        metavar="FILE",
        type=given_path,
        help="file to write: .png, .svg or .pdf (default: the site's name.png)",
    )
    parser.add_argument(
        "--route",
        metavar="ID",
        action="append",
        help="draw this route only, by id or by name such as R1; can be repeated",
    )
    parser.set_defaults(run=_draw)


def _new(args: argparse.Namespace) -> None:
    from memorymaze.basics.durable_files import write_new
    from memorymaze.world.sites.loading import new_plan

    plan = new_plan(args.name)
    out = args.out or Path(f"{args.name}.geojson")
    out.parent.mkdir(parents=True, exist_ok=True)
    write_new(out, plan)
    print(out)


def _generate(args: argparse.Namespace) -> None:
    from memorymaze.basics.durable_files import check_new_file
    from memorymaze.basics.errors import SettingsError
    from memorymaze.world.construction import BUILDING_KINDS, make_building

    if args.count < 1:
        raise SettingsError(f"--count: expected at least 1, got {args.count}")
    args.out.mkdir(parents=True, exist_ok=True)
    for kind in BUILDING_KINDS if args.kind == "all" else (args.kind,):
        for seed in range(args.seed, args.seed + args.count):
            building = make_building(kind, seed)
            path = args.out / f"{building.name}.geojson"
            check_new_file(path)
            building.save(path)
            print(path)


def _list(args: argparse.Namespace) -> None:
    from memorymaze.world.sites import load_sites

    sites = load_sites(args.sites)
    print("\n\n".join(_described(site) for site in sites.values()))


def _check(args: argparse.Namespace) -> int:
    from memorymaze.world.sites import find_site_problems

    paths = [path for plan in args.plans for path in _plans(plan)]
    problems = [problem for path in paths for problem in find_site_problems(path)]
    for problem in problems:
        print(problem.line())
    errors = sum(problem.severity == "error" for problem in problems)
    print(
        f"{counted(len(paths), 'plan')}: {counted(errors, 'error')}, "
        f"{counted(len(problems) - errors, 'warning')}",
        file=sys.stderr,
    )
    return FAILED if errors else DONE


def _draw(args: argparse.Namespace) -> None:
    from memorymaze.world.drawing.plan_picture import draw_site
    from memorymaze.world.sites import load_site

    site = load_site(args.site)
    out: Path = args.out or Path(f"{Path(site.source).stem}.png")
    draw_site(site, out, routes=args.route or True)
    print(out)


def _plans(plan: str) -> list[Path]:
    """Return the files that a file's, a site's or a folder's name stands for."""
    from memorymaze.world.sites import plan_file, plan_paths

    return plan_paths(Path(plan)) if plan and Path(plan).is_dir() else [plan_file(plan)]


def _described(site: "Site") -> str:
    west, south, east, north = site.walkable_floor.bounds
    counts = (
        (len(site.corridors), "corridor"),
        (len(site.areas), "area"),
        (len(site.turning_points), "turning point"),
        (len(site.rooms), "room"),
        (len(site.doors), "door"),
        (len(site.landmarks), "landmark"),
    )
    lines = [
        f"{site.name}: {site.title}",
        f"  {site.floor}, {east - west:.0f} x {north - south:.0f} m, "
        f"{site.walkable_floor.area:.0f} m2 of floor",
        "  " + ", ".join(counted(number, what) for number, what in counts),
    ]
    width = max((len(route.id) for route in site.routes), default=0)
    lines += [
        f"  {route.route}  {route.id:{width}}  {route.line.length:7.2f} m  "
        f"{counted(len(route.turns), 'turn')}, to {route.goal}"
        for route in site.routes
    ]
    return "\n".join(lines)
