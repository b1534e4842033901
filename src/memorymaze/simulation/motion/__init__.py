"""How the robot moves: wheels, straight ways, lanes round things, turns, given lines.

From below: `wheeled_base` has the wheels, `driving` moves in simulated time, `pilot`
makes motions of the calls. What is in the way of a move comes from `obstacles`.
"""
