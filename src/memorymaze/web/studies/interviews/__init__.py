"""Interviews on a tablet: what it sends, its pages, recordings and their transcripts.

Does not hold what participants meet in their own browsers.
"""
