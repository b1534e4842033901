"""Study files: what people are shown and asked, as TOML; reading and beginning one.

What a wrong file says names line and field.
"""

import os
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Literal, Self, get_args

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    model_validator,
)
from shapely import Point

from memorymaze.basics.durable_files import write_new
from memorymaze.basics.errors import (
    SettingsError,
    SitePlanError,
    StudyError,
)
from memorymaze.basics.input_files import (
    field_problem,
    read_toml,
    refusal,
)
from memorymaze.texts.corpus.records import Text
from memorymaze.world.sites import BUILTIN_SITE_NAMES, Route, Site, load_site

StudyKind = Literal["online", "memory", "onsite", "follow"]
STUDY_KINDS: tuple[StudyKind, ...] = get_args(StudyKind)

BY_THEMSELVES = ("platform_ids", "codes", "comprehension")
"""What only people who take part by themselves need."""
UNCHANGED = "PLEASE CHANGE"
"""What the contact of a new study file begins with."""
TEMPLATE = Path(__file__).parent / "data" / "study.toml"
_Text = Annotated[Text, AfterValidator(str.strip)]


class _Part(BaseModel):
    model_config = ConfigDict(
        strict=True, extra="forbid", frozen=True, allow_inf_nan=False
    )


class ChoiceQuestion(_Part):
    """A question with choices."""

    text: _Text
    choices: Annotated[list[_Text], Field(min_length=2, max_length=12)]

    @model_validator(mode="after")
    def _differ(self) -> Self:
        if len(set(self.choices)) != len(self.choices):
            raise ValueError("expected choices that differ")
        return self


class CheckedQuestion(ChoiceQuestion):
    """A question that has a right answer."""

    answer: _Text

    @model_validator(mode="after")
    def _is_a_choice(self) -> Self:
        if self.answer not in self.choices:
            raise ValueError(f"expected an answer among the choices {self.choices}")
        return self


class Comprehension(_Part):
    """What shows that somebody has understood the task."""

    attempts: Annotated[int, Field(ge=1, le=10)]
    questions: Annotated[list[CheckedQuestion], Field(max_length=10)]


class Familiarity(ChoiceQuestion):
    """How well somebody knows the place."""

    excluded: list[_Text]
    """Answers of people who are thanked and let go."""

    @model_validator(mode="after")
    def _are_choices(self) -> Self:
        for each in self.excluded:
            if each not in self.choices:
                raise ValueError(
                    f"expected excluded answers among the choices {self.choices}, got "
                    f"{each!r}"
                )
        if len(self.excluded) == len(self.choices):
            raise ValueError("expected a choice that is not excluded")
        return self


class AttentionCheck(CheckedQuestion):
    """A question that only shows whether somebody reads."""

    after_route: Annotated[int, Field(ge=1)]
    """It comes after this many routes."""


class Codes(_Part):
    """What people bring back to the platform that sent them."""

    complete: _Text
    excluded: _Text
    full: _Text
    return_address: Annotated[str, Field(pattern=r"^(https://\S+)?$")]
    """Of the platform, with `{code}` for the code; empty for none."""


class RouteShown(_Part):
    """A route that people describe."""

    route: _Text
    video: _Text | None = None
    """A 360-degree video of one's own, seen from the study file; None to make one."""
    start: _Text | None = None
    """What people call the place where it begins; only `onsite`."""


class Walkthrough(_Part):
    """How videos are made."""

    fps: Annotated[float, Field(ge=1, le=60)]
    width: Annotated[int, Field(ge=320, le=4096, multiple_of=4)]
    speed: Annotated[float, Field(ge=0.1, le=20)]


class FollowedTexts(_Part):
    """Which texts people follow in a study of the kind `follow`."""

    instructions: list[_Text]
    """Instruction files, seen from the study file; none for the shipped texts."""
    limit: Annotated[int, Field(ge=1)] | None = None
    """How many of the texts, alike many of every route; None for all."""
    robot: _Text | None = None
    """Whose body they drive, as `evaluate --robot` takes it; None for the simulated one. Walks
    are driven once more for what is exported, so it is one of a simulator."""
    read_aloud: bool
    """Whether the browser offers to read a text aloud."""


class Interview(_Part):
    """What a study of the kind `onsite` has beyond the others."""

    errors_found: _Text
    """Said before the errors of a description."""
    no_errors: _Text
    """Said where there are none."""
    recogniser: _Text | None = None
    """A command that gets the path of a recording and prints what was said."""


