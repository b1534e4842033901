"""`NavigationEnvironment`: one building and its instructions as a Gymnasium environment."""

import math
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal

import gymnasium
import numpy as np
from gymnasium.error import ResetNeeded
from numpy.typing import NDArray

from memorymaze.basics.errors import EpisodeOver, SettingsError, did_you_mean
from memorymaze.basics.options import check_number
from memorymaze.gym.actions import ActionSet, action_set, most_steps
from memorymaze.gym.observations import Senses, SensorChoice, senses_of
from memorymaze.gym.rewards import RewardChoice, StepProgress, reward_settings
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.senses.noise import NoiseSettings
from memorymaze.runs.episodes.arena import Arena
from memorymaze.runs.episodes.bodies import BodySettings, find_body
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.settings import RunSettings
from memorymaze.texts.corpus.corpus import episodes
from memorymaze.texts.corpus.files import load_instructions
from memorymaze.texts.corpus.records import Episode, is_of_split
from memorymaze.world.looks import Looks
from memorymaze.world.sites import Site, load_site

Observation = dict[str, Any]
Information = dict[str, Any]
ENVIRONMENTS: dict[str, str | None] = {
    "MemoryMaze/University-v0": "university",
    "MemoryMaze/Museum5F-v0": "museum_5f",
    "MemoryMaze/Museum7F-v0": "museum_7f",
    "MemoryMaze/Site-v0": None,
}
"""Site of each environment; None where the user gives it as `site=`."""
WITHOUT_USE = (
    *("seed", "limit", "shard", "second_telling", "budget_by", "wall_limit"),
    *("ask", "detector", "signs", "isolate"),
    *("detection_range", "turning_points", "call_budget"),
)
"""Settings of a run that mean nothing in an environment."""


def _arena(site: str | Path, settings: RunSettings) -> Arena:
    """Return a site made ready; environments of one process share it."""
    chosen = settings.obstacles, settings.looks, settings.robot, settings.noise
    with suppress(OSError, TypeError):
        return _arena_as_of(site, Path(site).stat().st_mtime_ns, *chosen)
    return _arena_as_of(site, 0, *chosen)


@lru_cache(maxsize=4)
def _arena_as_of(
    site: str | Path,
    changed: int,
    obstacles: ObstacleSettings | None,
    looks: Looks | None,
    robot: BodySettings | None,
    noise: NoiseSettings | None,
) -> Arena:
    plan, body = load_site(site), find_body(robot)
    return Arena(plan, obstacles, looks=looks, body=body, noise=noise)


