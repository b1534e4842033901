"""The page to draw and edit a site plan: `memorymaze sites edit`.

Holds the file with its drafts, what is proposed for drawn features, and the page. Does not
hold the rules of plans (`sites`) nor plans made from other files (`importing`).
"""