class StudyDesign(_Part):
    """Everything in a study file."""

    format: Literal[1]
    name: _Text
    kind: StudyKind
    language: Annotated[str, Field(pattern=r"^[a-z]{2,3}(-[A-Za-z0-9]+)*$")]
    site: _Text
    contact: _Text
    keep_months: Annotated[int, Field(ge=1, le=600)]
    quota: Annotated[int, Field(ge=1, le=100_000)]
    """Participants who finish, for each order of routes."""
    routes_each: Annotated[int, Field(ge=1)] | None = None
    """Routes that one participant describes; None for all."""
    held_minutes: Annotated[int, Field(ge=5, le=100_000)]
    """How long a place is kept for somebody who does not go on."""
    least_words: Annotated[int, Field(ge=1, le=1000)] = 1
    delay_minutes: Annotated[float, Field(ge=0, le=600)] | None = None
    """Between the video and the description; only `memory`."""
    platform_ids: list[Annotated[str, Field(pattern=r"^[A-Za-z0-9_]{1,40}$")]] = []
    introduction: _Text
    consent: Annotated[list[_Text], Field(min_length=1)]
    scenario: _Text
    task: _Text
    robot: _Text = ""
    """What people are told between their two descriptions: the treatment."""
    second_task: _Text = ""
    thanks: _Text
    excluded_thanks: _Text
    codes: Codes = Codes(complete="-", excluded="-", full="-", return_address="")
    comprehension: Comprehension = Comprehension(attempts=1, questions=[])
    familiarity: Familiarity
    attention: list[AttentionCheck] = []
    walkthrough: Walkthrough = Walkthrough(fps=10, width=1280, speed=1)
    follow: FollowedTexts | None = None
    """Of the kind `follow`, which has nothing to describe."""
    interview: Interview | None = None
    """Of the kind `onsite`."""
    routes: Annotated[list[RouteShown], Field(min_length=1, max_length=20)]

    @model_validator(mode="after")
    def _agree(self) -> Self:
        self._check_texts()
        if (self.delay_minutes is None) == (self.kind == "memory"):
            raise ValueError(
                "expected delay_minutes for the kind memory and for no other, got "
                f"{self.delay_minutes} for {self.kind}"
            )
        if self.routes_each is not None and self.routes_each > len(self.routes):
            raise ValueError(
                f"expected routes_each of at most {len(self.routes)}, the number of "
                f"routes, got {self.routes_each}"
            )
        for check in self.attention:
            if check.after_route > self.number_of_routes:
                raise ValueError(
                    f"expected attention checks after at most {self.number_of_routes} "
                    f"routes, got after_route = {check.after_route}"
                )
        names = [each.route for each in self.routes]
        if len(set(names)) != len(names):
            raise ValueError(f"expected each route once, got {', '.join(names)}")
        return self

    def _check_texts(self) -> None:
        """See that there is what the kind needs to show."""
        self._check_interview()
        if (self.follow is None) == (self.kind == "follow"):
            found = "none" if self.follow is None else "one"
            raise ValueError(
                "expected a table [follow] for the kind follow and for no other, got "
                f"{found} for {self.kind}"
            )
        if self.kind == "follow":
            if self.robot or self.second_task:
                raise ValueError(
                    "expected neither robot nor second_task for the kind follow, whose "
                    "participants describe nothing"
                )
            return
        if not self.robot:
            raise ValueError("expected a text robot, got none")
        for name in ("task", "second_task"):
            if "{destination}" not in getattr(self, name):
                raise ValueError(f"expected {{destination}} in {name}, got none")

    def _check_interview(self) -> None:
        """See that there is what an experimenter on site needs, and nothing else."""
        if self.kind != "onsite":
            missing = [
                name for name in BY_THEMSELVES if name not in self.model_fields_set
            ]
            if missing:
                raise ValueError(
                    f"expected {', '.join(missing)} for {self.kind}, got none"
                )
            if self.interview or any(each.start for each in self.routes):
                raise ValueError(
                    "expected a table [interview], and start of routes, for the kind "
                    f"onsite only, got them for {self.kind}"
                )
            return
        given = {*BY_THEMSELVES, "attention", "walkthrough"} & self.model_fields_set
        if given or any(each.video for each in self.routes):
            raise ValueError(
                f"expected no {', '.join(sorted(given)) or 'video'} for the kind onsite, "
                "where the experimenter asks people who know the place"
            )
        if self.interview is None:
            raise ValueError(
                "expected a table [interview] for the kind onsite, got none"
            )
        for each in self.routes:
            if each.start is None:
                raise ValueError(
                    f"expected start of {each.route}, what people call the place where "
                    "it begins, for the kind onsite, got none"
                )
        for name in ("{start}", "{destination}"):
            if name not in self.familiarity.text:
                raise ValueError(f"expected {name} in familiarity.text, got none")

    @property
    def number_of_routes(self) -> int:
        """How many routes a participant describes."""
        return self.routes_each or len(self.routes)


