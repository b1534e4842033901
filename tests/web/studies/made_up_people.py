"""Made-up participants who go through the real pages, as people would.

Their texts are the grammar's, with the published rates of errors; their clock is quick.
"""

import json
import re
import time
from collections import Counter
from collections.abc import Generator
from contextlib import contextmanager

import httpx2
import numpy as np
from tests.web.studies.made_up_interviews import MadeUpTablet

from memorymaze.basics.errors import StudyError
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.corpus.statistics import word_count
from memorymaze.texts.writing import cells_of, parse_rates, sample_outlines, write_texts
from memorymaze.web.studies.follow.drives import LONGEST_WAIT
from memorymaze.web.studies.follow.pages import SURE
from memorymaze.web.studies.schedule import cell_name, route_orders
from memorymaze.web.studies.serving import serving_study
from memorymaze.web.studies.store import open_store
from memorymaze.web.studies.study_file import CheckedQuestion, Study

KNOWS_THE_PLACE = 0.05
MISUNDERSTANDS = 0.1
FAILS_ATTENTION = 0.05
LEAVES = 0.01
"""At each page."""
WORDS_A_SECOND = 0.6
"""Typed."""
COMMANDS = (20, 120)
"""Given to a robot in a walk."""
ROUTE_SECONDS = (40.0, 120.0)
"""Of one look at a video."""
MOST_PAGES = 200

Told = dict[tuple[str, int], list[Instruction]]
"""By route and iteration."""


class _Clock:
    """The time, as it passes for who waits and types at no cost."""

    def __init__(self) -> None:
        self._ahead = 0.0

    def now(self) -> float:
        """Return seconds since 1970."""
        return time.time() + self._ahead

    def skip(self, seconds: float) -> None:
        """Let time pass."""
        self._ahead += seconds


def let_take_part(study: Study, count: int, seed: int = 0) -> Counter[str]:
    """Fill the store of a study through its served pages.

    Returns how many finished, were excluded, left, or found no place.
    """
    told = {} if study.design.kind == "follow" else _told(study, count, seed)
    clock = _Clock()
    ends: Counter[str] = Counter()
    with (
        open_store(study, clock=clock.now) as store,
        serving_study(store, draws=False) as addresses,
    ):
        if study.design.kind == "onsite":
            entrance = addresses.experimenter
            return _interview_all(study, entrance, clock, told, count, seed)
        for number in range(count):
            rng = np.random.default_rng([seed, number])
            with _visiting(study, addresses.participants, clock, rng) as visitor:
                visitor.texts = {key: some[number].text for key, some in told.items()}
                ends[visitor.take_part(f"made-up-{number}")] += 1
    return ends


def _interview_all(
    study: Study,
    entrance: str,
    clock: _Clock,
    told: Told,
    count: int,
    seed: int,
) -> Counter[str]:
    """Let one tablet interview everybody."""
    ends: Counter[str] = Counter()
    orders = [cell_name(order) for order in route_orders(study.design)]
    server = entrance.partition("/enter/")[0]
    with httpx2.Client(base_url=server, timeout=LONGEST_WAIT) as client:
        tablet = MadeUpTablet(study, client, entrance, clock)
        for number in range(count):
            rng = np.random.default_rng([seed, number])
            one = {key: some[number] for key, some in told.items()}
            ends[tablet.ask(number, orders[number % len(orders)], one, rng)] += 1
    return ends


def _told(study: Study, count: int, seed: int) -> Told:
    of = "onsite" if study.design.kind == "onsite" else "online"
    cells = cells_of(study.site, studies=(of,))
    rates = parse_rates("published")
    wanted = {each.route for each in study.design.routes}
    return {
        (cell.route, cell.iteration): [
            write_texts(outline, paired=False)[0]
            for outline in sample_outlines(cell, rates, count, seed)
        ]
        for cell in cells
        if cell.route in wanted
    }


@contextmanager
def _visiting(
    study: Study, address: str, clock: _Clock, rng: np.random.Generator
) -> "Generator[_Visitor]":
    # A robot to drive is set up before it answers.
    with httpx2.Client(
        base_url=address, follow_redirects=True, timeout=LONGEST_WAIT
    ) as client:
        yield _Visitor(study, client, clock, rng)


