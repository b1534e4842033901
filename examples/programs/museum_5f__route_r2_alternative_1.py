# From the escalator turn right, and then left so that the energy box is on your left
# hand. Go all the way along it and along the hexagon until everything opens up. Turn
# left there, and then the next right is Robot Plaza. The robot is just inside.


def leave_turning_point():
    here = turning_point_id()
    while here is not None and turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


for direction in ["right", "left", "left", "right"]:
    leave_turning_point()
    steps = 0
    while direction not in detect_turning_point() and steps < 80:
        steps += 1
        if move_forward(0.5).reason in ("wall", "obstacle"):
            break
    turn(direction)

leave_turning_point()
seen = None
while seen is None:
    robots = [r for r in detect_from_RGB_image("humanoid robot") if r.distance < 4]
    if robots:
        seen = robots[0]
    elif move_forward(0.5).reason != "done":
        break
if seen is not None:
    say(f"The robot is {seen.distance:.0f} metres away.")
stop()
