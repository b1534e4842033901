"""`memorymaze dataset`: make a dataset of made buildings with made texts."""

import argparse
from typing import TYPE_CHECKING

from memorymaze.front.cli.replay import picture_size
from memorymaze.front.cli.verbs import Verbs, add_new_folder, shown_progress

if TYPE_CHECKING:
    from memorymaze.texts.datasets import DatasetRequest


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "dataset",
        help="make a dataset of made buildings with made texts",
        description="Make datasets to train on and to test with (docs/texts.md).",
        epilog="example: memorymaze dataset make --buildings 100 --out made",
    )
    parts = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    _add_make(parts)


def _add_make(verbs: Verbs) -> None:
    parser = verbs.add_parser(
        "make",
        help="make buildings, texts, splits and, if wanted, frames",
        description="Make buildings of all kinds and texts for their routes, split into "
        "train, val_seen, val_unseen and test as in R2R. The texts are written by a "
        "program, never by people, and say so.",
        epilog="example: memorymaze dataset make --buildings 100 --per-route 8 --out made",
    )
    parser.add_argument(
        "--buildings", metavar="N", type=int, default=100, help="(default: 100)"
    )
    parser.add_argument(
        "--per-route",
        metavar="N",
        type=int,
        default=8,
        help="texts per route (default: 8)",
    )
    parser.add_argument(
        "--errors",
        metavar="RATES",
        default="published",
        help="published (default: the means of the paper's Table I), none, or "
        "NAME=SHARE,… as for `instructions generate`",
    )
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="(default: 0)")
    parser.add_argument(
        "--frames",
        action="store_true",
        help="also pictures, depth and actions of perfect walks, in LeRobot's layout; "
        "needs the extras [tables] and [video]",
    )
    parser.add_argument(
        "--frame-size",
        metavar="WxH",
        type=picture_size,
        help="pixels (default: 640x480)",
    )
    parser.add_argument(
        "--workers",
        metavar="N",
        type=int,
        default=0,
        help="processes (default: one per core)",
    )
    add_new_folder(parser, "dataset")
    parser.set_defaults(run=_make)


def _make(options: argparse.Namespace) -> None:
    from memorymaze.basics.options import check_whole
    from memorymaze.texts.datasets import check_dataset_folder, make_dataset

    request = _request(options)
    check_whole("--workers", options.workers, least=0)
    check_dataset_folder(options.out, overwrite=options.overwrite)
    with shown_progress("building") as show:
        table = make_dataset(
            request,
            options.out,
            overwrite=options.overwrite,
            workers=options.workers,
            progress=show,
        )
    print(table)
    print(f"{options.out}/README.md")


def _request(options: argparse.Namespace) -> "DatasetRequest":
    from memorymaze.basics.errors import SettingsError
    from memorymaze.texts.datasets import DatasetRequest

    if options.frame_size is not None and not options.frames:
        raise SettingsError("--frame-size: there are no frames without --frames")
    size = (options.frame_size or (640, 480)) if options.frames else None
    return DatasetRequest(
        buildings=options.buildings,
        per_route=options.per_route,
        errors=options.errors,
        seed=options.seed,
        frame_size=size,
    )