class NavigationEnvironment(gymnasium.Env[Observation, Any]):
    """Follow an instruction from memory to its destination, and stop there.

    An observation is a dict: `instruction`, and what `sensors` names: `rgb`, `depth`
    in metres, `lidar` ranges in metres (360 rays from straight behind, over the right,
    to the left). It terminates when the agent stops, and is truncated when it has used
    up its steps or keeps on doing nothing. See `docs/simulators.md`.
    """

    # Gymnasium wants a plain dict here, and declares it without ClassVar.
    metadata = {"render_modes": ["rgb_array"], "render_fps": 4}  # noqa: RUF012

    def __init__(
        self,
        site: str | Path,
        *,
        instructions: str | Path | Sequence[str | Path] | None = None,
        route: str | None = None,
        study: str | None = None,
        sensors: SensorChoice = ("rgb",),
        actions: Literal["discrete", "continuous"] | ActionSet = "discrete",
        reward: RewardChoice = "progress",
        max_steps: int | None = None,
        settings: RunSettings | Mapping[str, Any] | None = None,
        privileged: bool = False,
        render_mode: str | None = None,
    ) -> None:
        """Choose what to do; nothing costly is built before the first `reset`.

        Args:
            site: One of the benchmark's sites, or a plan's file.
            instructions: Files; None for the shipped ones, which a language model wrote.
            route: Only episodes of this route, such as `R1`.
            study: Only episodes of this study, `online` or `onsite`.
            sensors: Some of `rgb`, `depth` and `lidar`, or `Senses` with more settings.
            actions: `discrete`, `continuous`, or settings of either.
            reward: `progress`, `sparse`, or settings of its parts.
            max_steps: Steps after which an episode is truncated; None for three times
                what a perfect follower of the site's longest route needs.
            settings: As of a run, or some of them by name: `split`,
                `success_distance`, `time_budget`, `obstacles`, `noise`, `looks`, `robot`
                (a body of your own) and what the robot can do.
            privileged: Whether `info` tells pose, goal and distance to it all along.
            render_mode: None or `rgb_array`.

        Raises:
            SettingsError: Something has no meaning, or no episode is left.
            MemoryMazeError: A file cannot be used.
        """
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise SettingsError(
                f"render_mode: expected None or 'rgb_array', got {render_mode!r}"
            )
        self.render_mode = render_mode
        self.privileged = privileged
        self.settings = _settings_of_an_environment(settings)
        self._arena = _arena(site, self.settings)
        plan = self._arena.site
        self._episodes = choose_episodes(
            plan, instructions, route=route, study=study, split=self.settings.split
        )
        self._senses = senses_of(sensors)
        self._actions = action_set(actions)
        self._reward = reward_settings(reward)
        abilities = self.settings.simulation
        if max_steps is None:
            max_steps = most_steps(self._actions, plan.routes, abilities)
        check_number("max_steps", max_steps, least=1, whole=True)
        self.max_steps = max_steps
        # The steps are the budget here; simulated time is none unless it is asked for.
        self._abilities = replace(
            abilities,
            time_budget=self.settings.time_budget or math.inf,
            call_budget=max_steps + 1,
        )
        self.action_space = self._actions.space
        self.observation_space = self._senses.space(
            each.instruction.text for each in self._episodes
        )
        self._robot: SimulatedRobot | None = None
        self._episode = self._episodes[0]
        self._steps = 0
        self._distance = 0.0
        self._is_over = True

    @property
    def episode_ids(self) -> tuple[str, ...]:
        """Ids of all episodes, for `reset(options={"episode_id": …})`."""
        return tuple(each.id for each in self._episodes)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, Information]:
        """Begin an episode.

        Args:
            seed: The same one gives the same episode and the same wheel noise.
            options: `episode_id` chooses the episode; without it chance does.

        Raises:
            SettingsError: An option is not known, or there is no such episode.
            RenderingError: This machine cannot draw pictures.
        """
        super().reset(seed=seed)
        wanted = dict(options or {})
        drawn = int(self.np_random.integers(len(self._episodes)))
        episode = self._episodes[drawn]
        if "episode_id" in wanted:
            episode = find_episode(self._episodes, wanted.pop("episode_id"))
        if wanted:
            raise SettingsError(
                f"reset: expected no option but 'episode_id', got {sorted(wanted)}"
            )
        self._begin(episode, self.np_random.spawn(1)[0])
        return self._observe(), self._inform()

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, Information]:
        """Do one action.

        Args:
            action: Of the action space.

        Returns:
            Observation, reward, whether the agent stopped, whether the episode is
            broken off, and information: with the metrics once it is over.

        Raises:
            SettingsError: The action is none of the action space.
            ResetNeeded: There is no episode, or it is over.
        """
        robot = self._robot
        if robot is None or self._is_over:
            raise ResetNeeded("the episode is over or has not begun: call reset()")
        if not self.action_space.contains(action):
            raise SettingsError(
                f"action: expected one of {self.action_space}, got {action!r}"
            )
        touched, before = len(robot.collisions), self._distance
        self._steps += 1
        stops = False
        # The robot says why it is over by `stopped_by`.
        with suppress(EpisodeOver):
            stops = self._actions.act(robot, action)
        if stops:
            robot.finish()
        self._distance = self._distance_to_goal(robot)
        terminated = robot.stopped_by == "agent"
        truncated = not terminated and (
            robot.stopped_by is not None or self._steps >= self.max_steps
        )
        self._is_over = terminated or truncated
        information = self._inform()
        progress = StepProgress(
            before - self._distance,
            len(robot.collisions) - touched,
            bool(information.get("success", False)),
        )
        reward = self._reward.of(progress)
        return self._observe(), reward, terminated, truncated, information

    def render(self) -> NDArray[np.uint8] | None:  # type: ignore[override]
        """Return what the camera sees now, (height, width, 3); None without a mode."""
        if self.render_mode is None:
            return None
        robot, senses = self._begun()
        view = robot.camera_view()
        return view.picture(senses.width, senses.height, senses.horizontal_fov).rgb

    def close(self) -> None:
        """Let go of the robot; can be called again."""
        if self._robot is not None:
            self._robot.close()
        self._robot = None
        self._is_over = True

    def _begin(self, episode: Episode, rng: np.random.Generator) -> None:
        self.close()
        self._episode = episode
        self._robot = self._arena.robot(
            episode, self._abilities, rng, lambda event: None
        )
        self._steps = 0
        self._is_over = False
        self._distance = self._distance_to_goal(self._robot)

    def _begun(self) -> tuple[SimulatedRobot, Senses]:
        if self._robot is None:
            raise ResetNeeded("no episode has begun: call reset()")
        return self._robot, self._senses

    def _observe(self) -> Observation:
        robot, senses = self._begun()
        return senses.observe(robot, self._episode.instruction.text)

    def _distance_to_goal(self, robot: SimulatedRobot) -> float:
        return self._arena.grid.distance(robot.pose[:2], self._episode.goal)

    def _inform(self) -> Information:
        robot, _ = self._begun()
        told = self._episode.instruction
        information: Information = {
            "episode_id": self._episode.id,
            "instruction": told.text,
            "instruction_source": told.source,
            "steps": self._steps,
            "time": robot.time,
            "collisions": len(robot.collisions),
        }
        if self.privileged:
            information |= {
                "pose": np.array(robot.pose),
                "goal": np.array(self._episode.goal),
                "reference_path": np.array(self._episode.reference_path),
                "distance_to_goal": self._distance,
            }
        if self._is_over:
            information |= self._score(robot)
        return information

    def _score(self, robot: SimulatedRobot) -> Information:
        ended = robot.stopped_by or "budget"
        walk = self._arena.finished(
            self._episode, robot.trajectory(), ended, self.settings.success_distance
        )
        scores = walk.scores.as_dict()
        return {"stopped_by": ended, "spd": scores.pop("ne"), **scores}


