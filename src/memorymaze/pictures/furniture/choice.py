"""Which pieces of the furniture libraries stand for which archetypes of ours.

Only where they are recognised at least as well, and no words have to stand on them.
"""

CHOICE: dict[str, tuple[str, ...]] = {
    "aquarium": ("Scopia/aquarium",),
    "armchair": (
        "BlendSwap-CC-0/armchair2",
        "BlendSwap-CC-0/modernArmchair",
        "BlendSwap-CC-BY/armchair1",
        "BlendSwap-CC-BY/armChair2",
        "BlendSwap-CC-BY/fotel",
        "Scopia/modern_armchair",
    ),
    "bench": (
        "BlendSwap-CC-0/bench",
        "KatorLegaz/bench",
        "KatorLegaz/concrete-bench",
        "KatorLegaz/painted-bench",
        "Scopia/littlebank",
    ),
    "bookshelf": ("KatorLegaz/full-bookcase",),
    "cabinet": ("BlendSwap-CC-BY/wardrobe",),
    "cardboard boxes": ("Scopia/cardboard-box", "Scopia/open-cardboard-box"),
    "chair": (
        "BlendSwap-CC-0/plasticChair",
        "BlendSwap-CC-0/chair2",
        "BlendSwap-CC-BY/chair3",
        "KatorLegaz/dining-chair",
        "KatorLegaz/office-chair",
        "Scopia/tubular_chair",
        "Scopia/office_chair",
    ),
    "coffee table": (
        "BlendSwap-CC-BY/coffeeTable",
        "Scopia/coffee_table",
        "Scopia/saloon_table",
    ),
    "desk": ("BlendSwap-CC-BY/simpleDesk",),
    "exercise bike": ("Scopia/indoor-bike",),
    "filing cabinet": ("KatorLegaz/filing-cabinet",),
    "fire extinguisher": ("BlendSwap-CC-0/fireExtinguisher",),
    "floor lamp": ("Scopia/living_lamp",),
    "high table": ("Scopia/bar_table",),
    "ladder": ("Scopia/step-ladder-metal",),
    "person": (
        "Reallusion/female01",
        "Reallusion/female02",
        "Reallusion/female03",
        "Reallusion/male01",
        "Reallusion/male02",
        "Reallusion/male03",
        "Reallusion/holdingMale01",
        "Reallusion/holdingFemale01",
        "Reallusion/holdingFemale02",
        "Reallusion/holdingFemale03",
        "Reallusion/boyStanding",
    ),
    "planter": ("BlendSwap-CC-0/flowerBox", "BlendSwap-CC-0/plantie"),
    "potted plant": (
        "BlendSwap-CC-BY/yuccaPlant",
        "BlendSwap-CC-BY/decorativePlant",
        "BlendSwap-CC-0/decorativePlant",
        "BlendSwap-CC-0/plant",
        "BlendSwap-CC-BY/mediumIndoorPlant",
    ),
    "refrigerator": (
        "BlendSwap-CC-0/largeFridge",
        "KatorLegaz/fridge",
    ),
    "rock": ("BlendSwap-CC-0/rock1", "BlendSwap-CC-0/rock2", "BlendSwap-CC-0/rock3"),
    "round table": (
        "BlendSwap-CC-BY/cafe_set_mota_table",
        "KatorLegaz/cafe-table",
        "Scopia/round-table",
    ),
    "sofa": (
        "BlendSwap-CC-0/sofa2",
        "KatorLegaz/mid-century-sofa",
        "Scopia/burlap_sofa",
        "Scopia/leather_sofa",
    ),
    "stool": (
        "BlendSwap-CC-0/stool2",
        "BlendSwap-CC-0/silla2",
        "BlendSwap-CC-BY/green_stool",
        "Scopia/kitchen_stool",
    ),
    "table": (
        "BlendSwap-CC-0/table",
        "BlendSwap-CC-BY/table",
        "Scopia/table4",
        "Scopia/white_kitchen_table",
        "Scopia/wooden_table_office",
    ),
    "traffic cone": ("Scopia/cone",),
    "trash can": (
        "BlendSwap-CC-0/dustbin",
        "KatorLegaz/bullet-trash-can",
        "KatorLegaz/park-trashcan",
    ),
    "water cooler": ("Scopia/water_cooler",),
}
"""Archetype of `looks.catalogue`: pieces, by library and file."""

SIDEWAYS = frozenset({"exercise bike"})
"""Archetypes whose front, in site plans, is the pieces' left side."""

UNPAINTED = frozenset({"aquarium", "person", "planter", "potted plant", "rock"})
"""Archetypes that no one can paint: the piece nearest to the wanted colour is taken."""
