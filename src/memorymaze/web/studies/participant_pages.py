"""What participants of the kinds `online`, `memory` and `follow` see, page by page.

What they send is judged here and kept by the store; where they are follows from what they
have answered.
"""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from typing import Any

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, RedirectResponse, Response
from starlette.routing import BaseRoute, Route

from memorymaze.texts.corpus.statistics import word_count
from memorymaze.web.serving.web import FORM_KEY, Fields, posted, render
from memorymaze.web.studies.films import Films
from memorymaze.web.studies.follow.drives import Drives
from memorymaze.web.studies.follow.pages import FollowPages
from memorymaze.web.studies.schedule import TELLINGS, StudyStep, steps_of
from memorymaze.web.studies.store import Participant, SentAnswer, Store, Taken
from memorymaze.web.studies.study_file import ChoiceQuestion

LONGEST_TEXT = 20_000
"""Characters of a description."""
LONGEST_ID = 200
"""Characters of a platform's id."""
REMEMBERED = 60 * 24 * 3600
"""Seconds that a browser knows who it is."""
FILM_KEPT = 24 * 3600
"""Seconds that a browser may keep a video."""
EVENTS = frozenset({"play", "pause", "ended", "again"})
"""What the video's script tells."""
WATCHED = "ended"
WRONG = "wrong"
"""Event of an attempt at the comprehension check that failed."""


@dataclass(frozen=True, slots=True)
class StudyPlace:
    """Where somebody is in a study."""

    participant: Participant
    step: StudyStep | None
    """None where all is answered."""
    number: int
    count: int
    answers: dict[StudyStep, SentAnswer]


