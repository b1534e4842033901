"""What cameras see: looks of buildings and things, rendering, films.

Knows no robot and no physics. Importing it loads no OpenGL.
"""

from memorymaze.pictures.kinds_of_looks import OWN, Looks, file_of_looks

__all__ = ["OWN", "Looks", "file_of_looks"]
