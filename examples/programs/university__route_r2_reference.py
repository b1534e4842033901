# Go straight past the lobby, which is the first opening. Before the stairs turn left.
# Go straight to the crossing and turn right there, over the bridge with the windows.
# After it turn right, and at the end of that hallway left. It is very long, about 37
# metres; a hallway comes in from the left half way, ignore it. At its end turn left,
# and only four or five metres on go right into the glass hallway. Then left. Pass the
# cross hallway, at the end go right. Office 2347 is on the left after a few metres.


def leave_turning_point():
    here = turning_point_id()
    while here is not None and turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


def take_turn(direction, skip=0):
    """Turn at the next turning point with that way, after skipping some of them."""
    leave_turning_point()
    while True:
        if direction in detect_turning_point():
            if skip == 0:
                return turn(direction).turned
            skip -= 1
            leave_turning_point()
        if move_forward(0.5).reason != "done":
            say("The way ends here.")
            return turn(direction).turned


take_turn("left", skip=1)  # the lobby
take_turn("right")
say("This is the bridge.")
take_turn("right")
take_turn("left")
take_turn("left", skip=1)  # the hallway half way along
take_turn("right")
take_turn("left")
take_turn("right", skip=1)  # the cross hallway
leave_turning_point()

start = distance_travelled()
while distance_travelled() - start < 8:
    office = detect_from_RGB_image("office 2347")
    if office and office[0].distance < 2:
        break
    if move_forward(0.5).reason != "done":
        break
move_forward(1)
say("Office 2347 is here.")
stop()
