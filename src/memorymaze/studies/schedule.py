"""Who does what in which order: orders of routes, and the steps of a participant."""

from dataclasses import dataclass
from typing import Literal

from memorymaze.studies.study_file import StudyDesign

StepKind = Literal[
    "comprehension",
    "familiarity",
    "scenario",
    "watch",
    "wait",
    "tell",
    "retell",
    "follow",
    "attention",
]


@dataclass(frozen=True, slots=True)
class StudyStep:
    """One page that a participant answers."""

    kind: StepKind
    route: str = ""
    """Which it is about; empty where it is about none."""
    number: int = 0
    """Of the attention check, from 0."""

    @property
    def key(self) -> str:
        """What its answer is kept under; parts joined by dots."""
        about = self.route or (str(self.number) if self.kind == "attention" else "")
        return f"{self.kind}.{about}".rstrip(".")


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
    steps = [
        StudyStep("comprehension"),
        StudyStep("familiarity"),
        StudyStep("scenario"),
    ]
    if not design.comprehension.questions:
        del steps[0]
    for place, route in enumerate(order, start=1):
        if design.kind == "memory":
            steps.append(StudyStep("watch", route))
            if design.delay_minutes:
                steps.append(StudyStep("wait", route))
        if design.kind == "follow":
            steps.append(StudyStep("follow", route))
        else:
            steps += [StudyStep("tell", route), StudyStep("retell", route)]
        steps += [
            StudyStep("attention", number=number)
            for number, check in enumerate(design.attention)
            if check.after_route == place
        ]
    return steps
