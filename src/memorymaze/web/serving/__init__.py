"""What all pages that are served need.

Holds the application with its limits, templates and forms, the server (`web`), https on a
local network (`certificates`), robots that somebody looks on at (`live_process`,
`live_camera`), and the look of a page. Does not hold what any page tells.

Nothing is imported here: only the verbs that serve pages need the extra `studies`.
"""
