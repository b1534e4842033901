# Come out of the lifts, six metres to the information desk, and turn right. Take the
# first way on the left, between the drink machine and the desk: the meteorites are in
# there. At its end stands Jupiter; turn right and after four metres left. Now go on for
# almost twenty metres and don't turn in where the rocket engine is. At the end turn
# right. The first lane on the left, by the old seismograph, leads to the space station.


def leave_turning_point():
    here = turning_point_id()
    while here is not None and turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


def first(direction):
    leave_turning_point()
    while direction not in detect_turning_point():
        if move_forward(0.5).reason != "done":
            break
    return turn(direction).turned


first("right")
first("left")
first("right")
first("left")

# Straight on until the way ahead is closed.
leave_turning_point()
while True:
    ways = detect_turning_point()
    if "right" in ways and "forward" not in ways:
        break
    if move_forward(0.5).reason != "done":
        break
turn("right")

first("left")
leave_turning_point()
while True:
    station = detect_from_RGB_image("space station module")
    if station and station[0].distance < 3:
        break
    if move_forward(0.5).reason != "done":
        break
say("The space station is in front of you.")
stop()
