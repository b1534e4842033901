"""`memorymaze programs read`: from replies to a file of programs."""

import argparse
import sys

from memorymaze.cli.verbs import Verbs
from memorymaze.wording import counted


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze programs`."""
    parser = actions.add_parser(
        "read",
        help="make a file of programs from replies",
        description="Read the programs in the replies to `memorymaze prompts`, as the "
        "agent would have read them.",
        epilog="example: memorymaze programs read program_replies.jsonl --steps "
        "parse_replies.jsonl --out programs.jsonl",
    )
    parser.add_argument(
        "replies", metavar="REPLIES", nargs="+", help="to the requests for programs"
    )
    parser.add_argument(
        "--steps",
        metavar="FILE",
        nargs="+",
        help="replies to the requests for steps; wanted unless there was no parser",
    )
    parser.add_argument(
        "--model",
        metavar="NAME",
        help="how the model is called in tables (default: what the replies say)",
    )
    parser.add_argument("--out", metavar="FILE", required=True, help="file of programs")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.durable_files import write_new
    from memorymaze.evaluation.offline_inference import programs_from_replies
    from memorymaze.evaluation.program_files import program_lines
    from memorymaze.language.batch_files import read_replies

    found = programs_from_replies(
        read_replies(options.replies),
        None if options.steps is None else read_replies(options.steps),
        model=options.model,
    )
    write_new(options.out, program_lines(found.records))
    for reason in found.failed:
        print(f"memorymaze: no program: {reason}", file=sys.stderr)
    for identifier in found.missing:
        print(
            f"memorymaze: no record, a reply is missing: {identifier}", file=sys.stderr
        )
    programs = len(found.records) - len(found.failed)
    print(
        f"{counted(programs, 'program')}, {len(found.failed)} without one (model_error), "
        f"{len(found.missing)} missing; in {options.out}"
    )
    return 1 if found.missing else 0
