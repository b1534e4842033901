"""What the experimenter sees: progress, participants, withdrawal; behind a token."""

from collections.abc import Awaitable, Callable
from datetime import datetime
from typing import Any

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import BaseRoute, Route

from memorymaze.web.serving.entrance import Entrance
from memorymaze.web.serving.web import Fields, posted, render
from memorymaze.web.studies.films import Films
from memorymaze.web.studies.participant_pages import cookie_name
from memorymaze.web.studies.store import Participant, Store


class ExperimenterPages:
    """The pages of who runs a study."""

    def __init__(self, store: Store, token: str, films: Films | None = None) -> None:
        """Take the answers' store, what the printed address ends with, and videos."""
        self._store = store
        self._films = films
        self.entrance = Entrance(
            token,
            cookie_name("experimenter", store),
            "Open the experimenter's address that the server printed.",
        )

    @property
    def routes(self) -> list[BaseRoute]:
        """Where the pages are."""
        return [
            *self.entrance.routes,
            Route("/", self.guarded(self._overview)),
            Route("/find", self.guarded(self._find)),
            Route("/participants/{id}", self.guarded(self._participant)),
            Route(
                "/participants/{id}/withdraw",
                self.guarded(self._withdraw),
                methods=["POST"],
            ),
            Route("/ethics", self.guarded(self._ethics)),
        ]

    def guarded(
        self, page: Callable[[Request, Fields], Response]
    ) -> Callable[[Request], Awaitable[Response]]:
        """Return an endpoint that only who has the token gets to."""

        def checked(request: Request, fields: Fields) -> Response:
            self.entrance.check(request)
            return page(request, fields)

        return posted(checked)

    def _overview(self, request: Request, fields: Fields) -> Response:
        store, films = self._store, self._films
        return self.show(
            request,
            "overview.html",
            progress=store.progress(),
            films=[] if films is None else [films.state(r) for r in films.paths],
            quota=store.study.design.quota,
            participants=store.participants(),
            exports=store.exports(),
            withdrawals=store.withdrawals(),
            missed=request.query_params.get("missed"),
        )

    def _find(self, request: Request, fields: Fields) -> Response:
        wanted = request.query_params.get("id", "").strip()
        found = self._store.find(wanted)
        address = "/?missed=1" if found is None else f"/participants/{found.id}"
        return RedirectResponse(address, status_code=303)

    def _participant(self, request: Request, fields: Fields) -> Response:
        who = self._known(request)
        answers = self._store.answers(who.id)
        events = self._store.events(who.id)
        opened: dict[str, float] = {}
        for event in events:
            opened.setdefault(event.step, event.at)
        rows = [
            (step, answer, answer.at - opened.get(step, answer.at))
            for step, answer in answers.items()
        ]
        return self.show(
            request,
            "one_participant.html",
            who=who,
            rows=rows,
            platform_ids=self._store.platform_ids(who.id),
        )

    def _withdraw(self, request: Request, fields: Fields) -> Response:
        done = self._store.withdraw(self._known(request).id)
        return self.show(request, "removed.html", exports=done.exports)

    def _ethics(self, request: Request, fields: Fields) -> Response:
        return self.show(request, "ethics.html", folder=self._store.folder.absolute())

    def _known(self, request: Request) -> Participant:
        found = self._store.participant(request.path_params["id"])
        if found is None:
            raise HTTPException(404)
        return found

    def show(self, request: Request, template: str, **view: Any) -> Response:
        """Return a page for the experimenter."""
        return render(
            request,
            template,
            design=self._store.study.design,
            file=self._store.study.path.name,
            when=_when,
            **view,
        )


def _when(seconds: float) -> str:
    return datetime.fromtimestamp(seconds).astimezone().strftime("%Y-%m-%d %H:%M")
