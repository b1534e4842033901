# From the restaurant turn right, and then keep along the windows with the view. The
# gallery follows the front of the building, it bends to the left a few times, just
# follow it. After the long straight piece at the end come the glass doors on the right
# with the sign Terrace. Go through them.


def leave_turning_point():
    here = turning_point_id()
    while here is not None and turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


walked_in = 0
while walked_in < 80 and "right" not in detect_turning_point():
    walked_in += 1
    move_forward(0.5)
turn("right")

# Follow the gallery round its bends, until there is a way out on the right.
for _ in range(200):
    ways = detect_turning_point()
    if "right" in ways and detect_from_RGB_image("glass door"):
        break
    if len(ways) > 0 and "forward" not in ways:
        lefts = [way for way in ways if way.endswith("left")]
        if lefts:
            turn(lefts[0])
            leave_turning_point()
            continue
    if move_forward(0.5).reason != "done":
        say("The gallery ends.")
        break
turn("right")
leave_turning_point()
move_forward(2)
say("This is the terrace.")
stop()
