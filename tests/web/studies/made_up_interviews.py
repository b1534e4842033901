"""Made-up interviews: what a tablet would send, through the same addresses.

Those with an even number are recorded and written down, the others are typed.
"""

import re
from collections.abc import Callable, Mapping
from typing import Protocol

import httpx2
import numpy as np

from memorymaze.basics.errors import StudyError
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.corpus.statistics import word_count
from memorymaze.web.studies.study_file import Study
from memorymaze.web.studies.tellings import TELLINGS

SPOKEN_WORDS_A_SECOND = 2.5
LEAVES = 0.01
"""At each step."""
KNOWS_BOTH = 0.9
NAME = "made-up listener"
LABELLERS = ("made-up first", "made-up second")
"""They always agree: both know what the generator did."""


class Clock(Protocol):
    """The time, which passes at no cost."""

    def now(self) -> float:
        """Return seconds since 1970."""
        ...

    def skip(self, seconds: float) -> None:
        """Let time pass."""
        ...


class MadeUpTablet:
    """A tablet of an experimenter who asks made-up people."""

    def __init__(
        self, study: Study, client: httpx2.Client, entrance: str, clock: Clock
    ) -> None:
        """Open the experimenter's address as a tablet does."""
        self._study = study
        self._design = study.design
        self._client = client
        self._clock = clock
        client.get(entrance)
        page = client.get("/interview").text
        token = re.search(r'<meta name="csrf-token" content="(\w+)">', page)
        assert token is not None  # every page has it
        self._token = token[1]
        self._who = ""
        self._records = False
        self._sent = 0
        self._said = ""

    def ask(
        self,
        number: int,
        cell: str,
        told: Mapping[tuple[str, int], Instruction],
        rng: np.random.Generator,
    ) -> str:
        """Interview somebody; return how it ended."""
        self._who, self._sent = f"p{number:04x}{rng.integers(16**6):06x}", 0
        self._records = number % 2 == 0
        routes = cell.split(", ")
        consent = "\n\n".join(self._design.consent)
        self._send("consent", cell=cell, shown=consent)
        knows = rng.random() < KNOWS_BOTH or not self._design.familiarity.excluded
        for route in routes:
            self._send(f"familiarity.{route}", text=self._answer(knows))
            if not knows:
                return "excluded"
        self._send("scenario", shown=self._design.scenario)
        steps: list[Callable[[], None]] = []
        for route in routes:
            first, second = told[route, 1], told[route, 2]
            steps += [
                lambda route=route, first=first: self._tell(f"tell.{route}", first),
                lambda route=route, first=first: self._discuss(route, first),
                lambda route=route, second=second: self._tell(
                    f"retell.{route}", second
                ),
            ]
        for step in steps:
            if rng.random() < LEAVES:
                return "left"
            step()
        self._send("done")
        for route, iteration in told:
            if route in routes:
                step = f"{TELLINGS[iteration - 1]}.{route}"
                self._label(step, told[route, iteration])
        return "finished"

    def _answer(self, knows: bool) -> str:
        asked = self._design.familiarity
        return next(each for each in asked.choices if (each in asked.excluded) != knows)

    def _tell(self, step: str, told: Instruction) -> None:
        text = told.text
        while word_count(text) < self._design.least_words:
            text = f"{text} {text}"
        seconds = word_count(text) / SPOKEN_WORDS_A_SECOND
        again = step.startswith("retell.")
        shown = self._said if again else self._design.task
        if not self._records:
            self._send(step, seconds, text=text, shown=shown)
            return
        self._send(step, seconds, recorded="yes", shown=shown)
        self._post(
            f"/interviews/{self._who}/recordings/{self._record()}",
            params={
                "step": f"voice.{step}",
                "seconds": f"{seconds:.1f}",
                **self._times(),
            },
            content=b"RIFF of: " + text.encode(),
            media_type="audio/wav",
        )
        # Whoever listens writes the same; a recogniser of the study is not awaited.
        address = f"/transcripts/{self._who}/{step}"
        self._post(address, data={"text": text, "name": NAME})

    def _discuss(self, route: str, told: Instruction) -> None:
        """Mark the errors that the generator made, and tell them."""
        self._send(f"mark.{route}", 5.0, **self._marks(route, told))
        interview = self._design.interview
        assert interview is not None
        errors = [f"- {each.detail or each.kind}" for each in told.failures]
        text = "\n".join([interview.errors_found, *errors])
        text = text if errors else interview.no_errors
        self._send(f"told.{route}", text=text, shown=self._design.robot)
        self._said = f"{self._design.robot}\n\n{text}"

    def _marks(self, route: str, told: Instruction) -> dict[str, str]:
        """Return the form of what the generator knows of its text."""
        marks = {"way": told.reference_route or self._study.route(route).id}
        for number, failure in enumerate(told.failures):
            marks |= {
                f"kind.{number}": failure.kind,
                # The generator also says `after tp_a_t`.
                f"where.{number}": failure.where.split()[-1],
                f"detail.{number}": failure.detail,
            }
        return marks

    def _label(self, step: str, told: Instruction) -> None:
        marks = self._marks(step.partition(".")[2], told)
        for name in LABELLERS:
            self._post(f"/labels/{self._who}/{step}", data={"name": name, **marks})

    def _send(self, step: str, spent: float = 5.0, **fields: str) -> None:
        address = f"/interviews/{self._who}/records/{self._record()}"
        self._post(address, data={**fields, "step": step, **self._times(spent)})

    def _record(self) -> str:
        self._sent += 1
        return f"{self._who[1:]}-{self._sent:04d}"

    def _times(self, spent: float = 0.0) -> dict[str, str]:
        opened = self._clock.now()
        self._clock.skip(spent)
        return {"opened": str(opened), "at": str(self._clock.now())}

    def _post(
        self,
        address: str,
        *,
        data: Mapping[str, str] | None = None,
        params: Mapping[str, str] | None = None,
        content: bytes | None = None,
        media_type: str | None = None,
    ) -> None:
        headers = {"X-CSRF-Token": self._token}
        if media_type is not None:
            headers["Content-Type"] = media_type
        answer = self._client.post(
            address, data=data, params=params, content=content, headers=headers
        )
        if answer.status_code not in {200, 303}:
            raise StudyError(
                f"{address}: expected that it is taken, got code {answer.status_code}: "
                f"{answer.text[:200]}"
            )
