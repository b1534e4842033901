"""Pictures of a building: a scene for the eye, and cameras that draw it with OpenGL."""
