"""What a guide robot can be asked to do: the control API and its records, as roles.

`api.Robot` is what programs, agents and people call, and its docstrings are what language
models are told (`specification`); `steps.SteppingRobot` adds single steps, pictures and
scans, `viewpoints.ViewpointRobot` goes along a graph. No robot is in here: the one there
is drives in `simulation`, and what an agent decides is in `agents`.
"""
