# Go along this hallway and round the corner to the right. Where it ends in a T, go
# left. At the next crossing turn right, go past the kitchen, and at the end turn left.
# The library is behind the glass doors straight ahead; there is a sign above them.


def leave_turning_point():
    here = turning_point_id()
    while here is not None and turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


def turn_at_next(direction):
    """Walk to the next turning point where one can go that way, and go that way."""
    leave_turning_point()
    while direction not in detect_turning_point():
        if move_forward(0.5).reason != "done":
            break
    turned = turn(direction).turned
    if not turned:
        say(f"I cannot go {direction} here.")
    return turned


say("We follow the hallway round the corner.")
turn_at_next("right")
turn_at_next("left")
turn_at_next("right")
if detect_from_RGB_image("kitchen sign"):
    say("This should be the way past the kitchen.")
turn_at_next("left")

leave_turning_point()
while True:
    doors = detect_from_RGB_image("sliding glass door")
    if doors and doors[0].distance < 1.5 and abs(doors[0].bearing_deg) < 20:
        break
    if move_forward(0.5).reason != "done":
        break
say("The library is in front of you.")
stop()
