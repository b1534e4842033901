"""`memorymaze score`: the eight path metrics of cases in a file."""

import argparse
import json

from memorymaze.front.cli.verbs import Verbs, given_path


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "score",
        help="compute SR, OSR, NE, SPL, CLS, nDTW, SDTW and path length of cases",
        description="Print one JSON line per case: its id and the eight metrics, or its "
        "id and the error that leaves them undefined. Exit code 0 when every case has "
        "its line, whether values or an error; 1 when the file cannot be read.",
        epilog="example: memorymaze score --cases "
        "tests/runs/metrics/data/cases_synthetic.json",
    )
    parser.add_argument(
        "--cases",
        metavar="FILE",
        type=given_path,
        required=True,
        help="JSON file with `graphs` and `cases`; see docs/metrics.md",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.runs.metrics.case_files import score_cases

    for line in score_cases(options.cases):
        print(json.dumps(line), flush=True)
