"""Descriptions labelled on the plan by several people; behind the token."""

from typing import Any
from urllib.parse import quote

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import BaseRoute, Route

from memorymaze.web.serving.web import Fields
from memorymaze.web.studies.experimenter_pages import ExperimenterPages
from memorymaze.web.studies.interviews.transcript_pages import (
    LONGEST_NAME,
    NAMELESS,
)
from memorymaze.web.studies.labels.labelling import Given, Labelled, Labelling
from memorymaze.web.studies.labels.marking import numbered_places, plan_view, read_marks
from memorymaze.web.studies.store import Store
from memorymaze.web.studies.tellings import StudyTellings
from memorymaze.world.drawing.svg import svg_plan


class LabelPages:
    """The pages for labels, of every kind of study that has descriptions."""

    def __init__(
        self, experimenter: ExperimenterPages, store: Store, tellings: StudyTellings
    ) -> None:
        """Take who guards the pages, the answers, and what is told."""
        self._experimenter = experimenter
        self._study = store.study
        self._labelling = Labelling(store, tellings)
        self._drawn = ""

    @property
    def routes(self) -> list[BaseRoute]:
        """Where the pages are."""
        guarded, one = self._experimenter.guarded, "/labels/{participant}/{step}"
        return [
            Route("/plan.svg", guarded(self._plan)),
            Route("/labels", guarded(self._list)),
            Route(one, guarded(self._show)),
            Route(one, guarded(self._take), methods=["POST"]),
        ]

    def _plan(self, request: Request, fields: Fields) -> Response:
        self._drawn = self._drawn or svg_plan(self._study.site)
        return Response(self._drawn, media_type="image/svg+xml")

    def _list(self, request: Request, fields: Fields) -> Response:
        labelled = self._labelling.labelled()
        found = self._labelling.agreement()
        return self._experimenter.show(
            request,
            "labels.html",
            labelled=labelled,
            name=request.query_params.get("name", "").strip()[:LONGEST_NAME],
            agreement=None if isinstance(found, str) else found,
            unknown=found if isinstance(found, str) else "",
            differing=[
                each for each in labelled if each.consensus and each.consensus.open
            ],
            settled=sum(each.agreed is not None for each in labelled),
            in_words=self._in_words,
        )

    def _in_words(self, given: Given) -> str:
        places = {
            each.id: f"place {each.number}"
            for each in numbered_places(self._study.site)
        }
        by_place = " > ".join(places[each] for each in given.places)
        errors = "; ".join(
            f"{each.kind.replace('_', ' ')} at {places.get(each.where, each.where)}"
            for each in given.label.failures
        )
        return f"way {given.label.way}{f' ({by_place})' if by_place else ''}, {errors or 'no error'}"

    def _show(self, request: Request, fields: Fields) -> Response:
        query = request.query_params
        settles = "settle" if "settle" in query else ""
        return self._page(request, {"name": query.get("name", ""), "settle": settles})

    def _page(self, request: Request, given: Fields, problem: str = "") -> Response:
        labelled = self._labelled(request)
        told = labelled.told
        name = given.get("name", "").strip()
        shown = [*labelled.labels] if given.get("settle") else []
        own = next(
            (each for each in labelled.labels if each.label.annotator == name), None
        )
        numbers = {
            each.id: str(each.number) for each in numbered_places(self._study.site)
        }
        marked: dict[str, Any] = _as_typed(given)
        if own is not None and not given.get("settle") and not problem:
            marked = {
                "way": own.label.way,
                "places": " ".join(numbers[each] for each in own.places),
                "failures": own.label.failures,
            }
        return self._experimenter.show(
            request,
            "label.html",
            told=told,
            view=plan_view(self._study.site, told.route),
            route=self._study.route(told.route),
            given=marked,
            name=name,
            settles=bool(given.get("settle")),
            others=shown,
            in_words=self._in_words,
            problem=problem,
            longest_name=LONGEST_NAME,
        )

    def _labelled(self, request: Request) -> Labelled:
        """Return the description that an address is about."""
        wanted = request.path_params["participant"], request.path_params["step"]
        for each in self._labelling.labelled():
            if (each.told.participant, each.told.step) == wanted:
                return each
        raise HTTPException(404)

    def _take(self, request: Request, fields: Fields) -> Response:
        told = self._labelled(request).told
        name = fields.get("name", "").strip()
        if not name or len(name) > LONGEST_NAME:
            return self._page(request, fields, NAMELESS)
        try:
            marks = read_marks(fields, self._study.site, told.route)
        except ValueError as error:
            return self._page(request, fields, str(error))
        self._labelling.add(told, name, marks, settles=bool(fields.get("settle")))
        return RedirectResponse(f"/labels?name={quote(name)}", status_code=303)


def _as_typed(given: Fields) -> dict[str, Any]:
    """Return what a form was sent with, to be shown again."""
    numbers = sorted(
        int(name.partition(".")[2]) for name in given if name.startswith("kind.")
    )
    return {
        "way": given.get("way", ""),
        "places": given.get("places", ""),
        "failures": [
            {name: given.get(f"{name}.{n}", "") for name in ("kind", "where", "detail")}
            for n in numbers
            if given[f"kind.{n}"]
        ],
    }
