"""A study at two addresses: one for participants, one for the experimenter."""

import secrets
from collections.abc import Generator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import NamedTuple

from memorymaze.studies.experimenter_pages import ExperimenterPages
from memorymaze.studies.follow_drives import Drives
from memorymaze.studies.follow_texts import texts_to_follow
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
    draws: bool = True,
) -> Generator[Addresses]:
    """Serve the pages of a study; the experimenter's on this machine only.

    Robots that people drive are drawn where there is somebody to look.
    """
    token = secrets.token_urlsafe(24)
    drives = None
    with ExitStack() as stack:
        if store.study.design.kind == "follow":
            texts = texts_to_follow(store.study)
            drives = stack.enter_context(Drives(store, texts, draws=draws))
        pages = make_app(ParticipantPages(store, films, drives).routes)
        behind = make_app(
            ExperimenterPages(store, token).routes, hosts=["127.0.0.1", "localhost"]
        )
        with serving(
            Door(pages, host, port, certificate),
            Door(behind, port=experimenter_port),
        ) as [participants, experimenter]:
            yield Addresses(participants, f"{experimenter}/enter/{token}")
