"""Furniture models of others (Sweet Home 3D) in place of ours, where a user converted them.

`conversion` makes them, `models` finds the one for a thing. Holds no model itself.
"""
