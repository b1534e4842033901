# Come out of the lifts and go right along this path. It is long. Leave the opening on
# the left. The corridor bends slightly to the right. The second opening, opposite the
# dark red door, is on the right: take it, straight on past a statue until you face a
# wall. Left. Straight along this path: over the crossing with the vending machines,
# past the restrooms, and at the third one right. Conference Room 6 is the second door
# on the left.


def leave_turning_point():
    here = turning_point_id()
    while here is not None and turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


def next_ways():
    """Walk to the next turning point; bends are simply followed."""
    while True:
        leave_turning_point()
        while not detect_turning_point():
            if move_forward(0.5).reason != "done":
                break
        ways = detect_turning_point()
        if ways in (["slight_left"], ["slight_right"]):
            turn(ways[0])
        else:
            return ways


def take(direction):
    for _ in range(12):
        if direction in next_ways():
            return turn(direction).turned
    return False


take("right")
take("right")
take("left")

# The third opening: two are passed, whichever side they are on.
next_ways()
next_ways()
while "right" not in next_ways():
    say("Not this one.")
turn("right")

leave_turning_point()
doors_on_the_left = []
for _ in range(24):
    for door in detect_from_RGB_image("door"):
        if door.bearing_deg > 0 and door.track_id not in doors_on_the_left:
            doors_on_the_left.append(door.track_id)
    rooms = detect_from_RGB_image("Conference Room 6")
    if len(doors_on_the_left) >= 2 and rooms and rooms[0].distance < 2:
        break
    if move_forward(0.5).reason != "done":
        break
move_forward(1)
say(f"Conference Room 6 is door number {len(doors_on_the_left)} on the left.")
stop()
