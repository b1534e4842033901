"""How the robot moves: its wheels, the lines it keeps to, turns, detours."""
