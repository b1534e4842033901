"""`memorymaze instructions agreement`: how far annotators agree, and the consensus."""

import argparse
import sys

from memorymaze.basics.wording import counted
from memorymaze.front.cli.verbs import Verbs, add_sites_option, given_path


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze instructions`."""
    parser = actions.add_parser(
        "agreement",
        help="Cohen's or Fleiss' kappa of labels, and their consensus",
        description="Compare the labels of two annotators (Cohen's kappa) or more "
        "(Fleiss' kappa) on the texts that all of them labelled, with percent agreement "
        "and a 95 %% interval (bootstrap over participants), and list texts without a "
        "majority. With --out the consensus is merged into the instructions; what has "
        "no majority stays as it was.",
        epilog="example: memorymaze instructions agreement ada.jsonl bob.jsonl "
        "--out agreed.jsonl (files that `memorymaze instructions label` wrote)",
    )
    parser.add_argument("labels", metavar="LABELS", nargs="+", help="files of labels")
    parser.add_argument(
        "--instructions",
        metavar="FILE",
        type=given_path,
        help="what was labelled (default: the shipped texts)",
    )
    parser.add_argument(
        "--file-as",
        metavar="NAME",
        help="count the labels in the instruction file as those of one more annotator",
    )
    parser.add_argument(
        "--out", metavar="FILE", help="instruction file to write, with the consensus"
    )
    parser.add_argument(
        "--seed", type=int, default=0, help="of the intervals (default: 0)"
    )
    add_sites_option(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    import numpy as np

    from memorymaze.basics.errors import SettingsError
    from memorymaze.texts.corpus import episodes, load_corpus, write_instructions
    from memorymaze.texts.labels.agreement import (
        agreement,
        agreement_table,
        file_labels,
    )
    from memorymaze.texts.labels.consensus import consensus, merged
    from memorymaze.texts.labels.labels import (
        check_annotator,
        latest_labels,
        read_labels,
    )

    if options.seed < 0:
        raise SettingsError(f"--seed: expected 0 or more, got {options.seed}")
    corpus = load_corpus(options.instructions, sites=options.sites)
    told, sites = corpus.instructions, corpus.sites
    labels = latest_labels(read_labels(options.labels, told, sites))
    if options.file_as is not None:
        name = check_annotator(options.file_as)
        if any(who == name for who, _ in labels):
            raise SettingsError(
                f"--file-as: expected a name that no annotator has, got {name!r}"
            )
        labels = file_labels(told, name) | labels
    annotators = list(dict.fromkeys(who for who, _ in labels))
    found = agreement(labels, told, sites, np.random.default_rng(options.seed))
    print(agreement_table(found, annotators), end="")
    agreed = consensus(labels)
    undecided = [each for each in agreed if each.open]
    if undecided:
        print()
    for each in undecided:
        print(f"{each.instruction}: no consensus on {'; '.join(each.open)}")
    if options.out is not None:
        result = merged(told, agreed)
        episodes(result, sites)
        write_instructions(options.out, result)
        print(
            f"{options.out}: consensus on {len(agreed) - len(undecided)} of "
            f"{counted(len(told), 'text')}",
            file=sys.stderr,
        )
