"""What cameras see: looks of buildings and things, rendering, furniture models, films.

Knows no robot and no physics. Importing it loads no OpenGL.
"""

from memorymaze.pictures.kinds_of_looks import Looks

__all__ = ["Looks"]
