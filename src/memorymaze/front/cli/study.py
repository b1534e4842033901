"""`memorymaze study`: begin, serve and export studies with people, and remove participants."""

import argparse
from typing import TYPE_CHECKING

from memorymaze.basics.wording import counted
from memorymaze.front.cli.served_page import check_can_serve
from memorymaze.front.cli.verbs import Verbs, given_path

if TYPE_CHECKING:
    from memorymaze.web.serving.web import Certificate
    from memorymaze.web.studies.serving import Addresses
    from memorymaze.web.studies.study_file import Study


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "study",
        help="run a study with people in a browser, and make a corpus of it",
        description="Run a study with people, who describe ways of any building in a "
        "browser, and make instruction files of what they say (docs/studies.md).",
        epilog="example: memorymaze study new my_study.toml --site university",
    )
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    _add_new(actions)
    _add_serve(actions)
    _add_export(actions)
    _add_withdraw(actions)


def _add_new(actions: Verbs) -> None:
    parser = actions.add_parser(
        "new",
        help="write a study file with comments, to be changed",
        description="Write a study file with comments: routes, texts, consent, "
        "questions, quotas. Change it into your study.",
        epilog="example: memorymaze study new my_study.toml --site university "
        "--kind memory",
        options=_add_new_options,
    )
    parser.set_defaults(run=_new)


def _add_new_options(parser: argparse.ArgumentParser) -> None:
    from memorymaze.web.studies.study_file import STUDY_KINDS

    parser.add_argument("file", metavar="FILE", help="study file to write (TOML)")
    parser.add_argument(
        "--site", metavar="SITE", required=True, help="a shipped site, or a plan file"
    )
    parser.add_argument(
        "--kind",
        choices=STUDY_KINDS,
        default="online",
        help="what people do (default: online)",
    )


def _new(options: argparse.Namespace) -> None:
    from memorymaze.web.studies.study_file import new_study
    from memorymaze.world.sites import load_site

    new_study(options.file, load_site(options.site), options.kind, options.site)
    print(
        f"{options.file}: a study to be changed; then type: "
        f"memorymaze study serve {options.file}"
    )


def _add_serve(actions: Verbs) -> None:
    parser = actions.add_parser(
        "serve",
        help="show the pages of a study, until Ctrl-C",
        description="Show the pages of a study: to participants at one address, to the "
        "experimenter at another. On this machine only, unless --host says otherwise. "
        "Videos that are missing are made meanwhile. Of the kind onsite, the experimenter's "
        "tablet comes to --host; it records over https only (--tls).",
        epilog="example: memorymaze study serve my_study.toml (that `memorymaze study new` "
        "made)",
    )
    _add_file(parser)
    parser.add_argument(
        "--host",
        default="127.0.0.1",
        help="the address participants come to; 0.0.0.0 for all of this machine's "
        "(default: 127.0.0.1, this machine only)",
    )
    parser.add_argument(
        "--port", type=int, default=8000, metavar="N", help="of participants (8000)"
    )
    parser.add_argument(
        "--experimenter-port",
        type=int,
        default=8001,
        metavar="N",
        help="of the experimenter, on this machine only but for the kind onsite (8001)",
    )
    parser.add_argument(
        "--tls",
        action="store_true",
        help="serve https, with a certificate made for --host and kept beside the study",
    )
    parser.set_defaults(run=_serve)


def _serve(options: argparse.Namespace) -> None:
    check_can_serve("study serve")
    from memorymaze.web.serving.web import THIS_MACHINE, wait_for_interrupt
    from memorymaze.web.studies.films import Films
    from memorymaze.web.studies.serving import serving_study
    from memorymaze.web.studies.store import open_store
    from memorymaze.web.studies.study_file import check_is_changed, load_study

    study = load_study(options.file)
    if options.host not in THIS_MACHINE:
        check_is_changed(study)
    certificate = None
    if options.tls:
        from memorymaze.web.serving.certificates import local_certificate

        certificate = local_certificate(study.path.with_suffix(".tls"), options.host)
    with open_store(study) as store:
        watched = study.design.kind in {"online", "memory"}
        films = Films(study) if watched else None
        with serving_study(
            store,
            films,
            host=options.host,
            port=options.port,
            experimenter_port=options.experimenter_port,
            certificate=certificate,
        ) as addresses:
            if addresses.participants:
                print(f"participants:  {addresses.participants}/")
            print(f"experimenter:  {addresses.experimenter}")
            if certificate is not None:
                _explain_trust(addresses, certificate)
            elif study.design.kind == "onsite" and options.host not in THIS_MACHINE:
                print("nothing is recorded over http; end this and add --tls")
            print("Ctrl-C ends the server; what was sent is kept.", flush=True)
            wait_for_interrupt()


