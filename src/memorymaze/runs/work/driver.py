"""Run episodes on all cores, into a run folder."""

from collections import Counter, deque
from collections.abc import Iterable
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

from memorymaze.basics.errors import MemoryMazeError, SpendingLimitReached
from memorymaze.runs.episodes.plan import RunPlan
from memorymaze.runs.episodes.provenance import code_stamp
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.shards import whole_folder
from memorymaze.runs.episodes.summary import summarise
from memorymaze.runs.work.episode_worker import (
    EpisodeTask,
    EpisodeWorker,
    LimitReached,
    Lost,
)
from memorymaze.runs.work.local_workers import LocalWorkforce
from memorymaze.runs.work.progress import Progress
from memorymaze.runs.work.run_folder import RunFolder, RunRecord, open_run_folder
from memorymaze.runs.work.worker_pool import WorkerPool, Workforce


def run_plan(
    plan: RunPlan,
    folder: str | Path,
    *,
    workers: int | Workforce = 0,
    resume: bool = False,
) -> list[EpisodeResult]:
    """Run all episodes of a plan that have no result yet.

    Results do not depend on the number of workers, nor on where they are, nor on the
    order of episodes, nor on how often the run was broken off. An episode whose worker
    process dies is tried once more, and then recorded as `crash`.

    Each result is on the disk before the next is counted. Workers are so many processes on
    this machine, 0 for one per core (one alone for a robot with a body of its own), or
    others, such as those of a cluster. An episode that
    takes more real seconds than the run's `wall_limit` is given up as `crash`.
    `SpendingLimitReached` and `KeyboardInterrupt` are passed on when all workers have ended.
    """
    whole = whole_folder(Path(folder), plan.settings.shard)
    plan = replace(plan, kept_from=(*plan.kept_from, whole.absolute()))
    workforce = workers if isinstance(workers, Workforce) else LocalWorkforce(workers)
    workforce.check(plan.settings)
    prepare = EpisodeWorker.of(plan)
    path = Path(folder)
    now = datetime.now(UTC).isoformat(timespec="seconds")
    record = RunRecord(settings=plan.settings, code=code_stamp(), started=now)
    told = {each.instruction.id: each.instruction for each in plan.episodes}
    with open_run_folder(
        path,
        record,
        resume=resume,
        sites=plan.sites.values(),
        instructions=told.values(),
    ) as run:
        _check_known(run, plan)
        run.warn_of_lost_traces()
        waiting = [e for e in plan.episodes if e.id not in run.finished]
        queue = _Queue(EpisodeTask(episode) for episode in waiting)
        limit: str | None = None
        with (
            Progress(
                len(plan.episodes),
                len(run.finished),
                successes=sum(each.success for each in run.finished.values()),
            ) as progress,
            WorkerPool(
                workforce.source(prepare, path, len(waiting)), plan.settings.wall_limit
            ) as pool,
        ):
            for task, outcome in pool.run(queue.choose):
                if isinstance(outcome, Lost):
                    queue.put_back(_next_try(task, outcome))
                elif isinstance(outcome, LimitReached):
                    limit = outcome.reason
                    queue.close()
                else:
                    run.add(outcome.result, outcome.trace)
                    progress.count(outcome.result)
        results = [run.finished[key] for key in sorted(run.finished)]
        if results:
            run.write_summary(summarise(results, plan.settings))
    if limit is not None:
        raise SpendingLimitReached(
            f"{limit}. {len(results)} of {len(plan.episodes)} episodes are finished and "
            f"kept in {path}; --resume goes on from there"
        )
    return results


def _check_known(run: RunFolder, plan: RunPlan) -> None:
    unknown = set(run.finished) - {episode.id for episode in plan.episodes}
    if unknown:
        raise MemoryMazeError(
            f"{run.path}: has a result of episode {min(unknown)!r}, which is none of "
            "this run; choose another folder with --out"
        )


def _next_try(task: EpisodeTask, lost: Lost) -> EpisodeTask:
    if task.lost:
        raise MemoryMazeError(
            f"episode {task.episode.id!r} cannot even be recorded as a crash: "
            + (
                f"again {lost.reason}"
                if lost.reason == task.lost
                else f"{lost.reason}, after {task.lost}"
            )
        )
    if task.tries == 0 and not lost.overdue:
        return replace(task, tries=1)
    return replace(task, lost=lost.reason)


class _Queue:
    """Tasks by site, so that a worker stays where it has a scene already."""

    def __init__(self, tasks: Iterable[EpisodeTask]) -> None:
        self._waiting: dict[str, deque[EpisodeTask]] = {}
        self._place: dict[int, str] = {}
        self._closed = False
        for task in tasks:
            self._of(task).append(task)

    def choose(self, worker: int) -> EpisodeTask | None:
        """Take a task on the site a worker is on, or on the one least attended to."""
        open_sites = [site for site, tasks in self._waiting.items() if tasks]
        if self._closed or not open_sites:
            return None
        site = self._place.get(worker)
        if site not in open_sites:
            busy = Counter(self._place.values())
            site = max(
                open_sites,
                key=lambda each: len(self._waiting[each]) / (1 + busy[each]),
            )
            self._place[worker] = site
        return self._waiting[site].popleft()

    def close(self) -> None:
        """Give no further tasks, not even those that are put back."""
        self._closed = True

    def put_back(self, task: EpisodeTask) -> None:
        """Have a task done next on its site."""
        self._of(task).appendleft(task)

    def _of(self, task: EpisodeTask) -> deque[EpisodeTask]:
        return self._waiting.setdefault(task.episode.instruction.site, deque())
