"""World: buildings and how they look; nothing moves here, and nobody looks for anything.

`sites` is what a plan is (`Site`), its files, rules and graph; `construction` makes
buildings, `importing` reads other formats, `exporting` writes them; `drawing` shows plans on
paper and pages; `looks` gives things and walls their meshes, `cameras` draws pictures of them.

Way in: `sites.load_site`, `construction.make_building`, `importing.import_site`.
To read first: `sites/records.py`, `sites/checking.py`.
"""
