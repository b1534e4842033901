"""Draws pictures with Miniworld when told to; runs in a process of its own.

Needs nothing of this project, only `miniworld`. Arguments: SCENE WIDTH HEIGHT SAMPLES.
Each line on stdin is a number of pictures; the answer is the milliseconds per picture.
Scenes: `maze` is Miniworld's own 8 x 8 maze as it comes; `furnished` is that maze with
rooms of 6 m, 2,304 square metres in all, and 281 of Miniworld's own models: as large and
as full as the museum's fifth floor.
"""

import math
import sys
import time

import numpy as np
import pyglet

pyglet.options["headless"] = True

import miniworld.opengl  # noqa: E402
from miniworld.entity import MeshEnt  # noqa: E402
from miniworld.envs.maze import Maze  # noqa: E402
from miniworld.opengl import FrameBuffer  # noqa: E402

MODELS = (
    ("office_chair", 0.9),
    ("office_desk", 0.8),
    ("barrel", 0.9),
    ("cone", 0.6),
    ("barrier", 0.8),
    ("medkit", 0.3),
    ("tree", 1.8),
    ("doom_door", 2.1),
    ("potion", 0.4),
    ("ball_blue", 0.5),
)
OBJECTS = 281
POSES = 40


class FurnishedMaze(Maze):
    """Miniworld's maze with larger rooms, full of things."""

    def __init__(self, **kwargs):
        """Make it with rooms of 6 m."""
        super().__init__(room_size=6, **kwargs)

    def _gen_world(self):
        super()._gen_world()
        for number in range(OBJECTS):
            name, height = MODELS[number % len(MODELS)]
            self.place_entity(MeshEnt(name, height))


class WithoutExtensions:
    """Makes Miniworld fall back to a frame buffer without multisampling."""

    @staticmethod
    def have_extension(name):
        """Deny every extension."""
        del name
        return False


SCENES = {"maze": Maze, "furnished": FurnishedMaze}


def main():
    scene, width, height, samples = sys.argv[1], *map(int, sys.argv[2:])
    env = SCENES[scene](obs_width=width, obs_height=height)
    env.reset(seed=0)
    if not samples:
        miniworld.opengl.gl_info = WithoutExtensions
    env.obs_fb = FrameBuffer(width, height, max(1, samples))
    poses = poses_in(env)
    for line in sys.stdin:
        frames = int(line)
        began = time.perf_counter()
        for number in range(frames):
            draw(env, poses[number % len(poses)])
        print((time.perf_counter() - began) * 1e3 / frames, flush=True)


def poses_in(env):
    """Return places in the middles of rooms, and ways to look."""
    rng = np.random.default_rng(0)
    rooms = [env.rooms[i] for i in rng.integers(len(env.rooms), size=POSES)]
    return [
        (
            np.array([(r.min_x + r.max_x) / 2, 0.0, (r.min_z + r.max_z) / 2]),
            float(rng.uniform(0, 2 * math.pi)),
        )
        for r in rooms
    ]


def draw(env, pose):
    env.agent.pos, env.agent.dir = pose
    return env.render_obs()


if __name__ == "__main__":
    main()
