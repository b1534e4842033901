"""A study at two addresses: one for participants, one for the experimenter."""

import secrets
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from memorymaze.studies.experimenter_pages import ExperimenterPages
from memorymaze.studies.participant_pages import ParticipantPages
from memorymaze.studies.store import Store
from memorymaze.studies.web import Certificate, Door, make_app, serving


class Addresses(NamedTuple):
    """Where a study is served."""

    participants: str
    experimenter: str
    """With its secret; for nobody else."""


@contextmanager
def serving_study(
    store: Store,
    films: dict[str, Path],
    *,
    host: str = "127.0.0.1",
    port: int = 0,
    experimenter_port: int = 0,
    certificate: Certificate | None = None,
) -> Generator[Addresses]:
    """Serve the pages of a study; the experimenter's on this machine only."""
    token = secrets.token_urlsafe(24)
    pages = make_app(ParticipantPages(store, films).routes)
    behind = make_app(
        ExperimenterPages(store, token).routes, hosts=["127.0.0.1", "localhost"]
    )
    with serving(
        Door(pages, host, port, certificate),
        Door(behind, port=experimenter_port),
    ) as [participants, experimenter]:
        yield Addresses(participants, f"{experimenter}/enter/{token}")
