"""The command line: one file per verb, each with `add_parser`.

Holds options and what is printed; whatever a verb does is a call of the rooms below.
"""
