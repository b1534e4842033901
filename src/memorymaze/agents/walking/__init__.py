"""Walking about without a plan of the floor: driving, and the sketch map drawn meanwhile.

Also what was said of the ways out of a crossing. Where to go is decided by the agents.
"""
