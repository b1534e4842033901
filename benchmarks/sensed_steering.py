"""How agents walk on a robot that knows no plan: its LiDAR and odometry alone steer it.

`python -m benchmarks.sensed_steering [--agents NAME …] [--limit N] [--obstacles SETTINGS]
[--noise SETTINGS]` has each agent follow the same texts three times: with the plan, with the
plan's ways but turning points by LiDAR, and with nothing but what the simulated body tells
through `SensorsAndMotion`. Detector and reader of signs are those that know the truth each time.
"""

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.episode import run_episode
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings

AGENTS = ("guide", "examples/right_hand.py:RightHand")


@dataclass(frozen=True)
class Known:
    """What a robot knows of the floor."""

    name: str
    choices: dict[str, str]
    plan: bool = True


KNOWN = (
    Known("the plan", {}),
    Known("the plan's ways, turning points by LiDAR", {"turning_points": "lidar"}),
    Known("LiDAR and odometry alone", {}, plan=False),
)
COLUMNS = {
    "success": "SR",
    "oracle_success": "OSR",
    "path_length": "metres",
    "collisions": "collisions",
    "person_collisions": "with people",
    "duration_s": "seconds",
}


def walked(plan: RunPlan, known: Known) -> list[EpisodeResult]:
    make_robot: Callable[..., SimulatedRobot] = SimulatedRobot
    if not known.plan:
        make_robot = partial(SimulatedRobot, knows_plan=False)
    obstacles, noise = plan.settings.obstacles, plan.settings.noise
    arenas = {
        name: Arena(site, obstacles, make_robot=make_robot, noise=noise)
        for name, site in plan.sites.items()
    }
    results: list[EpisodeResult] = []
    for episode in plan.episodes:
        arena = arenas[episode.instruction.site]
        run = run_episode(plan.ready.in_episode(episode), episode, arena, plan.settings)
        results.append(run.result)
        told = {name: getattr(run.result, name) for name in COLUMNS}
        print(known.name, episode.id, run.result.stopped_by, told, file=sys.stderr)
    return results


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.sensed_steering")
    parser.add_argument("--agents", nargs="+", default=AGENTS)
    parser.add_argument("--limit", type=int, default=24)
    parser.add_argument("--obstacles")
    parser.add_argument("--noise")
    parser.add_argument("--only", type=int, choices=range(3))
    options = parser.parse_args()
    print("agent | knows | episodes |", " | ".join(COLUMNS.values()))
    for agent in options.agents:
        for number, known in enumerate(KNOWN):
            if options.only not in (None, number):
                continue
            choices = dict(known.choices)
            if options.obstacles:
                choices["obstacles"] = options.obstacles
            if options.noise:
                choices["noise"] = options.noise
            settings = with_choices(RunSettings(limit=options.limit), choices)
            plan = plan_run(AgentSettings(agent), None, settings)
            results = walked(plan, known)
            means = [
                f"{np.mean([float(getattr(each, name)) for each in results]):.2f}"
                for name in COLUMNS
            ]
            print(agent, known.name, len(results), *means, sep=" | ", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
