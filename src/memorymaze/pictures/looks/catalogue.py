"""Which thing looks how: from the words of a site plan to a model.

A category is looked up as it stands, then without what follows `of`, `with` or `for`
(`statue of a bear` is a statue), then without its first words (`antique corner sofa`).
What remains unknown gets a box with its name on it.
"""

import re
import zlib
from collections.abc import Callable
from functools import cache

from memorymaze.pictures.furniture.cache import Looks
from memorymaze.pictures.furniture.fitting import furniture_for
from memorymaze.pictures.looks import (
    animals,
    aquariums,
    bins,
    bones,
    cases,
    clocks,
    counters,
    earth_science,
    fixtures,
    games,
    globes,
    kitchen,
    lockers,
    obstacles,
    office_machines,
    panels,
    panes,
    people,
    pianos,
    pictures,
    plants,
    racks,
    safety,
    science,
    screens,
    seats,
    shelves,
    signs,
    spaceflight,
    statues,
    tables,
    vehicles,
    vending,
    washing,
    water,
    weather,
    wheels,
)
from memorymaze.pictures.looks.assembly import Assembly, Order
from memorymaze.pictures.looks.object_model import ObjectModel
from memorymaze.pictures.looks.windows import is_window, window_model
from memorymaze.sites.records import Landmark, Mount

VARIANTS = 6
"""Things of one kind, size, colour and text come in at most so many looks."""

