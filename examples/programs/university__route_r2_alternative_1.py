# Sixteen metres straight on, then left before the stairs. Fourteen metres, right at the
# crossing over the link. Do not turn at the end of the link: go straight, it is about
# 19 metres more to a T. Right, past the lounge on the left, to the end of that one,
# then left. At the end left again, right at once into the glass hallway, left, pass
# one hallway, and at the very end right, and some five metres to office 2347.


def to_end_of(metres, direction):
    """Walk about so far, then to the turning point where one can go that way."""
    start = distance_travelled()
    while distance_travelled() - start < 0.7 * metres:
        if move_forward(0.5).reason != "done":
            break
    while direction not in detect_turning_point():
        if move_forward(0.5).reason != "done":
            break
    result = turn(direction)
    say(result.message)


to_end_of(16, "left")
to_end_of(14, "right")
to_end_of(14 + 19, "right")
to_end_of(20, "left")
to_end_of(18, "left")
to_end_of(4, "right")
to_end_of(16, "left")
to_end_of(24, "right")
move_forward(5.5)
stop()
