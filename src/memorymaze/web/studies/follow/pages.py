"""The page on which people follow a text, and what its script asks for."""

from collections.abc import Callable
from typing import Any

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import BaseRoute, Route

from memorymaze.basics.errors import StudyError
from memorymaze.web.serving.web import Fields, posted
from memorymaze.web.studies.follow.drives import Drives, NoRobotNow, WalkElsewhere
from memorymaze.web.studies.follow.walk import Said
from memorymaze.web.studies.schedule import StudyStep
from memorymaze.web.studies.store import Participant, Store, Taken

SURE = (
    ("0", "not at all"),
    ("25", "rather not"),
    ("50", "half and half"),
    ("75", "rather sure"),
    ("100", "entirely"),
)
"""Percent, and how they are said."""
SAID = (
    ("arrived", "The robot is where the words lead."),
    ("gave_up", "I cannot find the way."),
)

AtWork = Callable[[Request], tuple[Participant, StudyStep]]
"""Tells who sends a request, and for which step; refuses others."""


class FollowPages:
    """What belongs to the step `follow` of a study."""

    def __init__(self, store: Store, drives: Drives, at_work: AtWork) -> None:
        """Take the answers' store, and the robots."""
        self._store, self._drives, self._at_work = store, drives, at_work

    @property
    def routes(self) -> list[BaseRoute]:
        """Where the script asks."""
        return [
            Route("/robot/{step}", self._see),
            Route("/robot/{step}", posted(self._drive), methods=["POST"]),
        ]

    def view(self, who: Participant, step: StudyStep) -> dict[str, Any]:
        """Return what the page shows besides what every page does."""
        told = self._drives.text_for(who, step).instruction
        follow = self._store.study.design.follow
        return {
            "told": told,
            "reads_aloud": follow is not None and follow.read_aloud,
            "endings": SAID,
            "sure": SURE,
        }

    def take(self, who: Participant, step: StudyStep, fields: Fields) -> Taken | str:
        """Return what is kept of a walk that somebody ends, or what is wrong with it."""
        said, sure = fields.get("said"), fields.get("sure")
        if said not in dict(SAID) or sure not in dict(SURE):
            return "Please say whether you are there, and how sure you are of it."
        return self._drives.ending(who, step, Said(said == "arrived", int(sure) / 100))

    def _see(self, request: Request) -> Response:
        return self._answered(lambda: self._drives.see(*self._walk(request)))

    def _drive(self, request: Request, fields: Fields) -> Response:
        number = fields.get("number", "")
        if not (number.isdecimal() and len(number) < 6):
            raise HTTPException(400)
        command = fields.get("command", "")
        return self._answered(
            lambda: self._drives.drive(*self._walk(request), int(number), command)
        )

    def _walk(self, request: Request) -> tuple[Participant, StudyStep]:
        who, step = self._at_work(request)
        if step.kind != "follow" or who.state != "active":
            raise HTTPException(404)
        return who, step

    def _answered(self, ask: Callable[[], dict[str, Any]]) -> Response:
        """Return what comes of a request, as the script reads it."""
        try:
            status, told = 200, ask()
        except NoRobotNow as error:
            status, told = 503, {"problem": str(error)}
        except WalkElsewhere as error:
            status, told = 409, {"problem": str(error)}
        except StudyError as error:
            status, told = 400, {"problem": str(error)}
        return JSONResponse(told, status, {"Cache-Control": "no-store"})
