"""`memorymaze instructions export|import`: to and from other formats."""

import argparse

from memorymaze.basics.wording import counted
from memorymaze.front.cli.verbs import Verbs, add_files, add_sites_option, given_path

FORMATS = {
    "r2r": "Room-to-Room: R2R_SPLIT.json with the navigation graphs beside it",
    "vln_ce": "VLN-CE: SPLIT.json.gz and its ground truth",
    "csv": "one row per instruction",
    "parquet": "the same; needs the extra [tables]",
}
HUB = "the shipped texts as a folder for dataset hubs, with a card; needs the extra [tables]"


def add_parser(actions: Verbs) -> None:
    """Add both actions to `memorymaze instructions`."""
    formats = "; ".join(f"{name}: {what}" for name, what in FORMATS.items())
    outward = actions.add_parser(
        "export",
        help="write instructions as R2R, VLN-CE, CSV or Parquet",
        description=f"Write instructions in another format. {formats}; hub: {HUB}.",
        epilog="example: memorymaze instructions export --format vln_ce --out vln_ce",
    )
    add_files(outward)
    outward.add_argument(
        "--out",
        metavar="PATH",
        type=given_path,
        required=True,
        help="folder; a file for csv and parquet",
    )
    outward.set_defaults(run=_export)
    inward = actions.add_parser(
        "import",
        help="make an instruction file from R2R, VLN-CE, CSV or Parquet",
        description="Make an instruction file from files in another format. Scenes must "
        f"be sites, and paths routes of their plans. {formats}.",
        epilog="example: memorymaze instructions import vln_ce/test/test.json.gz "
        "--format vln_ce --out mine.jsonl (what `memorymaze instructions export` made)",
    )
    inward.add_argument("files", metavar="FILE", nargs="+", help="files in the format")
    inward.add_argument(
        "--out", metavar="FILE", required=True, help="instruction file to write (JSONL)"
    )
    inward.add_argument(
        "--study",
        choices=("online", "onsite"),
        help="how the texts came to be; for R2R and VLN-CE files made elsewhere",
    )
    inward.add_argument(
        "--source",
        choices=("human", "llm", "synthetic"),
        help="who wrote the texts; for R2R and VLN-CE files made elsewhere",
    )
    inward.set_defaults(run=_import)
    for action, choices in ((outward, [*FORMATS, "hub"]), (inward, FORMATS)):
        action.add_argument("--format", choices=choices, required=True)
        add_sites_option(action)


def _export(options: argparse.Namespace) -> None:
    from memorymaze.basics.durable_files import check_no_input
    from memorymaze.basics.errors import SettingsError
    from memorymaze.texts.corpus import load_corpus
    from memorymaze.texts.corpus.spreadsheets import write_spreadsheet
    from memorymaze.texts.exchange import (
        write_hub_folder,
        write_r2r,
        write_vln_ce,
    )

    if options.format == "hub" and (options.files or options.sites):
        raise SettingsError(
            "--format hub: expected neither files nor --sites, since its card tells how "
            "the shipped texts came to be; write yours with --format parquet, and a card "
            "of your own"
        )
    check_no_input(options.out, options.files)
    corpus = load_corpus(options.files or None, sites=options.sites)
    read, sites = corpus.instructions, corpus.sites
    if options.format == "hub":
        written = write_hub_folder(options.out)
    elif options.format in {"csv", "parquet"}:
        written = [options.out]
        write_spreadsheet(options.out, read, options.format)
    else:
        write = write_r2r if options.format == "r2r" else write_vln_ce
        written = write(options.out, read, sites)
    for path in written:
        print(path)


def _import(options: argparse.Namespace) -> None:
    from memorymaze.basics.durable_files import check_no_input
    from memorymaze.basics.errors import SettingsError
    from memorymaze.texts.corpus import episodes, write_instructions
    from memorymaze.texts.corpus.spreadsheets import read_spreadsheet
    from memorymaze.texts.exchange import Unlabelled, read_r2r, read_vln_ce
    from memorymaze.world.sites import load_sites

    check_no_input(options.out, options.files)
    sites = load_sites(options.sites)
    if (options.study is None) != (options.source is None):
        raise SettingsError("--study and --source: expected both or neither, got one")
    labels = options.study and Unlabelled(options.study, options.source)
    if options.format in {"csv", "parquet"}:
        if labels:
            raise SettingsError(
                f"--study and --source: expected with --format r2r or vln_ce, got "
                f"--format {options.format}, whose columns study and source say so; "
                "leave them out"
            )
        read = [
            each
            for file in options.files
            for each in read_spreadsheet(file, options.format)
        ]
    else:
        reader = read_r2r if options.format == "r2r" else read_vln_ce
        read = reader(options.files, sites, labels)
    read = [each.instruction for each in episodes(read, sites)]
    write_instructions(options.out, read)
    print(f"{options.out}: {counted(len(read), 'instruction')}")
