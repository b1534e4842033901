"""Furniture models of Sweet Home 3D, converted into the user's cache on request."""
