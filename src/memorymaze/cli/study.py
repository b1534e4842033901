"""`memorymaze study`: begin, serve, export and try studies with people."""

import argparse

from memorymaze.cli.verbs import VerbParser, Verbs

KINDS = ("online", "memory", "onsite", "follow")


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "study",
        help="run a study with people in a browser, and make a corpus of it",
        description="Run a study with people, who describe ways of any building in a "
        "browser, and make instruction files of what they say (docs/studies.md).",
        epilog="example: memorymaze study new my_study.toml --site university",
    )
    actions = parser.add_subparsers(
        title="actions", metavar="ACTION", required=True, parser_class=VerbParser
    )
    _add_new(actions)


def _add_new(actions: Verbs) -> None:
    parser = actions.add_parser(
        "new",
        help="write a study file with comments, to be changed",
        description="Write a study file with comments: routes, texts, consent, "
        "questions, quotas. Change it into your study.",
        epilog="example: memorymaze study new my_study.toml --site university "
        "--kind memory",
    )
    parser.add_argument("file", metavar="FILE", help="study file to write (TOML)")
    parser.add_argument(
        "--site", metavar="SITE", required=True, help="a shipped site, or a plan file"
    )
    parser.add_argument(
        "--kind",
        choices=KINDS,
        default="online",
        help="what people do (default: online)",
    )
    parser.set_defaults(run=_new)


def _new(options: argparse.Namespace) -> int:
    from memorymaze.sites import load_site
    from memorymaze.studies.study_file import new_study

    new_study(options.file, load_site(options.site), options.kind, options.site)
    print(
        f"{options.file}: a study to be changed; then type: "
        f"memorymaze study serve {options.file}"
    )
    return 0
