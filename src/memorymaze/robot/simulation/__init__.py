"""Simulated buildings and the robot in them: physics by MuJoCo, time, motion, collisions.

`scene` makes a physics model of a site, `body` the robot's body in it, and `robot` the guide
robot that agents drive: `steering` on that body, with the plan's knowledge of the floor. What
the body perceives is in `senses`, what an episode adds to the plan in `obstacles`. No picture
is drawn here (`looks` does, through `cameras`), no name is matched with a thing
(`perception`), nothing is scored (`metrics`).
"""
