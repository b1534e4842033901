"""Studies with people: the pages they meet, what they answer, and corpora made of it.

Holds the web application that studies and the page to try the robot share (`web`), study
files, the store of answers, the pages and the export. Does not hold labels of finished
texts (`collection`), nor what runs or tables are made of.

Nothing is imported here: only the verbs that serve pages need the extra `studies`.
"""
