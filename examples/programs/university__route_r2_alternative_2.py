# First go down the hallway to the corner before the stairwell and turn left, walk to
# the big crossing and turn right over the bridge. On the other side go left, not
# right. Follow the hallway: it turns right by itself, then after a long way right
# again. Half way down the window hallway the glass hallway goes off to the left, sharp
# back from the way you came, take that one. Left at its end, straight on past the
# first hallway on the right, then right, and it is the door with 2347 on it.


def leave_turning_point():
    here = turning_point_id()
    while here is not None and turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


def next_turning_point():
    """Walk to the next turning point and return the ways it has."""
    leave_turning_point()
    ways = detect_turning_point()
    while not ways:
        if move_forward(0.5).reason != "done":
            break
        ways = detect_turning_point()
    return ways


def walk_to(direction):
    """Walk to the next turning point with that way, and turn."""
    for _ in range(10):
        if direction in next_turning_point():
            return turn(direction).turned
    return False


next_turning_point()  # the lobby
walk_to("left")
walk_to("right")
walk_to("left")
walk_to("right")

# A hallway in the middle also goes right: ours is where nothing lies ahead.
while "forward" in next_turning_point():
    say("Straight on here.")
turn("right")

walk_to("left")
walk_to("left")
next_turning_point()  # the first hallway on the right
walk_to("right")
move_forward(5)
stop()
