"""Colours and lines of plans, light and dark."""

PLAN_STYLE = """
:root{--room:#edebe6;--edge:#c9c5bc;--floor:#fffdf8;--open:#e6f0de;--turn:#dfe9f3;\
--wall:#4a4a4a;--door:#8a5a2b;--thing:#b9c7b3;--ink:#4d4a44;--way:#6d5a2e;--word:#3d5a3a}
@media (prefers-color-scheme:dark){:root{--room:#26282c;--edge:#3b3e44;--floor:#17191c;\
--open:#1b2a1d;--turn:#1d2b3a;--wall:#a9abb0;--door:#c99b66;--thing:#435443;\
--ink:#b9bbc0;--way:#cdb67f;--word:#9dbf97}}
path{stroke-linejoin:round}
.room{fill:var(--room);stroke:var(--edge);stroke-width:.06}
.floor{fill:var(--floor)}.open{fill:var(--open)}.turning{fill:var(--turn)}
.wall{fill:none;stroke:var(--wall);stroke-width:.16}
.door{fill:none;stroke:var(--door);stroke-width:.26}
.thing{fill:var(--thing)}.covering{fill:var(--thing);opacity:.35}
text{font-family:system-ui,"Segoe UI","DejaVu Sans",sans-serif;text-anchor:middle}
.name{fill:var(--ink)}.way{fill:var(--way);font-style:italic}.word{fill:var(--word)}
"""
