"""A robot, its way so far and the people around it, on a plan, moment by moment."""

import math

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.robot_size import ROBOT_RADIUS
from memorymaze.runs.replay.page import font_for
from memorymaze.runs.story.moments import Moment, Moments
from memorymaze.world.drawing.plan_picture import PlanSheet
from memorymaze.world.drawing.shapes import (
    FOUND_COLOR,
    PEOPLE_COLOR,
    THING_COLOR,
    WALK_COLOR,
    route_color,
)
from memorymaze.world.sites import Route

SMOOTHING = 2
"""Pixels drawn per pixel shown, each way, so that slanted edges are smooth."""
VIEW = (255, 213, 79, 90)
"""Of what the camera can see."""
HALF_VIEW = math.pi / 4
VIEW_RANGE = 4.0
"""Metres within which the robot reports what it detects."""
FOUND_SHOWN = 4.0
"""Seconds that something detected stays on the plan."""


def legend_of(route: Route, moments: Moments) -> list[tuple[str, str, str]]:
    """Return sign, colour and meaning of the marks that an episode can have."""
    marks = [
        ("━", route_color(route.route), "way described"),
        ("━", WALK_COLOR, "driven"),
    ]
    if moments.sightings:
        marks.append(("◆", FOUND_COLOR, "detected"))
    if moments.story.people:
        marks.append(("●", PEOPLE_COLOR, "person"))
    if moments.things:
        marks.append(("☒", THING_COLOR, "left in the way"))
    return marks


class PlanView:
    """Draws moments in the order of time."""

    def __init__(self, sheet: PlanSheet, moments: Moments, letter: int) -> None:
        """Begin with a plan `SMOOTHING` times as large as what is to be seen."""
        self._sheet = sheet
        self._moments = moments
        self._font = font_for("", letter * SMOOTHING)
        self._walk = Image.fromarray(sheet.picture)
        self._drawn = 0
        self._line = max(2, round(letter * SMOOTHING / 6))
        pen = ImageDraw.Draw(self._walk)
        for pose in moments.things.values():
            x, y = sheet.pixel(pose.x, pose.y)
            side = max(0.3 * sheet.scale, 3.0 * self._line)
            box = (x - side, y - side, x + side, y + side)
            pen.rectangle(box, fill="white", outline=THING_COLOR, width=self._line)
            pen.line((box[0], box[1], box[2], box[3]), THING_COLOR, self._line)
            pen.line((box[0], box[3], box[2], box[1]), THING_COLOR, self._line)

    def picture(self, moment: Moment) -> NDArray[np.uint8]:
        """Return the plan at a moment, none earlier than those before it."""
        self._go_on(moment)
        page = self._walk.copy()
        pen = ImageDraw.Draw(page, "RGBA")
        self._draw_view(pen, moment.pose)
        self._draw_found(pen, moment.time)
        for pose in moment.people.values():
            self._draw_person(pen, pose)
        self._draw_robot(pen, moment.pose)
        return np.asarray(page.reduce(SMOOTHING))

    def _go_on(self, moment: Moment) -> None:
        points = self._moments.points[self._drawn : moment.walked]
        places = [self._sheet.pixel(*point) for point in points.tolist()]
        places.append(self._sheet.pixel(moment.pose.x, moment.pose.y))
        if len(places) > 1:
            ImageDraw.Draw(self._walk).line(
                places, WALK_COLOR, self._line, joint="curve"
            )
        # The last pose drawn is where the next piece begins.
        self._drawn = max(0, moment.walked - 1)

    def _draw_view(self, pen: ImageDraw.ImageDraw, pose: Pose) -> None:
        x, y = self._sheet.pixel(pose.x, pose.y)
        reach = VIEW_RANGE * self._sheet.scale
        ahead = -math.degrees(pose.heading)
        half = math.degrees(HALF_VIEW)
        box = (x - reach, y - reach, x + reach, y + reach)
        pen.pieslice(box, ahead - half, ahead + half, fill=VIEW)

    def _draw_found(self, pen: ImageDraw.ImageDraw, now: float) -> None:
        labelled: set[str] = set()
        for each in reversed(self._moments.sightings):
            if not now - FOUND_SHOWN <= each.time <= now or each.label in labelled:
                continue
            labelled.add(each.label)
            x, y = self._sheet.pixel(each.x, each.y)
            half = 3.5 * self._line
            diamond = [(x, y - half), (x + half, y), (x, y + half), (x - half, y)]
            pen.polygon(diamond, fill=FOUND_COLOR, outline="white")
            at = (x + 2 * half, y)
            for width, colour in ((self._line, "white"), (0, FOUND_COLOR)):
                pen.text(
                    at,
                    each.label,
                    colour,
                    self._font,
                    anchor="lm",
                    stroke_width=width,
                    stroke_fill="white",
                )

    def _draw_person(self, pen: ImageDraw.ImageDraw, pose: Pose) -> None:
        x, y = self._sheet.pixel(pose.x, pose.y)
        radius = max(0.25 * self._sheet.scale, 3.2 * self._line)
        box = (x - radius, y - radius, x + radius, y + radius)
        pen.ellipse(box, fill=PEOPLE_COLOR, outline="white", width=self._line // 2 + 1)
        tip = (
            x + 2 * radius * math.cos(pose.heading),
            y - 2 * radius * math.sin(pose.heading),
        )
        pen.line([(x, y), tip], PEOPLE_COLOR, self._line)

    def _draw_robot(self, pen: ImageDraw.ImageDraw, pose: Pose) -> None:
        x, y = self._sheet.pixel(pose.x, pose.y)
        size = max(1.6 * ROBOT_RADIUS * self._sheet.scale, 6.5 * self._line)
        # An arrow head, with a notch behind.
        shape = ((1.3, 0.0), (-0.9, 0.8), (-0.4, 0.0), (-0.9, -0.8))
        cosine, sine = math.cos(pose.heading), math.sin(pose.heading)
        corners = [
            (x + size * (a * cosine - b * sine), y - size * (a * sine + b * cosine))
            for a, b in shape
        ]
        pen.polygon(
            corners, fill=WALK_COLOR, outline="white", width=self._line // 2 + 1
        )
