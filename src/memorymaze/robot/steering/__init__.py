"""Steering: the control API upon a body's sensors and motions.

`GuideRobot` makes the calls that agents know of what a body provides (`SensorsAndMotion` in
`robot`) and of what is known of the floor (`floor`). From below: `driving` moves in time,
along `lanes`, round things by `detours`; `pilot` makes motions of the calls. No body, no
building and no simulator is in here.
"""
