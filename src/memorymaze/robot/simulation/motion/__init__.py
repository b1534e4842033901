"""How the simulated robot moves: wheels, and what the plan and given lines tell of ways.

`wheeled_base` has the wheels; `straight_ways` and `clearance` are the plan's part of what
`steering` asks for; `line_following` is for walks whose way is known.
"""