ARCHETYPES: dict[str, tuple[Callable[[Order], Assembly], tuple[str, ...]]] = {
    "A-frame": (signs.a_frame, ("sandwich board", "pavement sign")),
    "AED": (safety.aed_box, ("AED box", "defibrillator")),
    "animal": (animals.animal, ("polar bear", "bear", "brown bear")),
    "aquarium": (aquariums.aquarium, ("fish tank",)),
    "aquarium window": (aquariums.aquarium_window, ()),
    "armchair": (seats.armchair, ("easy chair", "lounge chair")),
    "banner": (signs.banner, ("pennant", "tapestry", "wall hanging")),
    "bench": (seats.bench, ("pew", "seating", "seat")),
    "bicycle": (vehicles.bicycle, ("bike",)),
    "bookshelf": (shelves.bookshelf, ("bookcase", "book shelf", "shelving", "shelves", "book rack")),
    "brochure rack": (racks.brochure_rack, ("leaflet rack", "postcard rack", "newspaper rack", "magazine rack", "leaflet stand", "rack")),
    "bust": (statues.bust, ()),
    "cabinet": (lockers.cabinet, ("cupboard", "wardrobe", "closet", "locker", "sideboard")),
    "call button panel": (safety.call_button_panel, ("lift buttons", "elevator buttons", "button panel")),
    "capsule toy machine": (vending.capsule_machine, ("gumball machine", "gashapon")),
    "car": (vehicles.car, ("vehicle", "van", "taxi")),
    "cardboard boxes": (obstacles.cardboard_boxes, ("cardboard box", "carton", "box", "crate", "parcel", "stack of boxes")),
    "chair": (seats.chair, ("office chair", "folding chair")),
    "chessboard table": (games.chess_table, ("chess table", "game table", "chessboard")),
    "city model": (science.city_model, ("architectural model", "building model", "scale model", "diorama")),
    "clock": (clocks.clock, ("wall clock",)),
    "cloud chamber": (science.cloud_chamber, ()),
    "coat rack": (racks.coat_rack, ("coat stand", "clothes rack", "hat stand")),
    "coffee machine": (office_machines.coffee_machine, ("espresso machine", "coffee maker")),
    "coffee table": (tables.coffee_table, ("low table",)),
    "coin lockers": (lockers.coin_lockers, ("luggage lockers", "parcel lockers", "parcel locker", "coin locker")),
    "computer terminal": (screens.computer_terminal, ("computer", "catalog terminal", "terminal", "workstation")),
    "core sample": (earth_science.core_sample, ("rock cores", "drill core")),
    "counter": (counters.counter, ("reception counter", "cafe counter", "buffet counter", "cashier counter", "information desk", "reception desk", "front desk", "help desk", "service desk", "reception", "checkout", "ticket desk")),
    "desk": (tables.desk, ("writing desk",)),
    "detector model": (science.detector_tube, ("photomultiplier", "light detector")),
    "digital sign": (screens.screen, ("digital signage", "departure board", "display", "monitor", "screen", "interactive screen", "television", "tv", "projector screen", "signage")),
    "dinosaur skull": (bones.skull, ("skull", "fossil")),
    "display case": (cases.display_case, ("trophy case", "showcase", "glass case", "vitrine", "display cabinet", "case", "exhibit")),
    "DNA model": (science.dna_model, ("double helix", "helix")),
    "drill head": (earth_science.drill_head, ("drill", "drill bit")),
    "drinking fountain": (washing.drinking_fountain, ("water fountain",)),
    "drop box": (cases.drop_box, ("book return box", "book return", "donation box", "mailbox", "post box", "suggestion box", "letter box", "ballot box", "return box")),
    "escalator": (fixtures.escalator, ()),
    "exercise bike": (vehicles.exercise_bike, ()),
    "exhibit panel": (panels.exhibit_panel, ("lectern", "reading rail")),
    "exit sign": (signs.exit_sign, ("emergency exit sign", "emergency sign")),
    "eyewash station": (washing.eyewash_station, ("eye wash", "eyewash")),
    "filing cabinet": (lockers.filing_cabinet, ("drawers", "chest of drawers", "file cabinet", "drawer cabinet", "card catalog")),
    "fire extinguisher": (safety.fire_extinguisher, ("extinguisher",)),
    "fire hydrant box": (safety.fire_hydrant_box, ("fire hose", "fire hose cabinet", "hydrant box", "hose reel")),
    "flag": (pictures.flag, ()),
    "floor lamp": (fixtures.floor_lamp, ("lamp", "standing lamp")),
    "floor map": (panels.floor_map, ("floor plan", "map", "site map", "evacuation plan", "directory map", "tactile map", "plan", "floor guide")),
    "foosball table": (games.foosball_table, ("table football",)),
    "framed photos": (pictures.framed_photos, ("photos", "photo wall", "portraits", "photographs")),
    "globe": (globes.globe, ("earth",)),
    "grand piano": (pianos.grand_piano, ()),
    "grandfather clock": (clocks.grandfather_clock, ("longcase clock",)),
    "hand sanitizer": (washing.hand_sanitizer, ("soap dispenser", "sanitizer", "dispenser", "towel dispenser")),
    "hand sanitizer stand": (washing.sanitizer_stand, ("sanitizer stand",)),
    "hanging planets": (globes.hanging_planets, ("hanging sculpture", "orrery", "solar system")),
    "hanging sign": (signs.hanging_sign, ("overhead sign", "wayfinding sign")),
    "high table": (tables.high_table, ("bar table", "standing table", "standing desk")),
    "information panel": (panels.information_panel, ("photo panel", "timeline panel", "panel", "info board", "information board", "sea chart", "chart", "wall text", "diagram", "timeline")),
    "kiosk": (screens.kiosk, ("information kiosk", "check-in kiosk", "info point", "atm", "cash machine")),
    "kitchen counter": (counters.kitchen_counter, ("kitchenette", "worktop")),
    "ladder": (racks.ladder, ("step ladder", "stepladder")),
    "listening horn": (earth_science.listening_horn, ("horn",)),
    "lockers": (lockers.lockers, ("coat lockers", "gym lockers")),
    "mailboxes": (lockers.mailboxes, ("pigeonholes", "letter boxes")),
    "menu board": (panels.menu_board, ("menu", "chalkboard", "blackboard", "directory board", "directory", "price list", "letter board")),
    "microwave": (kitchen.microwave, ("microwave oven",)),
    "mirror": (pictures.mirror, ()),
    "mural": (pictures.mural, ("graffiti", "mosaic", "fresco")),
    "notice board": (panels.notice_board, ("bulletin board", "pinboard", "cork board", "message board", "board")),
    "painting": (pictures.painting, ("picture", "artwork", "portrait", "photo", "photograph", "drawing", "print")),
    "paper shelf": (shelves.paper_shelf, ("pigeon holes", "paper rack", "cubby holes")),
    "parasol table": (tables.parasol_table, ("parasol", "umbrella table")),
    "person": (people.person, ("man", "woman", "pedestrian", "walking person", "guard", "mannequin", "people")),
    "photocopier": (office_machines.photocopier, ("copier", "copy machine")),
    "piano": (pianos.piano, ("upright piano",)),
    "pillar": (fixtures.pillar, ("column", "post")),
    "planet model": (globes.planet_model, ("planet", "moon", "moon model")),
    "planter": (plants.planter, ("flower bed", "flower box")),
    "poster": (panels.poster, ("placard", "advertisement", "flyer")),
    "potted plant": (plants.potted_plant, ("plant", "tree", "palm", "ficus", "bush", "flower pot", "flowers", "bamboo", "cactus")),
    "printer": (office_machines.printer, ("fax machine", "fax")),
    "queue barrier": (obstacles.queue_barrier, ("barrier", "stanchion", "rope barrier", "crowd barrier")),
    "recycling bin": (bins.recycling_bin, ("bin", "recycling container")),
    "recycling bins": (bins.recycling_bins, ("bins", "waste station", "recycling station", "sorting bins")),
    "refrigerator": (kitchen.refrigerator, ("fridge", "freezer")),
    "restroom sign": (signs.restroom_sign, ("toilet sign", "bathroom sign", "washroom sign", "wc sign")),
    "robot": (statues.robot, ("humanoid robot", "android", "guide robot")),
    "robot arm": (science.robot_arm, ("industrial robot",)),
    "rock": (earth_science.rock, ("meteorite", "stone", "boulder", "mineral", "crystal")),
    "rocket": (spaceflight.rocket, ("rocket model", "model rocket", "launcher")),
    "rocket engine": (spaceflight.rocket_engine, ("jet engine",)),
    "room number sign": (signs.room_number_sign, ("door plate", "name plate", "door sign", "plaque", "nameplate", "room number", "room sign")),
    "round table": (tables.round_table, ("cafe table", "bistro table", "small table")),
    "sculpture": (statues.sculpture, ("installation", "monument", "totem", "abstract sculpture")),
    "seismograph": (earth_science.seismograph, ("drum recorder",)),
    "shop window": (panes.shop_window, ("shop front", "storefront", "display window")),
    "sign": (signs.sign, ("signboard", "library sign", "floor number sign", "label", "floor sign", "logo", "door number", "neon sign")),
    "sink": (kitchen.sink, ("wash basin", "washbasin", "basin", "hand basin")),
    "dinosaur skeleton": (bones.skeleton, ("dinosaur", "t-rex", "fossil skeleton")),
    "sofa": (seats.sofa, ("couch", "settee", "love seat")),
    "space station module": (spaceflight.space_station_module, ("space station", "space capsule", "airlock", "module")),
    "space suit": (people.space_suit, ("astronaut", "spacesuit", "diving suit")),
    "stacked chairs": (seats.stacked_chairs, ("stack of chairs", "chair stack")),
    "statue": (statues.statue, ("figure", "memorial")),
    "stool": (seats.stool, ("bar stool", "ottoman", "pouf")),
    "stroller rack": (wheels.stroller_rack, ("strollers", "stroller", "pram", "pushchair", "buggy", "pushchairs")),
    "submersible": (water.submersible, ("submarine", "bathyscaphe")),
    "suitcase": (vehicles.suitcase, ("luggage", "trolley case")),
    "sundial": (weather.sundial, ()),
    "switch board": (safety.switch_board, ("electrical box", "fuse box", "switchboard", "electrical panel", "electrical cabinet", "control panel", "meter box")),
    "table": (tables.table, ("dining table", "side table", "work table", "trestle table", "picnic table")),
    "telescope": (weather.telescope, ("binoculars",)),
    "ticket machine": (vending.ticket_machine, ("vending kiosk", "payment machine", "change machine", "machine")),
    "touch screen": (screens.touch_screen, ("touchscreen", "interactive table", "game station")),
    "traffic cone": (obstacles.traffic_cone, ("cone", "caution cone")),
    "trash can": (bins.trash_can, ("waste bin", "garbage can", "rubbish bin", "wastebasket", "waste basket", "trash bin", "litter bin", "garbage bin", "ashtray", "bucket", "dustbin")),
    "tray rack": (racks.tray_rack, ("tray return", "tray stand", "tray cart")),
    "trolley": (wheels.trolley, ("service trolley", "cart", "cleaning cart", "luggage cart", "book cart", "wagon", "shopping cart", "janitor cart")),
    "umbrella stand": (racks.umbrella_stand, ("umbrella rack",)),
    "vending machine": (vending.vending_machine, ("snack machine", "drinks machine", "drink machine", "soda machine", "beverage machine")),
    "video wall": (screens.video_wall, ("led wall",)),
    "viewing window": (panes.viewing_window, ("observation window",)),
    "wall shelf": (shelves.wall_shelf, ("shelf", "ledge")),
    "water cooler": (kitchen.water_cooler, ("water dispenser", "cooler")),
    "wave tank": (water.wave_tank, ("water tank", "water table", "tank")),
    "weather mast": (weather.anemometer, ("anemometer", "weather station", "wind vane", "weather vane")),
    "whale skeleton": (bones.whale_skeleton, ("fish skeleton", "hanging skeleton")),
    "wheelchair": (wheels.wheelchair, ()),
    "whiteboard": (panels.whiteboard, ("flip chart", "flipchart", "white board")),
    "window": (panes.window, ("large window", "skylight")),
    "world map": (panels.world_map, ()),
}  # fmt: skip
"""Name of each archetype: what builds it, and the other categories that look so."""


