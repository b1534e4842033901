# Straight on and right at the corner, then left at the T. Don't turn at the kitchen
# crossing, keep straight on until the corner, that one goes right. Then there is a
# lounge with armchairs and a globe, turn left there to the library doors.


def walk_until(condition, limit=40.0):
    """Walk in small steps until something is so; False if the way ends before."""
    start = distance_travelled()
    while not condition():
        if distance_travelled() - start > limit:
            return False
        if move_forward(0.5).reason != "done":
            return condition()
    return True


def can_go(direction):
    return lambda: direction in detect_turning_point()


def pass_turning_point():
    here = turning_point_id()
    walk_until(lambda: turning_point_id() != here, limit=10.0)


walk_until(can_go("right"))
turn("right")
pass_turning_point()

walk_until(can_go("left"))
turn("left")
pass_turning_point()

# The kitchen crossing: every way is open, ours is the one ahead.
walk_until(can_go("forward"))
pass_turning_point()

walk_until(can_go("right"))
turn("right")
pass_turning_point()

walk_until(can_go("left"))
turn("left")
walk_until(lambda: len(detect_from_RGB_image("library sign")) > 0, limit=6.0)
say("Here we are at the library.")
stop()
