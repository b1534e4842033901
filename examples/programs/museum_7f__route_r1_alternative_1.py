# Go left when you leave the lifts, that is the wrong side, but it works too. At the end
# left, and left again, so you go round the lifts. Then it is a long corridor back. It
# bends to the right at its end. Go straight, past three openings on the left. There is
# one with vending machines and the one of the restrooms; the turn after the restrooms
# on the right is it. Walk in six metres.


def pass_by():
    here = turning_point_id()
    while turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


def walk_on():
    """Walk into the next turning point."""
    if turning_point_id() is not None:
        pass_by()
    while turning_point_id() is None:
        if move_forward(0.5).reason != "done":
            break


for direction in ("left", "left", "left"):
    walk_on()
    while direction not in detect_turning_point():
        walk_on()
    turn(direction)

# The long corridor, up to its bend.
walk_on()
while "slight_right" not in detect_turning_point():
    walk_on()
turn("slight_right")

openings_on_the_left = 0
while True:
    walk_on()
    ways = detect_turning_point()
    if "left" in ways:
        openings_on_the_left += 1
        say(f"Opening number {openings_on_the_left} on the left.")
    if "right" in ways and openings_on_the_left >= 3:
        break
    if not ways:
        break
turn("right")
move_forward(6)
stop()