def archetype_of(category: str) -> str | None:
    """Return the archetype of a category of a site plan.

    Returns:
        Its name, a key of `ARCHETYPES`; None for a category that nothing is known of,
        which is shown as a box with its name.
    """
    names = _names()
    for phrase in _phrases(category):
        for form in (phrase, _singular(phrase)):
            if form in names:
                return names[form]
    return None


def model_for_landmark(landmark: Landmark, looks: Looks = "own") -> ObjectModel:
    """Return how a landmark looks.

    Landmarks that differ in nothing one sees share one model.
    """
    if is_window(landmark):
        return window_model(landmark)
    return model_of(
        landmark.category,
        landmark.size,
        colour_words=landmark.color,
        text=landmark.text,
        name=landmark.name,
        mount=landmark.mount,
        variant=zlib.crc32(landmark.id.encode()) % VARIANTS,
        looks=looks,
    )


@cache
def model_of(
    category: str,
    size: tuple[float, float, float],
    *,
    colour_words: str | None = None,
    text: str | None = None,
    name: str | None = None,
    mount: Mount = "floor",
    variant: int = 0,
    looks: Looks = "own",
) -> ObjectModel:
    """Return how a thing looks that no plan has, such as a box left in the way.

    Args:
        category: Common English noun.
        size: Length across the front, depth, height; metres.
        colour_words: As in site plans; unknown words give its usual colour.
        text: Words written on it.
        name: Proper name, which may say what it shows.
        mount: `floor`, `wall` or `ceiling`.
        variant: Which of several looks.
        looks: Whether converted furniture models may stand for it.
    """
    length, depth, height = size
    order = Order(
        category, length, depth, height, colour_words, text, name, mount, variant
    )
    if looks == "sweethome3d":
        archetype = archetype_of(category)
        piece = None if archetype is None else furniture_for(archetype, order)
        if piece is not None:
            return piece
    return _builder(order)(order).model(length, depth, height)


