"""A study at its addresses: one for participants, one for the experimenter."""

import secrets
from collections.abc import Generator
from contextlib import ExitStack, contextmanager
from typing import NamedTuple

from memorymaze.web.serving.web import (
    THIS_MACHINE,
    Certificate,
    ServedApplication,
    make_app,
    serving,
)
from memorymaze.web.studies.experimenter_pages import ExperimenterPages
from memorymaze.web.studies.films import Films
from memorymaze.web.studies.follow.drives import Drives
from memorymaze.web.studies.follow.texts import texts_to_follow
from memorymaze.web.studies.interviews.pages import InterviewPages
from memorymaze.web.studies.interviews.recognising import Recogniser
from memorymaze.web.studies.interviews.transcript_pages import TranscriptPages
from memorymaze.web.studies.labels.pages import LabelPages
from memorymaze.web.studies.participant_pages import ParticipantPages
from memorymaze.web.studies.store import Store
from memorymaze.web.studies.tellings import StudyTellings

ROOMS = (
    "memorymaze.web.studies",
    "memorymaze.web.studies.follow",
    "memorymaze.web.studies.interviews",
    "memorymaze.web.studies.labels",
)
MAX_RECORDING = 32_000_000
"""Bytes of a recording; an hour and more."""


class Addresses(NamedTuple):
    """Where a study is served."""

    participants: str
    """Empty for the kind `onsite`, whose participants have no pages of their own."""
    experimenter: str
    """With its secret; for nobody else."""


@contextmanager
def serving_study(
    store: Store,
    films: Films | None = None,
    *,
    host: str = "127.0.0.1",
    port: int = 0,
    experimenter_port: int = 0,
    certificate: Certificate | None = None,
    draws: bool = True,
) -> Generator[Addresses]:
    """Serve the pages of a study; the experimenter's on this machine only.

    Those of the kind `onsite` are all the experimenter's, and their tablet comes to
    `host`. Videos that are missing are made meanwhile; robots that people drive are drawn
    where there is somebody to look.
    """
    token = secrets.token_urlsafe(24)
    drives = None
    with ExitStack() as stack:
        experimenter = ExperimenterPages(store, token, films)
        tellings = StudyTellings(store)
        behind = [
            *experimenter.routes,
            *TranscriptPages(experimenter, tellings).routes,
            *LabelPages(experimenter, store, tellings).routes,
        ]
        if store.study.design.kind == "onsite":
            recogniser = Recogniser(store, tellings)
            stack.enter_context(recogniser.hearing())
            behind += InterviewPages(
                experimenter, store, tellings, recogniser, certificate
            ).routes
            app = make_app(
                behind, *ROOMS, max_body=MAX_RECORDING, hosts=[*THIS_MACHINE, host]
            )
            with serving(
                ServedApplication(app, host, experimenter_port, certificate)
            ) as [address]:
                yield Addresses("", f"{address}/enter/{token}")
            return
        if store.study.design.kind == "follow":
            texts = texts_to_follow(store.study)
            drives = stack.enter_context(Drives(store, texts, draws=draws))
        pages = make_app(ParticipantPages(store, films, drives).routes, *ROOMS)
        with (
            serving(
                ServedApplication(pages, host, port, certificate),
                ServedApplication(
                    make_app(behind, *ROOMS, hosts=THIS_MACHINE), port=experimenter_port
                ),
            ) as [participants, experimenter],
            ExitStack() as first,
        ):
            if drives is not None:
                # Else the server would wait for those who wait for a robot.
                first.push(drives)
            if films is not None:
                stack.enter_context(films.being_made())
            yield Addresses(participants, f"{experimenter}/enter/{token}")