class _Visitor:
    """One made-up participant, who reads the pages as they are."""

    def __init__(
        self,
        study: Study,
        client: httpx2.Client,
        clock: _Clock,
        rng: np.random.Generator,
    ) -> None:
        self._design = study.design
        self._client = client
        self._clock = clock
        self._rng = rng
        self._page = ""
        self.texts: dict[tuple[str, int], str] = {}
        self._understands = rng.random() >= MISUNDERSTANDS

    def take_part(self, name: str) -> str:
        """Go from consent to an end; return which."""
        ids = dict.fromkeys(self._design.platform_ids, name)
        self._page = self._client.get("/", params=ids).text
        consent = {f"consent.{n}": "on" for n in range(len(self._design.consent))}
        self._send(
            "/consent", consent | {f"id.{key}": each for key, each in ids.items()}
        )
        for _ in range(MOST_PAGES):
            action = re.search(
                r'<form method="post" action="/study/([\w.-]+)"', self._page
            )
            if action is None:
                return self._ending()
            if self._rng.random() < LEAVES:
                return "left"
            self._clock.skip(float(self._rng.uniform(5, 20)))
            kind, _, about = action[1].partition(".")
            self._send(f"/study/{action[1]}", self._answer(kind, about))
        raise StudyError(
            f"made-up participant {name}: expected an end within {MOST_PAGES} pages, got "
            "none; this is a fault of memorymaze"
        )

    def _ending(self) -> str:
        codes = self._design.codes
        ends = {
            "finished": codes.complete,
            "excluded": codes.excluded,
            "full": codes.full,
        }
        for end, code in ends.items():
            if f'<strong class="code">{code}</strong>' in self._page:
                return end
        raise StudyError(
            "made-up participant: expected a page with a code, got another"
        )

    def _answer(self, kind: str, about: str) -> dict[str, str]:
        design = self._design
        match kind:
            case "comprehension":
                # Who misunderstood has read it again the next time.
                right, self._understands = self._understands, True
                attempt = re.findall(r'name="(attempt)" value="(\d+)"', self._page)
                return dict(attempt) | {
                    f"answer.{n}": _choice(question, right)
                    for n, question in enumerate(design.comprehension.questions)
                }
            case "familiarity":
                asked = design.familiarity
                excluded = bool(asked.excluded) and self._rng.random() < KNOWS_THE_PLACE
                chosen = next(
                    n
                    for n, choice in enumerate(asked.choices)
                    if (choice in asked.excluded) == excluded
                )
                return {"answer.0": str(chosen)}
            case "attention":
                right = bool(self._rng.random() >= FAILS_ATTENTION)
                return {"answer.0": _choice(design.attention[int(about)], right)}
            case "watch":
                self._watch(f"watch.{about}")
                return {}
            case "wait":
                self._clock.skip(60 * (design.delay_minutes or 0))
                return {}
            case "tell" | "retell":
                if kind == "tell" and design.kind == "online":
                    self._watch(f"tell.{about}")
                return {"text": self._text(about, 1 if kind == "tell" else 2)}
            case "follow":
                return self._drive(about)
            case _:
                return {}

    def _drive(self, route: str) -> dict[str, str]:
        """Go on, and turn somewhere where the robot does not, for some time."""
        robot = f"/robot/follow.{route}"
        told = json.loads(self._client.get(robot).text)
        for number in range(int(self._rng.integers(*COMMANDS))):
            if told.get("over"):
                return {}
            self._clock.skip(1.0)
            command = "forward"
            if told["answer"]:
                command = str(self._rng.choice(["left", "right", "around"]))
            sent = {"number": str(number), "command": command}
            told = json.loads(self._send(robot, sent))
        sure = self._rng.choice([value for value, _ in SURE])
        return {
            "said": str(self._rng.choice(["arrived", "gave_up"])),
            "sure": str(sure),
        }

    def _text(self, route: str, iteration: int) -> str:
        text = self.texts[route, iteration]
        self._clock.skip(word_count(text) / WORDS_A_SECOND)
        while word_count(text) < self._design.least_words:
            text = f"{text} {text}"
        return text

    def _watch(self, step: str) -> None:
        for look in range(int(self._rng.integers(1, 4))):
            seconds = float(self._rng.uniform(*ROUTE_SECONDS))
            if look:
                self._send(f"/event/{step}", {"kind": "again", "value": "0"})
            self._send(f"/event/{step}", {"kind": "play", "value": "0"})
            self._clock.skip(seconds)
            self._send(f"/event/{step}", {"kind": "ended", "value": f"{seconds:.1f}"})

    def _send(self, address: str, fields: dict[str, str]) -> str:
        token = re.search(r'<meta name="csrf-token" content="(\w+)">', self._page)
        assert token is not None  # every page has it
        sent = self._client.post(address, data={"csrf_token": token[1], **fields})
        if sent.status_code >= 500:
            raise StudyError(f"{address}: expected a page, got code {sent.status_code}")
        if sent.headers.get("content-type", "").startswith("text/html"):
            self._page = sent.text
        return sent.text


def _choice(question: CheckedQuestion, right: bool) -> str:
    return str(
        next(
            number
            for number, choice in enumerate(question.choices)
            if (choice == question.answer) == right
        )
    )
