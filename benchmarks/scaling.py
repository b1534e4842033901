"""How many episodes are done in a second by one and two workers, here and by Ray.

Every figure is of whole runs, with their folders, over one fixed sample of the shipped
instructions: once from the first result to the last (`episodes`), which a long run
comes close to, and once from the beginning on (`with start-up`). The baseline is one local worker. Processor time and memory of a worker are
measured beside it. Run it on a machine that does nothing else.
"""

import io
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Generator
from contextlib import contextmanager, redirect_stderr
from pathlib import Path

from benchmarks.measuring import Row
from memorymaze.basics.extras import is_installed
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.local_workers import LocalWorkforce
from memorymaze.runs.work.worker_pool import Workforce
from memorymaze.world.sites import BUILTIN_SITE_NAMES

EPISODES = int(os.environ.get("MEMORYMAZE_SCALING_EPISODES", "96"))
"""Of each agent; a small number gives a rough look."""

NEAR_LINEAR = 1.8
"""Times one worker's throughput that two are to have, on a machine with two cores."""

AGENTS = ("guide", "oracle")

# The first episode on a site costs more than it does again, by the start-up of a worker.
ONE_WORKER = """
import sys, time
began = time.process_time()
from memorymaze.runs.work.episode_worker import EpisodeTask, EpisodeWorker
from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.settings import AgentSettings
plan = plan_run(AgentSettings("guide"))
site = sys.argv[1]
episode = next(e for e in plan.episodes if e.instruction.site == site)
do = EpisodeWorker(plan.settings, {site: plan.sites[site]})()
do(EpisodeTask(episode))
first = time.process_time() - began
began = time.process_time()
do(EpisodeTask(episode))
second = time.process_time() - began
# Not ru_maxrss, which begins with that of the process we come from.
status = dict(line.split(":", 1) for line in open("/proc/self/status"))
print(first - second, int(status["VmHWM"].split()[0]) / 1024)
"""


def run() -> list[Row]:
    rows: list[Row] = []
    for agent in AGENTS:
        plan = plan_run(AgentSettings(agent), settings=RunSettings(limit=EPISODES))
        before = children_seconds()
        alone, alone_whole = throughput(plan, LocalWorkforce(1))
        cost = (children_seconds() - before) / len(plan.episodes)
        what = f"{agent}, {len(plan.episodes)} episodes"
        rows += [
            Row(f"{what}: processor time of one", cost * 1e3, "ms"),
            *two_rows(f"{what}, 1 local worker", (alone, alone_whole)),
        ]
        base = (alone, alone_whole)
        figures = throughput(plan, LocalWorkforce(2))
        rows += two_rows(f"{what}, 2 local workers", figures, base, NEAR_LINEAR)
        for workers in (1, 2):
            with ray_workforce(workers) as cluster:
                if cluster is None:
                    break
                figures = throughput(plan, cluster)
            target = NEAR_LINEAR if workers == 2 else None
            name = f"{what}, {workers} worker{'s' * (workers > 1)} on Ray"
            rows += two_rows(name, figures, base, target)
    return rows + [row for name in BUILTIN_SITE_NAMES for row in one_worker(name)]


def two_rows(
    name: str,
    figures: tuple[float, float],
    baseline: tuple[float | None, float | None] = (None, None),
    target: float | None = None,
) -> list[Row]:
    """Return rows for long runs, which have a target, and for this one as it was."""
    steady, whole = figures
    goal = None if target is None or baseline[0] is None else target * baseline[0]
    unit, what = "/s", "" if baseline[0] is None else "1 local worker"
    return [
        Row(f"{name}: episodes", steady, unit, baseline[0], what, goal, True),
        Row(f"{name}: with start-up", whole, unit, baseline[1], what, None, True),
    ]


def throughput(plan: RunPlan, workforce: Workforce) -> tuple[float, float]:
    """Return episodes per second from the first result to the last, and over all."""
    began = time.time()
    with tempfile.TemporaryDirectory() as folder, redirect_stderr(io.StringIO()):
        results = run_plan(plan, folder, workers=workforce)
        # A trace is written as its episode ends, before its result.
        written = [path.stat().st_mtime for path in Path(folder, "traces").iterdir()]
    first, last = min(written), max(written)
    figures = (len(results) - 1) / (last - first), len(results) / (last - began)
    print(
        f"  {plan.settings.agent.name}, {workforce}: {figures[0]:.2f} /s, with start-up "
        f"{figures[1]:.2f} /s",
        file=sys.stderr,
    )
    return figures


@contextmanager
def ray_workforce(workers: int) -> Generator[Workforce | None]:
    """Start a Ray cluster on this machine; None where Ray is not installed."""
    if not is_installed("ray"):
        print("scaling: ray is not installed; its rows are left out", file=sys.stderr)
        yield None
        return
    from memorymaze.runs.work.ray_workers import open_ray_cluster

    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    # Ray's workers give way to all others by default, which local ones do not.
    os.environ.setdefault("RAY_worker_niceness", "0")
    with open_ray_cluster("local", workers) as cluster:
        yield cluster


def one_worker(site: str) -> list[Row]:
    done = subprocess.run(
        [sys.executable, "-c", ONE_WORKER, site],
        check=True,
        capture_output=True,
        text=True,
    )
    starting, memory = map(float, done.stdout.split())
    return [
        Row(f"worker on {site}: start-up, processor time", starting, "s"),
        Row(f"worker on {site}: memory at most", memory, "MB"),
    ]


def children_seconds() -> float:
    """Return the processor time of all processes that this one started and saw end."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
