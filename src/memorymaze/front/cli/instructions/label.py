"""`memorymaze instructions label`: an annotator marks failures and alternative ways."""

import argparse
import sys
from pathlib import Path

from memorymaze.basics.wording import counted
from memorymaze.front.cli.verbs import Verbs, add_sites_option


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze instructions`."""
    parser = actions.add_parser(
        "label",
        help="mark failures and alternative ways in a sheet",
        description="Write a sheet that asks which way each text describes and what is "
        "wrong in it, without showing the labels that the file has. Once the sheet is "
        "there, the same command reads back what is filled in (docs/studies.md).",
        epilog="example: memorymaze instructions label "
        "src/memorymaze/texts/corpus/data/role_played.jsonl --annotator ada "
        "--csv ada.csv --out ada.jsonl",
    )
    parser.add_argument("file", metavar="FILE", help="instruction file (JSONL)")
    parser.add_argument("--annotator", metavar="NAME", required=True, help="who labels")
    parser.add_argument(
        "--out", metavar="LABELS", required=True, help="file that labels are added to"
    )
    parser.add_argument(
        "--csv",
        metavar="SHEET",
        required=True,
        help="sheet to write, or to read where it exists",
    )
    add_sites_option(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.texts.corpus import load_corpus
    from memorymaze.texts.labels.label_sheet import read_label_sheet, write_label_sheet
    from memorymaze.texts.labels.labels import (
        append_labels,
        check_annotator,
        latest_labels,
        read_labels,
    )
    from memorymaze.texts.labels.questions import questions

    annotator = check_annotator(options.annotator)
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
    if not Path(options.csv).exists():
        waiting = questions(told, sites, done)
        write_label_sheet(options.csv, waiting)
        _say(f"{counted(len(waiting), 'row')} to fill in; then the same command again")
        print(options.csv)
        return
    read = read_label_sheet(options.csv, questions(told, sites), annotator)
    new = [label for label in read if done.get(label.instruction) != label]
    append_labels(options.out, new)
    left = len(told) - len(done.keys() | {label.instruction for label in new})
    _say(f"{counted(len(new), 'label')} added, {counted(left, 'text')} to go")
    print(options.out)


def _say(text: str) -> None:
    print(text, file=sys.stderr)
