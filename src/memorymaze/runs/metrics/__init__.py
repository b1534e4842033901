"""Metrics of walks: pure functions of numbers and arrays, without files or clocks."""
