"""What camera and LiDAR measured in an episode, anew at the poses of its trace."""

import math

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.geometry.pose import turn_between
from memorymaze.basics.physics_engine import about_z, mujoco
from memorymaze.robot.simulation.cameras import visual_scene_of
from memorymaze.robot.simulation.scene import Scene
from memorymaze.robot.simulation.senses.lidar import Lidar, LidarSettings
from memorymaze.runs.replay.page import font_for
from memorymaze.runs.story.moments import Moment, Moments, StorySighting
from memorymaze.world.cameras.camera import CameraFrame, RenderedCamera
from memorymaze.world.looks import OWN, Looks

PICTURE_SIZE = (640, 480)
"""Pixels of the robot's own picture, which boxes refer to."""
BOX_SHOWN = 0.5
"""Simulated seconds that a box stays on the picture."""
SAME_PLACE = 0.4
"""Metres from where something was detected within which its box roughly fits."""
SAME_WAY = 0.1
"""Radians, likewise."""
BOX = "#ffe14d"
EDGE = "#202020"


class ReplayEyes:
    """The robot's camera, until it is closed."""

    def __init__(
        self,
        scene: Scene,
        moments: Moments,
        size: tuple[int, int],
        looks: Looks | None,
        *,
        smooth: bool,
    ) -> None:
        """Open the camera, with smooth edges where there is time for them."""
        self._looks = visual_scene_of(scene, looks or OWN)
        unknown = moments.movables - self._looks.movable_geoms.keys()
        if unknown:
            raise RunFolderError(
                f"expected a trace with the things and people of its run's settings, "
                f"got {min(unknown)!r} too; was it made by another version?"
            )
        self._things = moments.things
        self._camera = RenderedCamera(
            self._looks, *size, math.pi / 2, multisamples=4 if smooth else 0
        )

    def picture(self, moment: Moment) -> NDArray[np.uint8]:
        """Return what the camera saw: colours, (height, width, 3)."""
        self._looks.place({**self._things, **moment.people})
        return self._camera.picture(moment.pose)

    def frame(self, moment: Moment) -> CameraFrame:
        """Return what the camera saw, with depth."""
        self._looks.place({**self._things, **moment.people})
        return self._camera.frame(moment.pose)

    def close(self) -> None:
        """Close the camera."""
        self._camera.close()


def boxes_at(moments: Moments, moment: Moment) -> list[StorySighting]:
    """Return what was detected just before, where its box still fits the picture."""
    fitting = [
        each
        for each in moments.sightings
        if moment.time - BOX_SHOWN < each.time <= moment.time
        and math.dist(each.pose[:2], moment.pose[:2]) < SAME_PLACE
        and abs(turn_between(each.pose.heading, moment.pose.heading)) < SAME_WAY
    ]
    latest = {each.label: each.time for each in fitting}
    return [each for each in fitting if each.time == latest[each.label]]


def draw_boxes(
    picture: NDArray[np.uint8], found: list[StorySighting], letter: int
) -> NDArray[np.uint8]:
    """Draw boxes of detected things on a picture, with their names in some size."""
    if not found:
        return picture
    page = Image.fromarray(picture)
    pen = ImageDraw.Draw(page)
    across = page.width / PICTURE_SIZE[0]
    for each in found:
        left, top, right, bottom = (across * number for number in each.box)
        pen.rectangle((left - 1, top - 1, right + 1, bottom + 1), outline=EDGE, width=4)
        pen.rectangle((left, top, right, bottom), outline=BOX, width=2)
        font = font_for(each.label, letter)
        place = (left + 3, max(0.0, top - letter - 5))
        pen.rectangle(pen.textbbox(place, each.label, font=font), fill=EDGE)
        pen.text(place, each.label, BOX, font)
    return np.asarray(page)


class Scans:
    """A LiDAR without noise, with the things and people of the moment."""

    def __init__(self, scene: Scene, moments: Moments) -> None:
        """Mount a LiDAR."""
        self._scene = scene
        self._things = moments.things
        self._data = mujoco.MjData(scene.model)
        self._heights = {each.id: each.size[2] for each in scene.movables}
        settings = LidarSettings(noise=0.0, drop_out=0.0)
        self._height = settings.height
        self._lidar = Lidar(scene, self._data, settings)
        mujoco.mj_kinematics(scene.model, self._data)

    def points(self, moment: Moment) -> NDArray[np.float64]:
        """Return where the rays ended: metres in the robot's frame, (N, 3).

        x ahead, y to the left, z up from the floor.
        """
        for name, pose in {**self._things, **moment.people}.items():
            row = self._scene.mocap_ids[name]
            self._data.mocap_pos[row] = (pose.x, pose.y, self._heights[name] / 2)
            self._data.mocap_quat[row] = about_z(pose.heading)
        mujoco.mj_kinematics(self._scene.model, self._data)
        points = self._lidar.scan(moment.pose, moment.time).points()
        return points + np.array([0.0, 0.0, self._height])
