"""The page to try the robot: its visitors, their walks, and the words for what happens.

Does not hold studies, in which people answer questions.
"""
