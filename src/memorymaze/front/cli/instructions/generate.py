"""`memorymaze instructions generate`: texts with and without known errors."""

import argparse
import sys
from typing import TYPE_CHECKING

from memorymaze.basics.wording import counted
from memorymaze.front.cli.flags import add_flags
from memorymaze.front.cli.verbs import Verbs, add_sites_option
from memorymaze.language.models.model_settings import ModelSettings

if TYPE_CHECKING:
    from memorymaze.language.models.model import LanguageModel


def add_parser(actions: Verbs) -> None:
    """Add the action to `memorymaze instructions`."""
    parser = actions.add_parser(
        "generate",
        help="make texts for any routes, with known errors or without",
        description="Make instructions for the routes of any site, with errors that "
        "are labelled to the word. They are written by a program or a language model, "
        "never by people, and say so.",
        epilog="example: memorymaze instructions generate --errors failure=1 --paired "
        "--out pairs.jsonl",
    )
    add_sites_option(parser)
    parser.add_argument("--site", metavar="NAME", help="only this site")
    parser.add_argument("--route", metavar="R", help="only this route, such as R1")
    parser.add_argument(
        "--study",
        choices=("online", "onsite"),
        help="only typed (online) or only spoken (onsite) texts",
    )
    parser.add_argument("--iteration", type=int, choices=(1, 2), help="only this one")
    parser.add_argument(
        "--per-cell",
        metavar="N",
        type=int,
        help="texts per route, study and iteration (default: 10)",
    )
    parser.add_argument(
        "--errors",
        metavar="RATES",
        help="published (default: the paper's Table I), none, or NAME=SHARE,… with kinds "
        "of errors, kinds of surface, or failure for any error",
    )
    parser.add_argument(
        "--paired",
        action="store_true",
        help="with every wrong text the same text without its errors",
    )
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="(default: 0)")
    parser.add_argument(
        "--from",
        dest="sources",
        metavar="FILE",
        nargs="+",
        help="put errors into the right texts of these files: by an edit where it is "
        "certain, else by telling their route anew (--errors: default failure=1)",
    )
    parser.add_argument(
        "--engine",
        metavar="ENGINE",
        default="grammar",
        help="grammar (default), or a language model as --model of `evaluate` names it",
    )
    add_flags(parser.add_argument, ModelSettings, ("base_url", "record", "replay"))
    parser.add_argument(
        "--out", metavar="FILE", required=True, help="instruction file to write (JSONL)"
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.basics.durable_files import check_no_input
    from memorymaze.texts.corpus.files import write_instructions
    from memorymaze.texts.writing import (
        GenerationRequest,
        make_instructions,
        parse_rates,
    )

    check_no_input(options.out, options.sources or ())
    default = "failure=1" if options.sources else "published"
    request = GenerationRequest(
        sites_folder=options.sites,
        site=options.site,
        route=options.route,
        study=options.study,
        iteration=options.iteration,
        per_cell=options.per_cell,
        rates=parse_rates(options.errors or default),
        paired=options.paired,
        seed=options.seed,
        instruction_files=tuple(options.sources or ()),
    )
    made = make_instructions(request, _model(options))
    for problem in made.problems:
        print(f"memorymaze: not written: {problem}", file=sys.stderr)
    if made.instructions:
        write_instructions(options.out, made.instructions)
    wrong = sum(bool(each.failures) for each in made.instructions)
    print(
        f"{options.out}: {counted(len(made.instructions), 'instruction')}, {wrong} with "
        "errors; written by a program or a model, not by people"
    )
    return 1 if made.problems else 0


def _model(options: argparse.Namespace) -> "LanguageModel | None":
    from memorymaze.basics.errors import SettingsError
    from memorymaze.language.models.building import build_language_model
    from memorymaze.language.models.model_settings import ModelSettings
    from memorymaze.texts.writing import GRAMMAR

    if options.engine == GRAMMAR:
        for name in ("base_url", "record", "replay"):
            if getattr(options, name) is not None:
                raise SettingsError(
                    f"--{name.replace('_', '-')}: the grammar asks no model; name one "
                    "with --engine, or leave the option out"
                )
        return None
    return build_language_model(
        ModelSettings(
            model=options.engine,
            base_url=options.base_url,
            record=options.record,
            replay=options.replay,
        )
    )
