"""What surfaces and things look like: materials, models of things and of doors.

`catalogue` finds the model for a thing of a plan; the files named after subjects build
them from shapes. Holds no buildings, no cameras and no drawing.
"""
