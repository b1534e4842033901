"""How things, doors, walls and windows look: meshes with materials, and their words.

`catalogue` finds the model of a thing, in `things.glb` or a user's own file, `building`
puts a whole building together. Knows no robot, no camera and no OpenGL.
"""

from memorymaze.world.looks.kinds_of_looks import OWN, Looks, file_of_looks

__all__ = ["OWN", "Looks", "file_of_looks"]
