# Two or three metres forward onto the promenade, then left. After seven and a half
# metres take the first turning on the right and stay on the carpet for 22 metres. At
# the T turn right, and after five metres left under the sign Robot Plaza. Five metres
# on the white robot stands on its stage.


def go_to_first(direction, about):
    """Take the first turning to a side, after walking most of the way that was said."""
    start = distance_travelled()
    while True:
        walked = distance_travelled() - start
        if walked > about / 2 and direction in detect_turning_point():
            break
        if walked > 2 * about + 5:
            say("It should have come by now.")
            break
        if move_forward(0.5).reason != "done":
            break
    turn(direction)


go_to_first("left", about=2.5)
go_to_first("right", about=7.5)
go_to_first("right", about=22)
go_to_first("left", about=5)
move_forward(5)
if detect_from_RGB_image("white robot"):
    say("I can see the robot.")
stop()
