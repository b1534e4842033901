"""Basics: what every room may need and nobody has to know about robots for.

`geometry` (poses, polylines, grids, shortest walks) knows no file; `errors` has every
exception that a user can meet, and `input_files` says what a refused file has wrong.
`options` makes a dataclass a list of options, `tables` a table a text, a page and a frame.

Way in: whatever a file needs, by its own name; nothing in here imports another wing.
To read first: `errors.py`, `geometry/pose.py`.
"""
