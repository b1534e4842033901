"""Who does what in which order: orders of routes, and the steps of a participant."""

from typing import Literal, cast

from memorymaze.web.studies.study_file import StudyDesign

StepKind = Literal[
    "consent",
    "comprehension",
    "familiarity",
    "scenario",
    "watch",
    "wait",
    "tell",
    "mark",
    "told",
    "retell",
    "follow",
    "attention",
    "done",
]

TELLINGS = ("tell", "retell")
"""Kinds of the first and the second description of a route."""


class StudyStep(str):
    """One page that a participant answers: `scenario`, `tell.R1`, `attention.0`.

    It is what its answer is kept under.
    """

    __slots__ = ()

    @classmethod
    def of(cls, kind: str, about: str | int = "") -> "StudyStep":
        """Return the step of a kind about a route, or an attention check's number."""
        return cls(f"{kind}.{about}".rstrip("."))

    @property
    def kind(self) -> StepKind:
        """What is done on it."""
        return cast(StepKind, self.partition(".")[0])

    @property
    def about(self) -> str:
        """The route, or the number of the attention check from 0; empty for neither."""
        return self.partition(".")[2]

    @property
    def route(self) -> str:
        """The route it is about; empty where it is about none."""
        return "" if self.kind == "attention" else self.about


def route_orders(design: StudyDesign) -> list[tuple[str, ...]]:
    """Return the orders of routes, each a cell of the study.

    They are a balanced Latin square (Williams 1949): each route comes equally often at
    each place, and follows each other one equally often. Where a participant describes
    some of the routes only, it is cut.
    """
    names = [each.route for each in design.routes]
    count = len(names)
    first = [(step + 1) // 2 * (-1) ** (step + 1) % count for step in range(count)]
    rows = [[(place + shift) % count for place in first] for shift in range(count)]
    if count % 2:
        rows += [row[::-1] for row in rows]
    orders = [tuple(names[place] for place in row) for row in rows]
    cut = [order[: design.number_of_routes] for order in orders]
    return list(dict.fromkeys(cut))


def cell_name(order: tuple[str, ...]) -> str:
    """Return what an order of routes is called, such as `R2, R1`."""
    return ", ".join(order)


def steps_of(design: StudyDesign, order: tuple[str, ...]) -> list[StudyStep]:
    """Return what somebody answers who describes, or follows, routes in an order.

    Interviews (`onsite`) have steps of their own, which the tablet's script knows.
    """
    steps = list(map(StudyStep, ("comprehension", "familiarity", "scenario")))
    if not design.comprehension.questions:
        del steps[0]
    for place, route in enumerate(order, start=1):
        if design.kind == "memory":
            steps.append(StudyStep.of("watch", route))
            if design.delay_minutes:
                steps.append(StudyStep.of("wait", route))
        kinds = ("follow",) if design.kind == "follow" else TELLINGS
        steps += [StudyStep.of(kind, route) for kind in kinds]
        steps += [
            StudyStep.of("attention", number)
            for number, check in enumerate(design.attention)
            if check.after_route == place
        ]
    return steps
