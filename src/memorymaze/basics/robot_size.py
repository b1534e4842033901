"""How large the guide robot is: what buildings, cameras and bodies of it agree on."""

ROBOT_RADIUS = 0.25
"""Metres, of its upright shell: what is kept from walls and obstacles."""
CAMERA_HEIGHT = 1.25
"""Metres over the floor; the lens looks ahead from the robot's axis."""