def _builder(order: Order) -> Callable[[Order], Assembly]:
    archetype = archetype_of(order.category)
    if archetype is None:
        return obstacles.placeholder
    if archetype == "sign" and order.mount == "ceiling":
        return signs.hanging_sign
    if archetype == "sign" and order.mount == "floor" and order.depth > 0.2:
        return signs.a_frame
    return ARCHETYPES[archetype][0]


@cache
def _names() -> dict[str, str]:
    """Return the archetype of each known category, in lower case."""
    return {
        category.lower(): archetype
        for archetype, (_, others) in ARCHETYPES.items()
        for category in (archetype, *others)
    }


def _phrases(category: str) -> list[str]:
    """Return a category, then what is left as words are taken away, best first."""
    words = re.sub(r"[_\s]+", " ", category).strip().lower().split()
    whole = [" ".join(words)] if words else []
    for word in ("of", "with", "for", "in", "on", "and"):
        if word in words[1:]:
            whole += _phrases(" ".join(words[: words.index(word, 1)]))
    return whole + [" ".join(words[start:]) for start in range(1, len(words))]


def _singular(phrase: str) -> str:
    if phrase.endswith("ches") or phrase.endswith("shes") or phrase.endswith("xes"):
        return phrase[:-2]
    if phrase.endswith("shelves"):
        return phrase[:-3] + "f"
    return phrase[:-1] if phrase.endswith("s") and not phrase.endswith("ss") else phrase
