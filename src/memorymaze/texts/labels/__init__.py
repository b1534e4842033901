"""Collecting what people say of instructions: labels, agreement, consensus.

Annotators fill in a sheet (`label_sheet`), or a page of `studies`; their labels are files of
their own (`labels`), compared in `agreement` and merged in `consensus`.
Nobody walks here, and nothing is evaluated.
"""
