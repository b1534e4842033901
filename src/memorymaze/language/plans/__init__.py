"""What a description of a way says, as records that readers and writers share.

Holds the records of the plan language, their files and their words in plain English. Does
not hold how they are read from texts (`reading`), how texts are made of them
(`writing`) or how one walks with them (`agents`).
"""

from memorymaze.language.plans.describing import describe
from memorymaze.language.plans.files import (
    load_plans,
    parse_plan,
    plan_lines,
    plan_record,
)
from memorymaze.language.plans.records import (
    SECOND_METRES,
    STEP_METRES,
    Arrival,
    Junction,
    Kind,
    Leg,
    Length,
    Mention,
    Passing,
    Place,
    RoutePlan,
    Side,
    Start,
    Totals,
    Turn,
    Unit,
    Way,
)

__all__ = [
    "SECOND_METRES",
    "STEP_METRES",
    "Arrival",
    "Junction",
    "Kind",
    "Leg",
    "Length",
    "Mention",
    "Passing",
    "Place",
    "RoutePlan",
    "Side",
    "Start",
    "Totals",
    "Turn",
    "Unit",
    "Way",
    "describe",
    "load_plans",
    "parse_plan",
    "plan_lines",
    "plan_record",
]
