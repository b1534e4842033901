"""`memorymaze score`: the eight path metrics of cases in a file.

A case has a graph, a reference path and an agent's path. Cases stand alone: what is
wrong with one is said in its line and does not touch the others.
"""

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from memorymaze.cli.verbs import Verbs
from memorymaze.errors import CaseFileError, UndefinedMetricError

if TYPE_CHECKING:
    from memorymaze.cli.case_records import Graphs

CASE_LISTS = ("cases", "undefined_cases")


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "score",
        help="compute SR, OSR, NE, SPL, CLS, nDTW, SDTW and path length of cases",
        description="Print one JSON line per case: its id and the eight metrics, or its "
        "id and the error that leaves them undefined. Exit code 0 when every case has "
        "its line, whether values or an error; 1 when the file cannot be read.",
        epilog="example: memorymaze score --cases cases.json",
    )
    parser.add_argument(
        "--cases",
        metavar="FILE",
        type=Path,
        required=True,
        help="JSON file with `graphs` and `cases`; see docs/metrics.md",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.cli.case_records import Graphs

    content = _read(options.cases)
    graphs = Graphs(content["graphs"])
    for place, case in _cases(content):
        print(json.dumps(_scored(place, case, graphs)), flush=True)
    return 0


def _read(path: Path) -> dict[str, Any]:
    """Return the content of a file of cases, checked as far as all cases need it."""
    try:
        content = json.loads(path.read_text(encoding="utf-8-sig"))
    except json.JSONDecodeError as error:
        raise CaseFileError(
            f"{path}:{error.lineno}:{error.colno}: expected JSON: {error.msg}"
        ) from None
    except UnicodeDecodeError as error:
        raise CaseFileError(
            f"{path}: expected UTF-8 text, got other bytes at byte {error.start}"
        ) from None
    except ValueError as error:
        # Python's limit on the digits of a whole number.
        raise CaseFileError(f"{path}: a number cannot be read: {error}") from None
    except RecursionError:
        raise CaseFileError(f"{path}: the JSON is nested too deeply") from None
    except OSError as error:
        raise CaseFileError(f"{path}: cannot be read: {error.strerror}") from None
    if not isinstance(content, dict):
        raise CaseFileError(
            f"{path}: expected a JSON object with `graphs` and `cases`, got "
            f"{_kind(content)}"
        )
    members = cast(dict[str, Any], content)
    for name, kind in (("graphs", dict), ("cases", list), ("undefined_cases", list)):
        if name not in members and name != "undefined_cases":
            raise CaseFileError(f"{path}: expected a member `{name}`, found none")
        if name in members and not isinstance(members[name], kind):
            raise CaseFileError(
                f"{path}: expected `{name}` to be {_kind(kind())}, got "
                f"{_kind(members[name])}"
            )
    if not any(members.get(name) for name in CASE_LISTS):
        raise CaseFileError(f"{path}: expected at least one case, found none")
    return members


def _cases(content: dict[str, Any]) -> Iterator[tuple[str, object]]:
    """Yield every case with the place where it stands in the file."""
    for name in CASE_LISTS:
        for index, case in enumerate(content.get(name, [])):
            yield f"{name}[{index}]", case


def _scored(place: str, case: object, graphs: "Graphs") -> dict[str, Any]:
    """Return what to print of a case."""
    from memorymaze.cli.case_records import read_case
    from memorymaze.metrics.score import score_path

    known = cast(dict[str, Any], case) if isinstance(case, dict) else {}
    line: dict[str, Any] = {"id": known.get("id")}
    try:
        record = read_case(place, case)
        values = score_path(
            graphs.graph(record.graph),
            record.reference_path,
            record.agent_path,
            record.threshold,
        )
    except (CaseFileError, UndefinedMetricError) as error:
        return line | {"error": str(error)}
    return line | values.as_dict()


def _kind(value: object) -> str:
    """Return what JSON calls a value, in words."""
    kinds = (
        (dict, "an object"),
        (list, "a list"),
        (str, "a text"),
        (bool, "a boolean"),
    )
    for kind, words in kinds:
        if isinstance(value, kind):
            return words
    return "null" if value is None else "a number"
