"""Success at several distances from the goal, and after several times the way described."""

from collections.abc import Iterator, Sequence

from memorymaze.runs.metrics.success import (
    SUCCESS_DISTANCE,
    success_within,
    success_within_way,
)
from memorymaze.runs.tables.measures import Quantity
from memorymaze.runs.tables.questions import RowGroup, TableQuestion
from memorymaze.runs.tables.runs import (
    BY_STUDY_AND_RUN,
    MeasuredRun,
    by_study_and_run,
    place_of,
)

WAYS = (1.0, 1.5, 2.0, 3.0)
"""Times the way described."""
KEY = (
    "SR at a distance: stopped by itself, nearer to the goal than so many metres. SR "
    "within so many times the way: a success at the run's own distance that took no "
    "longer path than so many times the way described, and the success distance on top. "
    "All from one run: a search of the whole floor shows as a difference between 1x and "
    "3x. Unweighted mean over routes; [95 % interval], bootstrap over participants."
)


AT_DISTANCES = tuple(
    Quantity(
        f"sr_at_{metres:g}_m",
        f"{metres:g} m",
        of=lambda each, metres=metres: success_within(
            each.spd, metres, is_stopped=each.stopped_by == "agent"
        ),
    )
    for metres in (1.5, 3.0, 5.0)
)
"""Success at so many metres left to the goal."""


def within_ways(near: float) -> list[Quantity]:
    """Return success within so many times the way, for a success distance."""
    return [
        Quantity(
            f"sr_within_{times:g}_ways",
            f"{times:g}x",
            of=lambda each, times=times: success_within_way(
                each.path_length, each.way_m, times, near, is_success=each.success
            ),
            about={"ways": times},
        )
        for times in WAYS
    ]


def _groups(runs: Sequence[MeasuredRun]) -> Iterator[RowGroup]:
    for about, run, results in by_study_and_run(runs):
        near = run.record.settings.success_distance
        yield RowGroup(about, results, [*AT_DISTANCES, *within_ways(near)])


REACH = TableQuestion(
    shows="success at 1.5, 3 and 5 m, and within 1, 1.5, 2 and 3 times the way",
    title="Success by distance to the goal and by length of the walk",
    name="reach",
    columns=(*BY_STUDY_AND_RUN, *AT_DISTANCES, *within_ways(SUCCESS_DISTANCE)),
    groups=_groups,
    cell=place_of,
    key=(KEY,),
)
