"""`memorymaze instructions label`: an annotator marks failures and alternative ways."""

import argparse
import sys
from pathlib import Path

from memorymaze.cli.verbs import Verbs, add_sites_option
from memorymaze.wording import counted


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze instructions`."""
    parser = actions.add_parser(
        "label",
        help="mark failures and alternative ways, in the terminal or a sheet",
        description="Ask which way each text describes and what is wrong in it, without "
        "showing the labels that the file has. Each answer is kept at once; the same "
        "command goes on where it was broken off. With --csv a sheet is written to be "
        "filled in; once it is there, it is read back (docs/labelling.md).",
        epilog="example: memorymaze instructions label mine.jsonl --annotator ada "
        "--out ada.jsonl",
    )
    parser.add_argument("file", metavar="FILE", help="instruction file (JSONL)")
    parser.add_argument("--annotator", metavar="NAME", required=True, help="who labels")
    parser.add_argument(
        "--out", metavar="LABELS", required=True, help="file that labels are added to"
    )
    parser.add_argument(
        "--csv", metavar="SHEET", help="sheet to write, or to read where it exists"
    )
    parser.add_argument(
        "--pictures", metavar="DIR", help="draw the plan with the ways into this folder"
    )
    add_sites_option(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.collection.labels import (
        append_labels,
        check_annotator,
        latest_labels,
        read_labels,
    )
    from memorymaze.collection.questions import questions
    from memorymaze.errors import SettingsError
    from memorymaze.instructions import load_corpus

    annotator = check_annotator(options.annotator)
    if options.csv is not None and options.pictures is not None:
        raise SettingsError(
            "--pictures: is for labelling in the terminal, without --csv"
        )
    corpus = load_corpus([options.file], sites=options.sites)
    told, sites = corpus.instructions, corpus.sites
    known = (
        read_labels([options.out], told, sites) if Path(options.out).exists() else []
    )
    done = {
        name: label
        for (who, name), label in latest_labels(known).items()
        if who == annotator
    }
    if options.csv is None:
        from memorymaze.collection.dialogue import ask_for_labels

        waiting = questions(told, sites, done)
        _say(
            f"{annotator}: {counted(len(done), 'text')} labelled, {len(waiting)} to go"
        )
        if waiting:
            ask_for_labels(
                waiting,
                annotator,
                options.out,
                ask=input,
                say=print,
                pictures=options.pictures,
            )
        return 0
    from memorymaze.collection.label_sheet import read_label_sheet, write_label_sheet

    if not Path(options.csv).exists():
        waiting = questions(told, sites, done)
        write_label_sheet(options.csv, waiting)
        _say(f"{counted(len(waiting), 'row')} to fill in; then the same command again")
        print(options.csv)
        return 0
    read = read_label_sheet(options.csv, questions(told, sites), annotator)
    new = [label for label in read if done.get(label.instruction) != label]
    append_labels(options.out, new)
    left = len(told) - len(done.keys() | {label.instruction for label in new})
    _say(f"{counted(len(new), 'label')} added, {counted(left, 'text')} to go")
    print(options.out)
    return 0


def _say(text: str) -> None:
    print(text, file=sys.stderr)
