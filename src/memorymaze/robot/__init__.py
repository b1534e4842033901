"""Robot: what it can be asked, what it perceives, how it drives, and its bodies.

`api` is the control API as protocols, and the text that models are told of it;
`perception` finds things, signs and turning points; `steering` is the `GuideRobot` upon
the sensors and motions of any body; `simulation` is the body in MuJoCo with obstacles and
people, `carla` the one in CARLA. Only the last two know buildings.

Way in: `api.Robot` for who drives, `api.sensors_and_motion` for who brings a body.
To read first: `api/control.py`, `steering/guide_robot.py`.
"""