class ParticipantPages:
    """The pages of a study, by its store and its videos."""

    def __init__(
        self, store: Store, films: Films | None = None, drives: Drives | None = None
    ) -> None:
        """Take the answers' store, and the videos or robots to drive."""
        self._store = store
        self._design = store.study.design
        self._films = films
        self._cookie = cookie_name("participant", store)
        self._follow = None
        if drives is not None:
            self._follow = FollowPages(store, drives, self._at_work)

    @property
    def routes(self) -> list[BaseRoute]:
        """Where the pages are."""
        return [
            Route("/", self._start),
            Route("/consent", posted(self._consent), methods=["POST"]),
            Route("/study", self._study),
            Route("/study/{step}", posted(self._answer), methods=["POST"]),
            Route("/draft/{step}", posted(self._draft), methods=["POST"]),
            Route("/event/{step}", posted(self._event), methods=["POST"]),
            Route("/film/{route}", self._film),
            Route("/film/{route}/state", self._film_state),
            Route("/privacy", self._privacy),
            Route("/withdraw", self._ask_withdrawal),
            Route("/withdraw", posted(self._withdraw), methods=["POST"]),
            *([] if self._follow is None else self._follow.routes),
        ]

    # Beginning -------------------------------------------------------------------------

    def _start(self, request: Request) -> Response:
        if self._participant(request) is not None:
            return _to("/study")
        ids = {
            name: request.query_params[name][:LONGEST_ID]
            for name in self._design.platform_ids
            if request.query_params.get(name)
        }
        return self._show(request, "consent.html", ids=ids)

    def _consent(self, request: Request, fields: Fields) -> Response:
        if self._participant(request) is not None:
            return _to("/study")
        ids = {
            name: fields[f"id.{name}"][:LONGEST_ID]
            for name in self._design.platform_ids
            if fields.get(f"id.{name}")
        }
        agreed = [f"consent.{n}" in fields for n in range(len(self._design.consent))]
        if not all(agreed):
            problem = "Please tick every box to take part; else simply close this page."
            return self._show(
                request, "consent.html", 400, ids=ids, agreed=agreed, problem=problem
            )
        # It follows from the cookie of forms, so that a form sent twice begins once.
        form_key: str = request.state.form_key
        key = sha256(b"participant of " + form_key.encode()).hexdigest()
        begun = self._store.begin(key, ids)
        if begun == "full":
            return self._end(request, "full", self._design.codes.full)
        if begun == "known":
            return self._end(request, "known", None)
        response = _to("/study")
        response.set_cookie(
            self._cookie,
            key,
            max_age=REMEMBERED,
            httponly=True,
            samesite="lax",
            secure=request.url.scheme == "https",
        )
        return response

    def _participant(self, request: Request) -> Participant | None:
        key = request.cookies.get(self._cookie)
        return None if key is None else self._store.known_by(key)

    # The steps -------------------------------------------------------------------------

    def _steps(self, participant: Participant) -> list[StudyStep]:
        return steps_of(self._design, participant.order)

    def _current(self, participant: Participant) -> StudyPlace:
        answers = self._store.answers(participant.id)
        steps = self._steps(participant)
        for number, step in enumerate(steps, start=1):
            if step not in answers:
                return StudyPlace(participant, step, number, len(steps), answers)
        return StudyPlace(participant, None, len(steps), len(steps), answers)

    def _study(self, request: Request) -> Response:
        participant = self._participant(request)
        if participant is None:
            return _to("/")
        if participant.state == "excluded":
            return self._end(request, "excluded", self._design.codes.excluded)
        place = self._current(participant)
        if participant.state == "complete" or place.step is None:
            return self._end(request, "complete", self._design.codes.complete)
        if not self._waits_for_film(place.step):
            self._store.add_event(participant.id, place.step, "opened")
        return self._page(request, place.step, place)

    def _questions(self, step: StudyStep) -> Sequence[ChoiceQuestion]:
        """Return the questions of a step that has choices."""
        match step.kind:
            case "comprehension":
                return self._design.comprehension.questions
            case "familiarity":
                return [self._design.familiarity]
            case "attention":
                return [self._design.attention[int(step.about)]]
            case _:
                return ()

    def _page(
        self,
        request: Request,
        step: StudyStep,
        place: StudyPlace,
        *,
        problem: str | None = None,
        given: Fields | None = None,
    ) -> Response:
        """Show a step; again with what was given where there is a problem with it."""
        store, participant, given = self._store, place.participant, given or {}
        view: dict[str, Any] = {"questions": self._questions(step)}
        template = "question.html" if view["questions"] else f"{step.kind}.html"
        if step.kind == "comprehension":
            view["attempt"] = self._failed_attempts(participant, step)
        elif step.kind == "wait":
            view["seconds_left"] = self._seconds_left(step, place.answers)
        elif step.kind in TELLINGS:
            template = "tell.html"
            view["text"] = given.get("text", store.draft(participant.id, step))
            view["longest"] = LONGEST_TEXT
            first = place.answers.get(StudyStep.of("tell", step.route))
            view["first"] = "" if first is None else first.text
        elif step.kind == "follow" and self._follow is not None:
            view |= self._follow.view(participant, step)
        if step.route:
            view["destination"] = store.study.route(step.route).goal
            number = participant.order.index(step.route) + 1
            view["place"] = (number, len(participant.order))
            watches = self._may_watch(step, step.route)
            view["film"] = f"/film/{step.route}" if watches else None
        if self._films is not None and self._waits_for_film(step):
            view["film_state"] = self._films.state(step.route)
            template = "film_wait.html"
        return self._show(
            request,
            template,
            200 if problem is None else 400,
            participant=participant,
            step=step,
            number=place.number,
            count=place.count,
            problem=problem,
            given=given,
            saved="saved" in request.query_params,
            **view,
        )

    def _answer(self, request: Request, fields: Fields) -> Response:
        participant = self._participant(request)
        if participant is None:
            return _to("/")
        place = self._current(participant)
        step = place.step
        # A page sent twice, or from another window, is not the present one any more.
        if participant.state != "active" or step is None or step != _key(request):
            return _to("/study")
        taken = self._taken(participant, step, fields)
        if isinstance(taken, str):
            return self._page(request, step, place, problem=taken, given=fields)
        state = "complete" if place.number == place.count else "active"
        self._store.add_answer(
            participant.id,
            step,
            taken.text,
            taken.shown,
            state="excluded" if taken.excluded else state,
            reason=taken.excluded,
        )
        return _to("/study")

    def _taken(self, who: Participant, step: StudyStep, fields: Fields) -> Taken | str:
        """Return what is kept of the form of a step, or what is wrong with it."""
        match step.kind:
            case "scenario":
                return Taken("", shown=self._design.scenario)
            case "watch":
                events = self._store.events(who.id, step)
                if any(event.kind == WATCHED for event in events):
                    return Taken("")
                return "Please watch the video to its end first; it will not come back."
            case "wait":
                if self._seconds_left(step, self._store.answers(who.id)) <= 0:
                    return Taken("")
                return "It is a little too early. This page says when to go on."
            case "tell" | "retell":
                return self._taken_text(who, step, fields.get("text", "").strip())
            case "follow":
                assert self._follow is not None
                return self._follow.take(who, step, fields)
            case _:
                return self._taken_choices(who, step, fields)

    def _taken_choices(
        self, who: Participant, step: StudyStep, fields: Fields
    ) -> Taken | str:
        chosen = _chosen(self._questions(step), fields)
        if step.kind == "comprehension":
            attempt = fields.get("attempt", "")
            return self._taken_comprehension(who, step, chosen, attempt)
        if chosen is None:
            return "Please choose an answer."
        known = step.kind == "familiarity"
        knows_it = known and chosen[0] in self._design.familiarity.excluded
        # The study file may have another wording when this is exported.
        right = "" if known else self._design.attention[int(step.about)].answer
        return Taken(chosen[0], shown=right, excluded="familiarity" if knows_it else "")

    def _taken_comprehension(
        self, who: Participant, step: StudyStep, chosen: list[str] | None, attempt: str
    ) -> Taken | str:
        check = self._design.comprehension
        if chosen is None:
            return "Please choose an answer to every question."
        wrong = [
            q for q, c in zip(check.questions, chosen, strict=True) if c != q.answer
        ]
        # As one step: a form sent twice comes in two threads.
        with self._store.writing():
            failed = self._failed_attempts(who, step)
            if attempt != str(failed):
                return (
                    "Not all answers were right that you sent before. Please read once "
                    "more what this is about, and send your answers."
                )
            if not wrong:
                return Taken(json.dumps(chosen))
            self._store.add_event(who.id, step, WRONG, len(wrong))
        if failed + 1 < check.attempts:
            return (
                "Not all answers were right. Please read once more what this is about."
            )
        return Taken(json.dumps(chosen), excluded="comprehension")

    def _failed_attempts(self, who: Participant, step: StudyStep) -> int:
        return sum(event.kind == WRONG for event in self._store.events(who.id, step))

    def _seconds_left(
        self, step: StudyStep, answers: Mapping[StudyStep, SentAnswer]
    ) -> int:
        seen = answers[StudyStep.of("watch", step.route)].at
        delay = 60 * (self._design.delay_minutes or 0)
        return max(0, math.ceil(seen + delay - self._store.now()))

    def _taken_text(self, who: Participant, step: StudyStep, text: str) -> Taken | str:
        design = self._design
        if word_count(text) >= design.least_words and len(text) <= LONGEST_TEXT:
            goal = self._store.study.route(step.route).goal
            task = design.task.replace("{destination}", goal)
            return Taken(text, shown=task if step.kind == "tell" else design.robot)
        self._store.keep_draft(who.id, step, text[:LONGEST_TEXT])
        if len(text) > LONGEST_TEXT:
            return f"Please use at most {LONGEST_TEXT:,} characters."
        return (
            "That is very short. Please describe the whole way, with at least "
            f"{design.least_words} words."
        )

    # What scripts send -----------------------------------------------------------------

    def _draft(self, request: Request, fields: Fields) -> Response:
        participant, step = self._at_work(request)
        if step.kind not in TELLINGS:
            raise HTTPException(404)
        text = fields.get("text", "")
        if len(text) > LONGEST_TEXT:
            raise HTTPException(413, f"Please use at most {LONGEST_TEXT:,} characters.")
        if not self._store.keep_draft(participant.id, step, text):
            raise HTTPException(
                409, "This description was sent already and cannot be changed."
            )
        # A script wants no page; who pressed the button does.
        return Response(status_code=204) if "quiet" in fields else _to("/study?saved")

    def _event(self, request: Request, fields: Fields) -> Response:
        participant, step = self._at_work(request)
        try:
            value = float(fields.get("value", "0"))
        except ValueError:
            value = math.nan
        if fields.get("kind") not in EVENTS or not 0 <= value < math.inf:
            raise HTTPException(400, "There is no such event.")
        if not self._store.add_event(participant.id, step, fields["kind"], value):
            raise HTTPException(429, "There are too many events already.")
        return Response(status_code=204)

    def _at_work(self, request: Request) -> tuple[Participant, StudyStep]:
        participant = self._participant(request)
        if participant is None:
            raise HTTPException(403, "Nobody takes part in this browser.")
        step = StudyStep(_key(request))
        if step not in self._steps(participant):
            raise HTTPException(404)
        return participant, step

    def _film(self, request: Request) -> Response:
        films, route = self._watched(request)
        film = films.ready(route)
        if film is None:
            raise HTTPException(503, "The video is not there yet.")
        # Shown twice while it may be watched; from memory, no browser may keep it.
        is_kept = self._design.kind != "memory"
        caching = f"private, max-age={FILM_KEPT}" if is_kept else "no-store"
        return FileResponse(
            film,
            media_type="video/mp4",
            headers={"Cache-Control": caching},
        )

    def _film_state(self, request: Request) -> Response:
        films, route = self._watched(request)
        state = films.state(route)
        return JSONResponse({"ready": state.state == "ready", "left": state.left})

    def _watched(self, request: Request) -> tuple[Films, str]:
        """Return the videos, and the route of which a participant may watch one now."""
        participant = self._participant(request)
        route, films = request.path_params["route"], self._films
        if participant is None or films is None or route not in films.paths:
            raise HTTPException(404)
        step = self._current(participant).step
        if step is None or not self._may_watch(step, route):
            raise HTTPException(404)
        return films, route

    def _waits_for_film(self, step: StudyStep) -> bool:
        """Return whether a step shows a video that is not there yet."""
        return (
            self._films is not None
            and step.route in self._films.paths
            and self._may_watch(step, step.route)
            and self._films.ready(step.route) is None
        )

    def _may_watch(self, step: StudyStep, route: str) -> bool:
        """Return whether a video is there: from memory, it is gone while one describes."""
        kinds = ("watch",) if self._design.kind == "memory" else TELLINGS
        return step.kind in kinds and step.route == route

    # Leaving ---------------------------------------------------------------------------

    def _privacy(self, request: Request) -> Response:
        return self._show(request, "privacy.html")

    def _ask_withdrawal(self, request: Request) -> Response:
        participant = self._participant(request)
        if participant is None:
            return _to("/")
        return self._show(request, "withdraw.html", participant=participant)

    def _withdraw(self, request: Request, fields: Fields) -> Response:
        participant = self._participant(request)
        if participant is None:
            return _to("/")
        done = self._store.withdraw(participant.id)
        response = self._show(request, "withdrawn.html", exported=bool(done.exports))
        response.delete_cookie(self._cookie)
        # Else whoever begins anew would have the key of who withdrew.
        response.delete_cookie(FORM_KEY)
        return response

    def _end(self, request: Request, why: str, code: str | None) -> Response:
        address = ""
        if code is not None:
            address = self._design.codes.return_address.replace("{code}", code)
        return self._show(
            request,
            "end.html",
            why=why,
            code=code,
            address=address,
            participant=self._participant(request),
        )

    def _show(
        self, request: Request, template: str, status_code: int = 200, **view: Any
    ) -> Response:
        return render(
            request,
            template,
            status_code,
            design=self._design,
            language=self._design.language,
            **{"participant": None, "problem": None, **view},
        )


def cookie_name(who: str, store: Store) -> str:
    """Return the cookie of a role: servers on one machine share theirs between ports."""
    place = sha256(str(store.folder.absolute()).encode()).hexdigest()[:8]
    return f"{who}-{place}"


def _chosen(questions: Sequence[ChoiceQuestion], fields: Fields) -> list[str] | None:
    """Return the choices made; None where one is missing."""
    chosen: list[str] = []
    for number, question in enumerate(questions):
        answer = fields.get(f"answer.{number}", "")
        if not answer.isdecimal() or int(answer) >= len(question.choices):
            return None
        chosen.append(question.choices[int(answer)])
    return chosen


def _key(request: Request) -> str:
    return request.path_params["step"]


def _to(address: str) -> Response:
    return RedirectResponse(address, status_code=303)