def _explain_trust(addresses: "Addresses", certificate: "Certificate") -> None:
    """Say how browsers come to trust a certificate that no company vouches for."""
    from memorymaze.web.serving.certificates import authority_of, fingerprint

    authority = authority_of(certificate)
    print(f"certificate:   browsers trust it after {authority} is installed on them,")
    if not addresses.participants:
        server = addresses.experimenter.partition("/enter/")[0]
        print(f"               as {server}/trust explains,")
    print(f"               SHA-256 {fingerprint(authority)}")


def _add_export(actions: Verbs) -> None:
    parser = actions.add_parser(
        "export",
        help="write what people told as an instruction file and a table, or how they "
        "followed as a run",
        description="Write the descriptions of all who finished as an instruction file, "
        "which every other verb reads, and beside it a CSV file with times, re-watches "
        "and checks; of the kind follow, the walks as a run folder of the agent people. "
        "Works while the pages are served.",
        epilog="example: memorymaze study export my_study.toml --out my_texts.jsonl",
    )
    _add_file(parser)
    parser.add_argument(
        "--out",
        metavar="PATH",
        type=given_path,
        required=True,
        help="instruction file to write (*.jsonl); the CSV file has its name. Of the "
        "kind follow, run folder to make",
    )
    parser.set_defaults(run=_export)


def _export(options: argparse.Namespace) -> None:
    from memorymaze.texts.corpus.records import WRITTEN_BY
    from memorymaze.web.studies.exporting import export_study
    from memorymaze.web.studies.store import open_store
    from memorymaze.web.studies.study_file import load_study

    study = load_study(options.file)
    if study.design.kind == "follow":
        _write_walks(study, options)
        return
    with open_store(study, alone=False) as store:
        done = export_study(study, store, options.out)
    print(
        f"{options.out}: {counted(done.instructions, 'instruction')} of "
        f"{counted(done.participants, 'participant')}, written by {WRITTEN_BY['human']}; "
        f"with what was measured: {done.table}"
    )
    if done.settled:
        print(f"ways and errors are settled of {counted(done.settled, 'instruction')}")
    if done.unwritten:
        print(
            f"{counted(done.unwritten, 'participant')} left out, with recordings that are "
            "not written down (the experimenter's page Texts)"
        )
    if done.lacking:
        print(
            f"{counted(len(done.lacking), 'participant')} left out, of whom a description "
            f"never came: {', '.join(done.lacking)} (the tablet says what was refused, and "
            "why)"
        )


def _write_walks(study: "Study", options: argparse.Namespace) -> None:
    """Write the walks of people as runs."""
    from memorymaze.web.studies.follow.runs import export_walks
    from memorymaze.web.studies.store import open_store

    with open_store(study, alone=False) as store:
        done = export_walks(study, store, options.out)
    print(
        f"{counted(done.walks, 'walk')} of {counted(done.participants, 'participant')}"
    )
    if done.elsewhere:
        print(
            f"{counted(len(done.elsewhere), 'walk')} left out, which end elsewhere than "
            f"their drivers saw: {', '.join(done.elsewhere)} (the robot was still on its "
            "way, or the plan or memorymaze are others now)"
        )
    if done.never_followed:
        print(f"{counted(done.never_followed, 'text')} nobody has followed yet")
    for folder in done.folders:
        print(f"see them beside a run of agents: memorymaze table {folder} RUN")


def _add_withdraw(actions: Verbs) -> None:
    parser = actions.add_parser(
        "withdraw",
        help="remove everything of a participant",
        description="Remove everything of a participant: rows, recordings, log and free "
        "pages of the file. While the pages are served, use the experimenter's.",
        epilog="example: memorymaze study withdraw my_study.toml p0123456789",
    )
    _add_file(parser)
    parser.add_argument(
        "participant",
        metavar="ID",
        help="the number of the participant, or platform id",
    )
    parser.set_defaults(run=_withdraw)


def _withdraw(options: argparse.Namespace) -> None:
    from memorymaze.web.studies.store import open_store
    from memorymaze.web.studies.study_file import load_study

    study = load_study(options.file)
    with open_store(study) as store:
        found = store.find(options.participant)
        done = store.withdraw(options.participant if found is None else found.id)
    print(f"{study.data_folder()}: nothing of them is left")
    for path in done.exports:
        print(f"make this export anew, it still holds the texts: {path}")


def _add_file(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help="study file (TOML)")
