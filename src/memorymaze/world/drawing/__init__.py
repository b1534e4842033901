"""A site's plan drawn: its shapes, and back ends that put them on paper and page.

`shapes` says once what a plan shows, in which colours and widths. Does not hold the views
of `cameras`, nor what a walk means (`runs`).
"""
