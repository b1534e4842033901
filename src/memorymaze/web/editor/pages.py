"""The page to edit a plan, and what its script asks for."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ConfigDict
from shapely import Polygon
from shapely.errors import ShapelyError
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import BaseRoute, Route

from memorymaze.basics.errors import SitePlanError
from memorymaze.web.editor.plan_file import (
    ChangedMeanwhile,
    Edited,
    Plan,
    PlanFile,
    TracedPicture,
)
from memorymaze.web.editor.proposals import completed, missing_turning_points
from memorymaze.web.serving.entrance import Entrance
from memorymaze.web.serving.web import render
from memorymaze.world.sites.checking import (
    DOOR_STYLES,
    FLOOR_MATERIALS,
    ROOM_USES,
    WALL_MATERIALS,
    plan_problems,
)
from memorymaze.world.sites.loading import site_from_content
from memorymaze.world.sites.loading_rules import floor_is_complete
from memorymaze.world.sites.plan_models import FEATURE_MODELS, PlanHeader
from memorymaze.world.sites.reading import understand_plan
from memorymaze.world.sites.records import Site, floor_pieces
from memorymaze.world.sites.things import door_kinds, thing_kinds

_Message = TypeVar("_Message", bound=BaseModel)

EDITOR_ROOM = "memorymaze.web.editor"
LARGEST_PLAN = 32_000_000
"""Bytes that a browser may send."""


class Proposal(Edited):
    """A plan, and a drawn feature to complete; None: all turning points that lack."""

    feature: Plan | None


class Nothing(BaseModel):
    """A request that says all by its address."""

    model_config = ConfigDict(strict=True, frozen=True)


class EditorPages:
    """The page of one plan."""

    def __init__(
        self, file: PlanFile, entrance: Entrance, picture: Path | None
    ) -> None:
        """Edit a file, over a picture."""
        self._file, self._entrance, self._picture = file, entrance, picture

    @property
    def routes(self) -> list[BaseRoute]:
        """Where the page and its script ask."""
        return [
            *self._entrance.routes,
            Route("/", self._show),
            Route("/picture", self._show_picture),
            Route("/plan", self._load),
            self._told("/check", Edited, self._check),
            self._told("/save", Edited, self._save),
            self._told("/propose", Proposal, self._propose),
            self._told("/discard", Nothing, self._discard),
            self._told("/place", TracedPicture, self._place),
        ]

    def _told(
        self, path: str, message: type[_Message], answer: Callable[[_Message], Any]
    ) -> Route:
        """Return where the script sends a message."""

        async def endpoint(request: Request) -> Response:
            self._entrance.check(request)
            try:
                told = message.model_validate(json.loads(await request.body()))
            except ValueError:
                raise HTTPException(400) from None
            try:
                return _answered(await run_in_threadpool(answer, told))
            except ChangedMeanwhile as error:
                return _answered({"problem": str(error)}, 409)
            except SitePlanError as error:
                return _answered({"problem": str(error)}, 400)
            except OSError as error:
                return _answered({"problem": f"Not kept: {error}"}, 507)

        return Route(path, endpoint, methods=["POST"])

    def _show(self, request: Request) -> Response:
        self._entrance.check(request)
        return render(
            request,
            "editor.html",
            file=self._file.path.name,
            has_picture=self._picture is not None,
        )

    def _show_picture(self, request: Request) -> Response:
        self._entrance.check(request)
        if self._picture is None:
            raise HTTPException(404)
        return FileResponse(self._picture)

    def _load(self, request: Request) -> Response:
        self._entrance.check(request)
        try:
            contents = self._file.contents()
        except SitePlanError as error:
            return _answered({"problem": str(error)}, 409)
        return _answered({**contents, "forms": _forms()})

    def _check(self, edited: Edited) -> dict[str, Any]:
        """Keep the draft, and tell what is wrong with it and where its walls are."""
        document = self._file.keep_draft(edited)
        problems = plan_problems(understand_plan(document), self._file.path)
        site, complete = _site_of(document, self._file.path)
        walls: list[Polygon] = []
        if site is not None and complete:
            walls = floor_pieces([each.polygon for each in site.floor_parts])
        return {
            "problems": [each._asdict() for each in problems],
            "walls": [
                [[round(x, 3), round(y, 3)] for x, y, *_ in ring.coords]
                for piece in walls
                for ring in (piece.exterior, *piece.interiors)
            ],
        }

    def _save(self, edited: Edited) -> dict[str, str]:
        return {"base": self._file.save(edited)}

    def _propose(self, told: Proposal) -> dict[str, list[Plan]]:
        document = self._file.document(told)
        site, _ = _site_of(document, self._file.path)
        if site is None:
            return {"features": [told.feature] if told.feature else []}
        if told.feature is not None:
            try:
                return {"features": [completed(told.feature, site)]}
            except (LookupError, TypeError, ValueError, ShapelyError) as error:
                raise SitePlanError(
                    f"Its places make no shape to propose anything for ({error})."
                ) from None
        ids = {str(each["id"]) for each in document["features"] if _has_id(each)}
        return {"features": list(missing_turning_points(site, ids))}

    def _discard(self, told: Nothing) -> None:
        self._file.discard_draft()

    def _place(self, picture: TracedPicture) -> None:
        self._file.keep_picture(picture)


def _has_id(feature: object) -> bool:
    return isinstance(feature, dict) and "id" in feature


def _answered(content: object, status: int = 200) -> Response:
    # JSON of plain letters can hold halves of characters, which plans may have.
    return Response(
        json.dumps(content),
        status,
        {"Cache-Control": "no-store"},
        media_type="application/json",
    )


def _site_of(document: Plan, path: Path) -> tuple[Site | None, bool]:
    """Return what can be made of a plan, and whether all of its floor is in it."""
    site, broken, _ = site_from_content(understand_plan(document), str(path))
    return site, floor_is_complete(broken)


def _forms() -> dict[str, Any]:
    """Return the properties of each kind as JSON schemas, and the words for them."""
    things = thing_kinds()
    kinds = (*things.values(), *door_kinds().values())
    bench = things["bench"]
    return {
        "kinds": {
            kind: model.model_json_schema() for kind, model in FEATURE_MODELS.items()
        },
        "plan": PlanHeader.model_json_schema(),
        "words": {
            "floor_material": FLOOR_MATERIALS,
            "wall_material": WALL_MATERIALS,
            "use": ROOM_USES,
            "style": DOOR_STYLES,
            "category": sorted(things),
            "color": sorted({each for kind in kinds for each in kind.colors}),
        },
        "new_thing": {
            "category": bench.name,
            "size_m": bench.size,
            "mount": bench.mount,
            "obstacle": bench.in_the_way,
        },
    }
