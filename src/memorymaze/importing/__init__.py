"""Buildings from elsewhere: site plans from other formats, with what had to be guessed.

One file per format, and the two pieces behind all: centre lines of a floor, and ways made
into plan features. Does not hold what a plan is (`sites`), or how ours are given to others.
"""
