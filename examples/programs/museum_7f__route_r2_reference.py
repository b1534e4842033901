# Out of the restaurant and left. At the end of the passage turn right into the main
# hallway. It goes past the shop and the reception, all of it straight on, and bends
# slightly to the left. A few metres after the bend there is a passage on the right, go
# in there to its end and turn left, and then the glass doors to the terrace are on the
# right. Go out.


def leave_turning_point():
    here = turning_point_id()
    while here is not None and turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


def walk_to(wanted):
    """Walk to the next turning point whose ways are as wanted."""
    leave_turning_point()
    while not wanted(detect_turning_point()):
        if move_forward(0.5).reason != "done":
            return False
    return True


walk_to(lambda ways: "left" in ways)
turn("left")

# The end of a passage: nothing ahead.
walk_to(lambda ways: "right" in ways and "forward" not in ways)
turn("right")

walk_to(lambda ways: "slight_left" in ways)
turn("slight_left")
say("That was the bend.")

walk_to(lambda ways: "right" in ways)
turn("right")
walk_to(lambda ways: "left" in ways and "forward" not in ways)
turn("left")
walk_to(lambda ways: "right" in ways)
turn("right")
leave_turning_point()
move_forward(2)
stop()
