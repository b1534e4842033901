"""People who drive a robot by a text: their drives, their pages, and runs made of them.

Does not hold the other steps of a study.
"""
