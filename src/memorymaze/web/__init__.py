"""Web: everything with a page that is served.

`serving` has limits, forms, servers, https on a local network, and robots that somebody
looks on at; `try_page` lets visitors try the robot, `studies` runs studies with people,
`editor` draws site plans.

Way in: the verbs `try`, `study` and `sites edit`.
To read first: `serving/web.py`, `studies/study_file.py`.
"""
