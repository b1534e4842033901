"""The pages to try the robot: choose a way, look round, tell it, watch it."""

import math
from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from typing import Any

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.routing import BaseRoute
from starlette.routing import Route as Path

from memorymaze.basics.wording import single_spaced
from memorymaze.texts.corpus import Corpus, load_corpus
from memorymaze.web.serving.web import Fields, csrf_token, posted, render
from memorymaze.web.try_page.sessions import NoRobotFree, PageVisit, Visits
from memorymaze.world.drawing.svg import ViewBox, path_data, plan_frame, svg_plan
from memorymaze.world.sites import Route, Site

TRYING_ROOM = "memorymaze.web.try_page"
PACES = ("1", "3", "5", "10", "30")
"""Simulated seconds per second that one can choose."""
LONGEST_TEXT = 4000
"""Characters of a description."""
AROUND = 6.0
"""Metres of plan shown round the way."""
EXAMPLE_LENGTH = 350
"""Characters that an example should have."""


@dataclass(frozen=True, slots=True)
class Example:
    """A description of the way that one can begin with."""

    title: str
    text: str


class TryPages:
    """The pages, over the visitors and the buildings they may choose from."""

    def __init__(self, visits: Visits, sites: Mapping[str, Site]) -> None:
        """Show some buildings."""
        self._visits = visits
        self._sites = sites
        self._plans: dict[str, str] = {}

    def routes(self) -> list[BaseRoute]:
        """Return what is served where."""
        return [
            Path("/", self._choose),
            Path("/plans/{site}.svg", self._show_plan),
            Path("/visits", posted(self._begin), methods=["POST"]),
            Path("/visits/{visit}", self._show),
            Path("/visits/{visit}/walk", posted(self._walk), methods=["POST"]),
            Path("/visits/{visit}/news", self._tell_news),
            Path("/visits/{visit}/pace", posted(self._change_pace), methods=["POST"]),
            Path("/visits/{visit}/stop", posted(self._stop), methods=["POST"]),
            Path("/visits/{visit}/leave", posted(self._leave), methods=["POST"]),
            Path("/visits/{visit}/{picture}.jpg", self._show_picture),
        ]

    def _choose(self, request: Request) -> Response:
        places = [(site, ways_of(site)) for site in self._sites.values()]
        return render(request, "start.html", places=places)

    def _show_plan(self, request: Request) -> Response:
        name = request.path_params["site"]
        if name not in self._sites:
            raise HTTPException(404)
        if name not in self._plans:
            self._plans[name] = svg_plan(self._sites[name])
        return Response(self._plans[name], media_type="image/svg+xml")

    def _begin(self, request: Request, fields: Fields) -> Response:
        site = self._sites.get(fields.get("site", ""))
        ways = [] if site is None else ways_of(site)
        way = next((each for each in ways if each.id == fields.get("route")), None)
        if site is None or way is None:
            raise HTTPException(404)
        with _telling_who_waits():
            visit = self._visits.begin(site, way, csrf_token(request))
        return RedirectResponse(f"/visits/{visit.id}", 303)

    def _show(self, request: Request) -> Response:
        visit = self._visit(request)
        return render(
            request,
            "visit.html",
            visit=visit,
            way=_drawn(visit.site, visit.route),
            examples=examples_of(visit.site, visit.route),
            paces=PACES,
            longest=LONGEST_TEXT,
        )

    def _walk(self, request: Request, fields: Fields) -> Response:
        visit = self._visit(request)
        text = single_spaced(fields.get("text", ""))
        if not 0 < len(text) <= LONGEST_TEXT:
            raise HTTPException(
                400,
                f"Please describe the way in 1 to {LONGEST_TEXT} characters; there were "
                f"{len(text)}.",
            )
        with _telling_who_waits():
            begun = self._visits.set_out(visit, text)
        if not begun:
            raise HTTPException(
                409, "The robot is on its way. Stop it before you tell it another way."
            )
        return RedirectResponse(f"/visits/{visit.id}", 303)

    def _tell_news(self, request: Request) -> Response:
        asked = request.query_params
        try:
            walk, known = int(asked.get("walk", "0")), int(asked.get("known", "0"))
        except ValueError:
            raise HTTPException(400) from None
        news = self._visits.news_after(self._visit(request), walk, max(0, known))
        return JSONResponse(news, headers={"Cache-Control": "no-store"})

    def _change_pace(self, request: Request, fields: Fields) -> Response:
        visit = self._visit(request)
        if fields.get("pace") not in PACES:
            raise HTTPException(400)
        paused = fields.get("paused") == "true"
        self._visits.change_pace(visit, float(fields["pace"]), paused)
        return Response(status_code=204)

    def _stop(self, request: Request, fields: Fields) -> Response:
        visit = self._visit(request)
        with _telling_who_waits():
            self._visits.stop(visit)
        return RedirectResponse(f"/visits/{visit.id}", 303)

    def _leave(self, request: Request, fields: Fields) -> Response:
        self._visits.leave(self._visit(request))
        return Response(status_code=204)

    def _show_picture(self, request: Request) -> Response:
        jpeg = self._visit(request).pictures.get(request.path_params["picture"])
        if jpeg is None:
            raise HTTPException(404)
        return Response(
            jpeg, media_type="image/jpeg", headers={"Cache-Control": "no-store"}
        )

    def _visit(self, request: Request) -> PageVisit:
        visit = self._visits.find(request.path_params["visit"])
        if visit is None:
            raise HTTPException(
                404, "This robot was put away long ago. Begin at the first page."
            )
        return visit


@contextmanager
def _telling_who_waits() -> Generator[None]:
    """Show a page that asks for patience where there is no robot."""
    try:
        yield
    except NoRobotFree as error:
        raise HTTPException(503, str(error)) from None


def ways_of(site: Site) -> list[Route]:
    """Return the routes of a building that one may tell."""
    return [route for route in site.routes if route.role == "reference"]


def examples_of(site: Site, route: Route) -> Sequence[Example]:
    """Return shipped descriptions of a route: typed, spoken, and one with a mistake."""
    corpus = _shipped()
    shipped = corpus.sites.get(site.name)
    if shipped != site:
        return ()
    told = [
        each
        for each in corpus.instructions
        if (each.site, each.reference_route) == (site.name, route.id)
    ]
    kinds = {
        "Typed": [e for e in told if e.study == "online" and not e.failures],
        "Spoken": [e for e in told if e.study == "onsite" and not e.failures],
        "With a mistake in it": [e for e in told if e.failures],
    }
    return [
        Example(title, min(fit, key=lambda e: abs(len(e.text) - EXAMPLE_LENGTH)).text)
        for title, fit in kinds.items()
        if fit
    ]


@cache
def _shipped() -> Corpus:
    return load_corpus()


def _drawn(site: Site, route: Route) -> dict[str, Any]:
    """Return what the page's script and picture need of a plan, metres, y down."""
    west, south, east, north = route.line.buffer(AROUND).bounds
    goal_x, goal_y = route.line.coords[-1][:2]
    start = route.start
    return {
        "frame": plan_frame(site),
        "view": ViewBox(west, -north, east - west, north - south),
        "line": path_data(list(route.line.coords)),
        "goal": (round(goal_x, 2), round(-goal_y, 2)),
        "start": (round(start.x, 2), round(-start.y, 2)),
        "turn": round(-math.degrees(start.heading), 1),
    }
