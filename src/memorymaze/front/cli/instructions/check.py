"""`memorymaze instructions check`: everything that is wrong in instruction files."""

import argparse
import sys

from memorymaze.basics.wording import counted
from memorymaze.front.cli.verbs import Verbs, add_sites_option


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze instructions`."""
    parser = actions.add_parser(
        "check",
        help="list everything that is wrong in instruction files",
        description="List everything that is wrong: format, ids, sites and routes, "
        "instructions that are there twice, damaged encodings; exit code 1 where there "
        "is something. Lines marked as notes, such as equal texts, or labels that name "
        "no place of the plan, may be meant and change no exit code.",
        epilog="example: memorymaze instructions check "
        "src/memorymaze/texts/corpus/data/role_played.jsonl",
    )
    parser.add_argument("files", metavar="FILE", nargs="+", help="JSONL or CSV files")
    add_sites_option(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.texts.corpus.checking import check_instruction_files
    from memorymaze.world.sites import load_sites

    report = check_instruction_files(options.files, load_sites(options.sites))
    for problem in report.errors:
        print(problem)
    for note in report.notes:
        print(f"{note.place}: note: {note.message}")
    wrong = counted(len(report.errors), "problem") if report.errors else "no problems"
    notes = f", {counted(len(report.notes), 'note')}" if report.notes else ""
    print(
        f"{counted(report.good, 'good instruction')}, {wrong}{notes}", file=sys.stderr
    )
    return 1 if report.errors else 0
