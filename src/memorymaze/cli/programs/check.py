"""`memorymaze programs check`: everything that is wrong in a file of programs."""

import argparse

from memorymaze.cli.verbs import Verbs
from memorymaze.wording import counted


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze programs`."""
    parser = actions.add_parser(
        "check",
        help="check a file of programs",
        description="Check that a file has one sound record per instruction, and each "
        "program as the sandbox does before it runs one. No program is run.",
        epilog="example: memorymaze programs check programs.jsonl",
    )
    parser.add_argument("file", metavar="FILE", help="JSONL")
    parser.add_argument(
        "--instructions",
        metavar="FILE",
        nargs="+",
        help="that each want a program (default: the shipped texts)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.evaluation.program_checking import check_programs
    from memorymaze.instructions.files import load_instructions

    checked = check_programs(options.file, load_instructions(options.instructions))
    for remark in checked.remarks:
        print(f"{remark.kind}: {remark.text}")
    print(
        f"{counted(checked.records, 'record')} for "
        f"{counted(checked.instructions, 'instruction')}"
        + (f", by {checked.agent}" if checked.agent else "")
    )
    print(
        f"{counted(checked.count('problem'), 'problem')}; of the programs "
        f"{checked.count('crash')} will crash and {checked.count('unsafe')} are unsafe "
        f"before their first line; {checked.count('model_error')} records without a "
        "program"
    )
    print("the file can be run" if checked.usable else "the file cannot be run so")
    return 0 if checked.usable else 1
