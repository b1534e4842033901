"""What an experimenter's tablet shows and sends: interviews, also without a network.

The page of interviews is one document, kept by the tablet's browser; its script walks
through it, keeps everything on the tablet and sends it when it can. Each thing it sends is
judged here.
"""

from pathlib import Path
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import BaseRoute, Route

from memorymaze.basics.errors import StudyError
from memorymaze.web.serving.certificates import authority_of, fingerprint
from memorymaze.web.serving.web import THIS_MACHINE, Certificate, Fields, render
from memorymaze.web.studies.experimenter_pages import ExperimenterPages
from memorymaze.web.studies.interviews.recognising import Recogniser
from memorymaze.web.studies.interviews.records import (
    MEDIA_TYPES,
    VOICE,
    InterviewRecord,
    Interviews,
    Receipt,
)
from memorymaze.web.studies.labels.marking import plan_view, read_marks
from memorymaze.web.studies.participant_pages import LONGEST_TEXT
from memorymaze.web.studies.schedule import TELLINGS, StudyStep, route_orders
from memorymaze.web.studies.store import Store
from memorymaze.web.studies.study_file import StudyDesign
from memorymaze.web.studies.tellings import StudyTellings

WORKER = Path(__file__).parent / "static" / "service-worker.js"
NEEDS_HTTPS = (
    "Browsers give the microphone to pages over https only, and so that nobody in the "
    "network listens, recordings are not taken over http. Start the server with --tls and "
    "open the https address that it prints; until then, type what is said."
)
CODES: dict[Receipt, int] = {"kept": 200, "known": 200, "taken": 409, "gone": 410}
REFUSALS: dict[Receipt, str] = {
    "taken": "Another answer to this is kept already.",
    "gone": "Nobody of this number takes part any more.",
}
ROUTE_STEPS = ("tell", "mark", "told", "retell")