def _settings_of_an_environment(
    given: RunSettings | Mapping[str, Any] | None,
) -> RunSettings:
    """Return the settings that were given, or the defaults; refuse those without a use."""
    settings = given
    if not isinstance(settings, RunSettings):
        settings = with_choices(RunSettings(), settings or {})
    without_use = settings.changed(WITHOUT_USE)
    if without_use:
        raise SettingsError(
            f"settings: an environment has no use for {', '.join(without_use)}: seeds and "
            "episodes are chosen by reset(), budgets are max_steps and time_budget, and "
            "nothing is detected or asked"
        )
    return settings


def choose_episodes(
    site: Site,
    files: str | Path | Sequence[str | Path] | None = None,
    *,
    route: str | None = None,
    study: str | None = None,
    split: str | None = None,
) -> tuple[Episode, ...]:
    """Return the episodes on a site, in the order of the files; there has to be one.

    Files are of instructions; None for the shipped ones. The rest leaves only a route
    such as `R1`, a study (`online` or `onsite`), a split (`dev` or `test`).
    """
    if isinstance(files, str | Path):
        files = [files]
    told = [each for each in load_instructions(files) if each.site == site.name]
    if not told:
        where = "the shipped ones" if files is None else ", ".join(map(str, files))
        raise SettingsError(
            f"instructions: expected some for the site {site.name!r}, got none in "
            f"{where}; give instructions=FILE"
        )
    wanted = {"route": route, "study": study, "split": split}
    for name, value in wanted.items():
        if value is None:
            continue
        there = sorted({str(getattr(each, name)) for each in told})
        told = [
            each
            for each in told
            if getattr(each, name) == value
            or (name == "split" and is_of_split(each, value))
        ]
        if not told:
            raise SettingsError(
                f"{name}: expected one of {', '.join(there)}, got {value!r}"
            )
    return tuple(episodes(told, {site.name: site}))


def find_episode(choice: Iterable[Episode], name: object) -> Episode:
    """Return the episode of an id."""
    known = {each.id: each for each in choice}
    if isinstance(name, str) and name in known:
        return known[name]
    raise SettingsError(
        f"episode_id: expected one of this environment's {len(known)} (see "
        f"`env.unwrapped.episode_ids`), got {name!r}{did_you_mean(name, known)}"
    )


def register_environments() -> None:
    """Make the environments known to Gymnasium; what it knows already stays."""
    for name, site in ENVIRONMENTS.items():
        if name not in gymnasium.registry:
            gymnasium.register(
                name,
                entry_point="memorymaze.gym.environment:NavigationEnvironment",
                kwargs={} if site is None else {"site": site},
            )
