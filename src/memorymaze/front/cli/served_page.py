"""What verbs share that serve a page: packages, the port, and serving until Ctrl-C."""

from argparse import ArgumentParser
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from starlette.types import ASGIApp


def check_can_serve(purpose: str) -> None:
    """Refuse to go on without the packages that pages need."""
    from memorymaze.basics.extras import require_extra

    require_extra(
        "studies",
        "starlette",
        "uvicorn",
        "python_multipart",
        "cryptography",
        purpose=purpose,
    )


def add_port(parser: ArgumentParser) -> None:
    """Add `--port`, of verbs that serve one page."""
    parser.add_argument(
        "--port", type=int, default=0, metavar="N", help="port (default: any free one)"
    )


def serve(
    app: "ASGIApp", said: str, page: str = "", *, host: str = "127.0.0.1", port: int
) -> None:
    """Serve a page until Ctrl-C, and say for what and where it is."""
    from memorymaze.web.serving.web import (
        ServedApplication,
        serving,
        wait_for_interrupt,
    )

    with serving(ServedApplication(app, host, port)) as [address]:
        print(f"{said} at {address}{page} (Ctrl-C to end)", flush=True)
        wait_for_interrupt()