class InterviewPages:
    """The pages for a tablet."""

    def __init__(
        self,
        experimenter: ExperimenterPages,
        store: Store,
        tellings: StudyTellings,
        recogniser: Recogniser,
        certificate: Certificate | None,
    ) -> None:
        """Take who guards the pages, the answers, what hears recordings, and https."""
        self._experimenter = experimenter
        self._interviews = Interviews(store)
        self._tellings = tellings
        self._recogniser = recogniser
        self._authority = None if certificate is None else authority_of(certificate)
        self._store = store
        self._study = store.study

    @property
    def routes(self) -> list[BaseRoute]:
        """Where the pages are."""
        guarded = self._experimenter.guarded
        return [
            Route("/interview", guarded(self._interview)),
            Route("/service-worker.js", self._worker),
            Route("/offline", self._offline),
            # Without the token: nobody has it before they trust the server.
            Route("/trust", self._trust),
            Route("/trust/authority.crt", self._trusted),
            Route(
                "/interviews/{participant}/records/{record}",
                guarded(self._take),
                methods=["POST"],
            ),
            Route(
                "/interviews/{participant}/recordings/{record}",
                self._take_recording,
                methods=["POST"],
            ),
            Route("/interviews/{participant}/transcripts/{step}", guarded(self._heard)),
            Route("/recordings/{file}", guarded(self._recording)),
        ]

    # What a tablet keeps ---------------------------------------------------------------

    def _interview(self, request: Request, fields: Fields) -> Response:
        design, site = self._study.design, self._study.site
        ways = {
            each.route: {
                "start": each.start,
                "goal": self._study.route(each.route).goal,
                "plan": plan_view(site, each.route),
            }
            for each in design.routes
        }
        orders = list(zip(self._store.progress(), route_orders(design), strict=True))
        return self._experimenter.show(
            request,
            "interview.html",
            ways=ways,
            orders=orders,
            study=self._store.folder.name,
            may_record=_is_safe(request),
            needs_https=NEEDS_HTTPS,
            longest=LONGEST_TEXT,
            is_heard=self._recogniser.is_there,
        )

    def _worker(self, request: Request) -> Response:
        # Not under /static/: a worker rules over pages beneath its own address only.
        return FileResponse(WORKER, media_type="text/javascript")

    def _offline(self, request: Request) -> Response:
        return render(request, "offline.html")

    def _trust(self, request: Request) -> Response:
        shown = "" if self._authority is None else fingerprint(self._authority)
        return render(request, "trust.html", fingerprint=shown)

    def _trusted(self, request: Request) -> Response:
        if self._authority is None:
            raise HTTPException(404)
        return FileResponse(self._authority, media_type="application/x-x509-ca-cert")

    # What a tablet sends ---------------------------------------------------------------

    def _take(self, request: Request, fields: Fields) -> Response:
        try:
            record = _record(request, fields)
            if record.step not in interview_steps(self._study.design):
                raise ValueError(f"There is no step {record.step!r} in this study.")
            if any(len(text) > LONGEST_TEXT for text in fields.values()):
                raise ValueError(f"Expected texts of at most {LONGEST_TEXT:,} letters.")
            taken = self._taken(record, fields)
        except (ValueError, StudyError) as error:
            return JSONResponse({"refused": str(error)}, 400)
        return _said(taken)

    def _taken(self, record: InterviewRecord, fields: Fields) -> Receipt:
        """Keep what was sent for a step."""
        take, kind = self._interviews.take, record.step.kind
        text, shown = fields.get("text", ""), fields.get("shown", "")
        match kind:
            case "consent":
                return self._interviews.begin(record, fields.get("cell", ""), shown)
            case "familiarity":
                if text not in self._study.design.familiarity.excluded:
                    return take(record, text, shown)
                return take(record, text, shown, state="excluded", reason=kind)
            case "mark":
                return self._take_marks(record, fields)
            case "done":
                return take(record, "", state="complete")
            case _:
                recorded = fields.get("recorded") == "yes"
                if kind in TELLINGS and not (text.strip() or recorded):
                    raise ValueError(
                        "Expected what was told, typed or recorded, got neither."
                    )
                return take(record, text.strip(), shown.strip())

    def _take_marks(self, record: InterviewRecord, fields: Fields) -> Receipt:
        route = record.step.route
        marks = read_marks(fields, self._study.site, route)
        taken = self._interviews.take(record, marks.as_json())
        heard = fields.get("transcript", "").strip()
        if taken == "kept" and heard:
            self._tellings.add_transcript(
                record.participant,
                StudyStep.of("tell", route),
                "the experimenter",
                heard,
                is_heard=False,
            )
        return taken

    async def _take_recording(self, request: Request) -> Response:
        self._experimenter.entrance.check(request)
        if not _is_safe(request):
            raise HTTPException(403, NEEDS_HTTPS)
        body = await request.body()
        return await run_in_threadpool(self._keep_recording, request, body)

    def _keep_recording(self, request: Request, body: bytes) -> Response:
        media_type = request.headers.get("content-type", "").partition(";")[0]
        query = dict(request.query_params)
        steps = interview_steps(self._study.design)
        try:
            record = _record(request, query)
            seconds = float(query.get("seconds", "nan"))
            about = StudyStep(record.step.removeprefix(VOICE))
            tells = record.step.startswith(VOICE) and about.kind in TELLINGS
            if not tells or about not in steps:
                raise ValueError(f"There is no recording of {record.step!r}.")
            if media_type not in MEDIA_TYPES or not body or not 0 <= seconds < 86_400:
                raise ValueError(
                    f"Expected a recording ({', '.join(MEDIA_TYPES)}) and its seconds, "
                    f"got {len(body)} bytes of {media_type or 'nothing'}."
                )
            taken = self._interviews.take_recording(record, body, media_type, seconds)
        except (ValueError, StudyError) as error:
            return JSONResponse({"refused": str(error)}, 400)
        if taken == "kept":
            self._recogniser.hear_new()
        return _said(taken)

    # What it asks for ------------------------------------------------------------------

    def _heard(self, request: Request, fields: Fields) -> Response:
        who, step = request.path_params["participant"], request.path_params["step"]
        told = [each for each in self._tellings.told(who) if each.step == step]
        return JSONResponse({
            "text": told[0].text if told else "",
            "problem": self._recogniser.problems.get((who, step), ""),
        })

    def _recording(self, request: Request, fields: Fields) -> Response:
        for each in self._tellings.recordings():
            if each.file == request.path_params["file"]:
                return FileResponse(
                    self._tellings.path_of(each), media_type=each.media_type
                )
        raise HTTPException(404)


def interview_steps(design: StudyDesign) -> list[StudyStep]:
    """Return all that may be answered in an interview, whatever its order."""
    kinds = ("familiarity", *ROUTE_STEPS)
    about = [StudyStep.of(kind, each.route) for each in design.routes for kind in kinds]
    return [*map(StudyStep, ("consent", "scenario", "done")), *about]


def _record(request: Request, fields: Fields) -> InterviewRecord:
    return InterviewRecord(
        request.path_params["record"],
        request.path_params["participant"],
        StudyStep(fields.get("step", "")),
        float(fields.get("opened", "nan")),
        float(fields.get("at", "nan")),
    )


def _said(taken: Receipt) -> Response:
    told: dict[str, Any] = {"taken": taken, "refused": REFUSALS.get(taken, "")}
    return JSONResponse(told, CODES[taken])


def _is_safe(request: Request) -> bool:
    """Tell whether nobody listens between the tablet and here."""
    return request.url.scheme == "https" or request.url.hostname in THIS_MACHINE
