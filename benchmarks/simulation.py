"""How much faster than real time the simulation runs on one core, without pictures.

Seconds are of processor time, so that other work on the machine counts less. The
baseline is the physics engine alone, with the same building and robot; of the episodes
without physics, the same ones with it.
"""

import time
from collections.abc import Callable

import numpy as np

from benchmarks.measuring import Row, best_ms
from memorymaze.robot.simulation.motion.wheeled_base import WheeledBase
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.settings import RunSettings
from memorymaze.runs.work.episode_worker import (
    EpisodeDone,
    EpisodeTask,
    EpisodeWorker,
)
from memorymaze.world.sites import (
    BUILTIN_SITE_NAMES,
    Route,
    Site,
    load_site,
)

PHYSICS_ALONE = "mj_step alone, the robot driving back and forth"
REPEATS = 3
EPISODES = 12


def run() -> list[Row]:
    rows: list[Row] = []
    for name in BUILTIN_SITE_NAMES:
        site = load_site(name)
        floor_area = site.walkable_floor.area
        rows.append(
            Row(
                f"scene of {name} ({floor_area:.0f} m2) from its plan",
                best_ms(lambda site=site: from_plan(site), 3),
                "ms",
                target=2000.0,
            )
        )
        scene = build_scene(site)
        physics = real_time_ratio(lambda scene=scene: physics_alone(scene))
        for route in site.routes:
            if route.role == "reference":
                rows += drives(scene, route, physics)
    rows += [
        Row(
            f"episodes of the {agent}, motion=kinematic",
            episodes_a_second(agent, "kinematic"),
            "episodes/s",
            episodes_a_second(agent, "physics"),
            "the same episodes, motion=physics",
            higher_is_better=True,
        )
        for agent in ("oracle", "guide")
    ]
    return rows


def episodes_a_second(agent: str, motion: str) -> float:
    """Walk the same episodes twice, and return how many a core does the second time."""
    choices = {"limit": EPISODES, "motion": motion}
    plan = plan_run(agent, settings=with_choices(RunSettings(), choices))
    run = EpisodeWorker.of(plan)()
    seconds = 0.0
    for _ in range(2):
        began = time.process_time()
        for episode in plan.episodes:
            if not isinstance(run(EpisodeTask(episode)), EpisodeDone):
                raise AssertionError(f"{episode.id}: ended without a result")
        seconds = time.process_time() - began
    return len(plan.episodes) / seconds


def from_plan(site: Site) -> Scene:
    """Read the plan and build all that a robot needs to drive."""
    scene = build_scene(load_site(site.source))
    SimulatedRobot(scene, site.routes[0].start).move_forward(0.01)
    return scene


def drives(scene: Scene, route: Route, physics: float) -> list[Row]:
    where = f"{scene.site.name} {route.route}"
    return [
        Row(
            f"{where}: along the reference route",
            real_time_ratio(lambda: along_line(scene, route)),
            "x real time",
            physics,
            PHYSICS_ALONE,
            target=200.0,
            higher_is_better=True,
        ),
        Row(
            f"{where}: half-metre moves, looking for ways each time",
            real_time_ratio(lambda: step_by_step(scene, route)),
            "x real time",
            physics,
            PHYSICS_ALONE,
            target=200.0,
            higher_is_better=True,
        ),
    ]


def real_time_ratio(drive: Callable[[], float]) -> float:
    """Return the simulated seconds per second of one core; the best of some drives."""
    best = 0.0
    for _ in range(REPEATS):
        began = time.process_time()
        simulated = drive()
        best = max(best, simulated / (time.process_time() - began))
    return best


def physics_alone(scene: Scene) -> float:
    base = WheeledBase(
        scene.model,
        scene.site.routes[0].start,
        SimulationSettings(wheel_noise=0.0),
        np.random.default_rng(0),
    )
    for decision in range(1200):
        base.drive(0.4 if decision % 80 < 40 else -0.4, 0.0, steps=5)
    return base.time


def along_line(scene: Scene, route: Route) -> float:
    robot = SimulatedRobot(scene, route.start)
    robot.follow(route.line.coords)
    if robot.collisions:
        raise AssertionError(f"{route.id}: {len(robot.collisions)} collisions")
    return robot.time


def step_by_step(scene: Scene, route: Route) -> float:
    """Walk ahead, and around at every end, as far as the route is long."""
    robot = SimulatedRobot(scene, route.start)
    while robot.distance_travelled() < route.length:
        robot.detect_turning_point()
        if robot.move_forward(0.5).reason != "done":
            robot.turn("around")
    return robot.time
