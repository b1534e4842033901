"""`memorymaze instructions stats`: Table I and more about instruction files."""

import argparse
from pathlib import Path

from memorymaze.front.cli.verbs import Verbs, add_files, add_sites_option


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze instructions`."""
    parser = actions.add_parser(
        "stats",
        help="Table I, words, marks of speech, things and distances",
        description="Describe instruction files: the paper's Table I beside the "
        "published figures, distinct words, hedges, fillers and corrections, things "
        "named, and how far stated distances are from true ones (docs/runs.md).",
        epilog="example: memorymaze instructions stats --format html --out stats.html",
    )
    add_files(parser)
    parser.add_argument(
        "--format",
        choices=("text", "csv", "html"),
        default="text",
        help="text; csv with one number per row; html, a page with plots and word "
        "clouds in one file (needs the extra 'analysis') (default: text)",
    )
    parser.add_argument("--out", metavar="FILE", help="file to write (default: stdout)")
    parser.add_argument(
        "--seed",
        type=int,
        default=0,
        help="of type-token curves and word clouds (default: 0)",
    )
    add_sites_option(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.basics.durable_files import check_no_input
    from memorymaze.basics.errors import SettingsError
    from memorymaze.texts.corpus import load_corpus
    from memorymaze.texts.corpus.record_format import write_file
    from memorymaze.texts.statistics import write_study

    if options.seed < 0:
        raise SettingsError(f"--seed: expected 0 or more, got {options.seed}")
    if options.format == "html" and options.out is None:
        raise SettingsError("--format html: expected --out FILE, got none")
    if options.out is not None and Path(options.out).is_dir():
        raise SettingsError(f"--out {options.out}: expected a file, got a folder")
    if options.out is not None:
        check_no_input(options.out, options.files)
    corpus = load_corpus(options.files or None, sites=options.sites)
    text = write_study(
        corpus.instructions, corpus.sites, options.format, seed=options.seed
    )
    if options.out is None:
        print(text, end="")
    else:
        write_file(options.out, text.encode())
        print(options.out)
