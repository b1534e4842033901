"""What was said in recordings, to be written down and corrected; behind the token."""

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import BaseRoute, Route

from memorymaze.web.serving.web import Fields
from memorymaze.web.studies.experimenter_pages import ExperimenterPages
from memorymaze.web.studies.participant_pages import LONGEST_TEXT
from memorymaze.web.studies.tellings import StudyTelling, StudyTellings

NAMELESS = "Please say who you are: it is kept with the text."
LONGEST_NAME = 60
"""Letters."""


class TranscriptPages:
    """The pages for texts, of every kind of study that has descriptions."""

    def __init__(
        self, experimenter: ExperimenterPages, tellings: StudyTellings
    ) -> None:
        """Take who guards the pages, and what is told."""
        self._experimenter = experimenter
        self._tellings = tellings

    @property
    def routes(self) -> list[BaseRoute]:
        """Where the pages are."""
        guarded, one = self._experimenter.guarded, "/transcripts/{participant}/{step}"
        return [
            Route("/transcripts", guarded(self._list)),
            Route(one, guarded(self._show)),
            Route(one, guarded(self._take), methods=["POST"]),
        ]

    def _list(self, request: Request, fields: Fields) -> Response:
        told = self._tellings.told()
        # What still has to be written down comes first.
        ordered = sorted(told, key=lambda each: bool(each.text))
        return self._experimenter.show(request, "transcripts.html", told=ordered)

    def _show(self, request: Request, fields: Fields) -> Response:
        return self._page(request, self._told(request))

    def _page(
        self,
        request: Request,
        told: StudyTelling,
        problem: str = "",
        given: Fields | None = None,
    ) -> Response:
        given = given or {"text": told.text, "name": ""}
        return self._experimenter.show(
            request,
            "transcript.html",
            told=told,
            problem=problem,
            given=given,
            longest=LONGEST_TEXT,
            longest_name=LONGEST_NAME,
        )

    def _take(self, request: Request, fields: Fields) -> Response:
        told = self._told(request)
        text, name = fields.get("text", "").strip(), fields.get("name", "").strip()
        given = {"text": text, "name": name}
        if not name or len(name) > LONGEST_NAME:
            return self._page(request, told, NAMELESS, given)
        if not text or len(text) > LONGEST_TEXT:
            problem = (
                f"Please write what was said, with at most {LONGEST_TEXT:,} letters."
            )
            return self._page(request, told, problem, given)
        if text != told.text:
            self._tellings.add_transcript(
                told.participant, told.step, name, text, is_heard=False
            )
        return RedirectResponse("/transcripts", status_code=303)

    def _told(self, request: Request) -> StudyTelling:
        """Return the description that an address is about."""
        who, step = request.path_params["participant"], request.path_params["step"]
        for told in self._tellings.told(who):
            if told.step == step:
                return told
        raise HTTPException(404)
