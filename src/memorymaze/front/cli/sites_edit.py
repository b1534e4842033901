"""`memorymaze sites edit`: a page to draw and edit a site plan."""

import argparse
from pathlib import Path

from memorymaze.front.cli.served_page import (
    add_port,
    check_can_serve,
    serve,
)
from memorymaze.front.cli.verbs import Verbs, given_path

PICTURES = (".png", ".jpg", ".jpeg", ".webp", ".svg")


def add_edit(verbs: Verbs) -> None:
    """Add the verb `edit` of `sites`."""
    verbs.add_parser(
        "edit",
        help="draw and edit a site plan in the browser",
        description="Serve a page on this machine in which a plan is drawn and edited, "
        "with its problems shown where they are (docs/buildings.md). A file that is not "
        "there begins empty, and is written when it is saved.",
        epilog="example: memorymaze sites edit annex.geojson",
        options=_add_options,
    )


def _add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "plan", metavar="FILE", type=given_path, help="a plan, there or not yet"
    )
    parser.add_argument(
        "--picture",
        metavar="FILE",
        type=given_path,
        help="picture of a floor plan to trace over (it stays on this machine)",
    )
    add_port(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    import secrets
    from hashlib import sha256

    from memorymaze.basics.errors import SettingsError

    check_can_serve("the page to edit plans")
    from memorymaze.web.editor.pages import EDITOR_ROOM, LARGEST_PLAN, EditorPages
    from memorymaze.web.editor.plan_file import PlanFile
    from memorymaze.web.serving.entrance import Entrance
    from memorymaze.web.serving.web import THIS_MACHINE, make_app

    picture: Path | None = options.picture
    if picture is not None and not (
        picture.is_file() and picture.suffix.lower() in PICTURES
    ):
        raise SettingsError(
            f"--picture {picture}: expected a file that ends in {', '.join(PICTURES)}, "
            f"got {'another one' if picture.is_file() else 'none: no such file'}"
        )
    file = PlanFile(options.plan)
    token = secrets.token_urlsafe(24)
    cookie = f"editor-{sha256(str(file.path).encode()).hexdigest()[:8]}"
    entrance = Entrance(token, cookie, "Open the address that the editor printed.")
    app = make_app(
        EditorPages(file, entrance, picture).routes,
        EDITOR_ROOM,
        max_body=LARGEST_PLAN,
        rate=None,
        hosts=THIS_MACHINE,
    )
    serve(app, f"edit {file.path.name}", f"/enter/{token}", port=options.port)