_PARTS = (
    StudyDesign,
    RouteShown,
    Walkthrough,
    FollowedTexts,
    Interview,
    Codes,
    AttentionCheck,
    Comprehension,
    Familiarity,
)


@dataclass(frozen=True)
class Study:
    """A study file and the building it is about."""

    path: Path
    text: str
    design: StudyDesign
    site: Site

    @property
    def sha256(self) -> str:
        """Fingerprint of the file."""
        return sha256(self.text.encode()).hexdigest()

    def route(self, name: str) -> Route:
        """Return the reference route of a name such as `R1`."""
        return self.site.find_route(name)

    def data_folder(self) -> Path:
        """Return where answers are kept: beside the file."""
        return self.path.with_suffix(".data")


def load_study(path: str | Path) -> Study:
    """Read a study file; StudyError lists what is wrong, each with line and field."""
    path = Path(path)
    known = {field for part in _PARTS for field in part.model_fields}
    text, design = read_toml(path, StudyDesign, StudyError, known)
    try:
        beside = path.parent / design.site
        site = load_site(beside if beside.is_file() else design.site)
    except (SettingsError, SitePlanError) as error:
        raise StudyError(field_problem(path, text, "site", str(error))) from None
    problems = list(_route_problems(path, text, design, site))
    if problems:
        raise refusal(problems, StudyError)
    return Study(path, text, design, site)


def check_is_changed(study: Study) -> None:
    """Refuse a study for other people whose contact is still the template's."""
    contact = study.design.contact
    if contact.startswith(UNCHANGED):
        said = f"expected who answers questions of participants, got {contact!r}"
        raise StudyError(field_problem(study.path, study.text, "contact", said))


def new_study(path: str | Path, site: Site, kind: StudyKind, plan: str) -> None:
    """Write a study file with comments, on every route of a site; `plan` names the site."""
    from jinja2 import Environment, StrictUndefined

    names = list(dict.fromkeys(route.route for route in site.routes))
    if not names:
        raise SettingsError(
            f"--site {plan}: expected a site with routes, got one without; add routes to "
            "the plan (docs/buildings.md)"
        )
    path = Path(path)
    if plan not in BUILTIN_SITE_NAMES:
        plan = os.path.relpath(plan, path.parent)
    toml = Environment(
        undefined=StrictUndefined, trim_blocks=True, keep_trailing_newline=True
    )
    text = toml.from_string(TEMPLATE.read_text(encoding="utf-8")).render(
        name=path.stem,
        kind=kind,
        plan=plan,
        title=site.title,
        routes={name: _place_near(site, site.find_route(name)) for name in names},
    )
    write_new(path, text.encode())


def _place_near(site: Site, route: Route) -> str:
    """Return a name for where a route begins, for the experimenter to better."""
    begin = Point(route.line.coords[0])
    named = [
        (each.polygon.distance(begin), each.name)
        for each in (*site.rooms, *site.turning_points, *site.corridors, *site.areas)
        if each.name
    ]
    return min(named, default=(0.0, site.title))[1]


def _route_problems(
    path: Path, text: str, design: StudyDesign, site: Site
) -> list[str]:
    problems: list[str] = []
    known = sorted({route.route for route in site.routes})
    for number, shown in enumerate(design.routes):
        if shown.route not in known:
            said = f"expected one of {', '.join(known)}, got {shown.route!r}"
            problems.append(field_problem(path, text, f"routes[{number}].route", said))
        if shown.video is not None and not (path.parent / shown.video).is_file():
            said = f"expected a video file that is there, got {shown.video!r}"
            problems.append(field_problem(path, text, f"routes[{number}].video", said))
    return problems
