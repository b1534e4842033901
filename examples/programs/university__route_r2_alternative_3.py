# At the lobby go left already, up the middle hallway to the lifts, there right. Keep
# straight over the crossing and over the bridge. Turn right after the bridge, left at
# the bottom, and go to the end of the long hallway. You come to the east lounge; left
# there, and the first right is the glass hallway. Left at the end of it, straight over
# the cross hallway, then right. The professor's door is next to a bench.

DIRECTIONS = [
    ("left", 1),
    ("right", 1),
    ("right", 2),
    ("left", 1),
    ("left", 2),
    ("right", 1),
    ("left", 1),
    ("right", 2),
]


def count_to(direction, number):
    """Walk to the turning point that is this number among those with that way."""
    last = turning_point_id()
    counted = 0
    while counted < number:
        here = turning_point_id()
        if here is not None and here != last:
            last = here
            if direction in detect_turning_point():
                counted += 1
                continue
        if move_forward(0.5).reason != "done":
            break


for direction, number in DIRECTIONS:
    count_to(direction, number)
    if not turn(direction).turned:
        say(f"There is no way {direction}.")

for _ in range(16):
    if detect_from_RGB_image("bench"):
        break
    if move_forward(0.5).reason != "done":
        break
move_forward(2)
stop()
