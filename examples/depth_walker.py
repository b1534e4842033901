"""An agent that goes by single steps and looks with depth and LiDAR, typed throughout.

Try it: memorymaze evaluate --agent examples/depth_walker.py:DepthWalker --limit 12
"""

import math
from typing import ClassVar

import numpy as np

import memorymaze as mm


class DepthWalker:
    """Goes where the LiDAR sees farthest ahead, and stops before what the camera sees."""

    name = "depth_walker"
    needs: ClassVar[frozenset[str]] = frozenset({"camera", "steps"})

    def follow(
        self,
        instruction: str,
        robot: mm.SteppingRobot,
        journal: mm.Journal,
        rng: np.random.Generator,
    ) -> None:
        """Take up to twelve steps; returning says "we are there"."""
        for _ in range(12):
            scan = robot.lidar_scan()
            ahead = np.abs(scan.angles) < math.radians(60)
            farthest = int(np.argmax(np.where(ahead, np.minimum(scan.ranges, 20), 0)))
            angle = float(scan.angles[farthest])
            if abs(angle) > math.radians(5):
                robot.rotate(angle)
            picture = robot.camera_picture(64, 48)
            metres = float(np.median(picture.depth[20:28, 28:36]))
            journal.note("look", metres=metres, words=len(instruction.split()))
            if metres < 1.0 or robot.step_forward(0.5) < 0.45:
                return
