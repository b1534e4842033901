"""Bake the builders of `pictures/looks` into `pictures/data/things.glb`; used once.

Every archetype is built at the sizes that plans have, without and with words, and at
sizes a little larger along each direction. What changes with the colours of a plan, and
what pictures are drawn for, is found by building it in other colours.
"""

import functools
import io
import json
import math
import struct
import sys
import tempfile
from collections import defaultdict
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Callable

import numpy as np

real_cache = functools.cache
UNCACHED = {"_paint", "glow", "glass", "wood"}


def fresh(f):
    if f.__name__ in UNCACHED or f.__module__.endswith((".boards", ".artwork")):
        return f
    return real_cache(f)


functools.cache = fresh
from memorymaze.pictures.looks import materials

woods: dict[int, tuple] = {}
drawn: dict[int, tuple] = {}
kept: list = []
_wood = materials.wood


def tagged_wood(colour):
    made = _wood(colour)
    woods[id(made)] = colour
    kept.append(made)
    return made


materials.wood = tagged_wood
from memorymaze.pictures.looks import boards, artwork


def tag(module, name):
    real = getattr(module, name)

    def wrapper(*args, **named):
        pixels = np.array(real(*args, **named))
        drawn[id(pixels)] = (name, args, named)
        kept.append(pixels)
        return pixels

    setattr(module, name, wrapper)


for name in ("sign_board", "blank_board", "exit_board", "pictogram_board"):
    tag(boards, name)
for name in ("painting_picture", "poster_picture", "headlined", "cork_board",
             "marker_board", "film", "photo_picture", "flag_picture",
             "world_map_picture", "planet", "floor_map_picture"):
    tag(artwork, name)

from PIL import Image
from memorymaze.exporting.named_materials import linear
from memorymaze.pictures.looks import assembly as assembly_module
from memorymaze.pictures.looks.assembly import Assembly, Order, _with_uv
from memorymaze.pictures.looks.catalogue import archetypes, _names
from memorymaze.pictures.looks.bins_and_barriers import placeholder
from memorymaze.pictures.looks.materials import colours_of, shade, paint
from memorymaze.pictures.looks.shapes import Shape

A, B, C = "purple", "olive", "teal"
for each in (A, B, C):
    assert colours_of(each), each
COLOUR = {each: np.array(colours_of(each)[0]) for each in (A, B, C)}


@dataclass
class Role:
    """What a shape is made of."""
    name: str
    rgba: tuple
    emission: float = 0.0
    shininess: float = 0.1
    extras: dict = field(default_factory=dict)
    texture: Any = None

    def key(self):
        return (self.name, tuple(np.round(self.rgba, 5)), round(self.emission, 4), self.shininess,
                json.dumps(self.extras, sort_keys=True),
                None if self.texture is None else hash(self.texture.tobytes()))


@dataclass
class Piece:
    role: Role
    shape: Shape


def raw(builder, order) -> list:
    made = Assembly()
    builder(made, order)
    out = []
    for material, shapes in made.shapes.items():
        for shape in shapes:
            out.append((material, _with_uv(shape, material) if material.texture is not None else shape))
    low = np.min([s.vertices.min(0) for _, s in out], axis=0)
    high = np.max([s.vertices.max(0) for _, s in out], axis=0)
    scale = np.array((order.depth, order.length, order.height)) / np.maximum(high - low, 1e-9)
    corner = np.array((-order.depth / 2, -order.length / 2, 0.0))
    if order.category != "__part__":
        out = [(m, s.moved(*-low).scaled(*scale).moved(*corner)) for m, s in out]
    return out


def shade_of(seen, colour):
    """Factor f with seen == shade(colour, f), or None."""
    seen, colour = np.array(seen), np.array(colour)
    f = float(seen.sum() / colour.sum())
    if f <= 1.0001 and np.allclose(seen, f * colour, atol=2e-3):
        return round(min(f, 1.0), 3)
    f = float((seen - colour).sum() / (1 - colour).sum())
    if 0 < f <= 1 and np.allclose(seen, colour + (1 - colour) * f, atol=2e-3):
        return round(1 + f, 3)
    return None


PICTURE_ROLE = {
    "poster_picture": "picture:poster", "headlined": "picture:panel", "cork_board": "picture:cork board",
    "marker_board": "picture:whiteboard", "floor_map_picture": "picture:floor map",
    "world_map_picture": "picture:world map", "painting_picture": "picture:painting",
    "photo_picture": "picture:photos", "flag_picture": "picture:flag", "exit_board": "picture:exit",
}


def ground_of(entry):
    name, args, named = entry
    return {"sign_board": 3, "blank_board": 2, "pictogram_board": 4, "poster_picture": 3, "headlined": 3,
            "cork_board": 3, "floor_map_picture": 3, "world_map_picture": 3, "painting_picture": 2,
            "photo_picture": 2, "flag_picture": 2, "planet": 0}.get(name, None)


def colour_in(material):
    """(kind, colour) of a material: paint, wood, picture..."""
    if id(material) in woods:
        return "wood", woods[id(material)]
    if material.texture is not None:
        entry = drawn.get(id(material.texture))
        if entry is None:
            return "image", (1, 1, 1)
        at = ground_of(entry)
        return "drawn", (entry[1][at] if at is not None else (1.0, 1.0, 1.0))
    return "paint", material.rgba[:3]


unresolved = []


WOODEN = {"bench"}


def pieces(kind, builder, order, wooden=False) -> list:
    """Build once, with the role of each shape."""
    A, B = ("oak", "teak") if wooden else ("purple", "olive")
    for each in (A, B):
        COLOUR[each] = np.array(colours_of(each)[0])
    base = raw(builder, order)
    in_a = raw(builder, replace(order, colour_words=A))
    in_b = raw(builder, replace(order, colour_words=B))
    in_ab = raw(builder, replace(order, colour_words=f"{C} and {A}"))
    in_ac = raw(builder, replace(order, colour_words=f"{C} and {B}"))
    if not len(base) == len(in_a) == len(in_b):
        if kind not in SAID: print("   structure changes with colour:", kind, len(base), len(in_a), len(in_b)); SAID.add(kind)
        in_a = in_b = in_ab = in_ac = base
    in_oak = raw(builder, replace(order, colour_words="oak"))
    out = []
    for number, (material, shape) in enumerate(base):
        ma, mb = in_a[number][0], in_b[number][0]
        how, colour = colour_in(material)
        (ha, ca), (hb, cb) = colour_in(ma), colour_in(mb)
        extras: dict = {}
        follows = not np.allclose(ca, cb, atol=2e-3)
        f = None
        if follows:
            fa, fb = shade_of(ca, COLOUR[A]), shade_of(cb, COLOUR[B])
            if fa is None or fb is None or abs(fa - fb) > 0.01:
                unresolved.append((kind, number, how, ca, fa, fb))
                f = fa or fb or 1.0
            else:
                f = fa
        second = False
        if len(in_ab) == len(base) == len(in_ac):
            c1, c2 = colour_in(in_ab[number][0])[1], colour_in(in_ac[number][0])[1]
            second = not np.allclose(c1, c2, atol=2e-3)
        rgba = (*colour, material.rgba[3] if how != "drawn" else 1.0)
        role = Role("", rgba, material.emission, material.shininess)
        if how == "drawn":
            entry = drawn[id(material.texture)]
            fn, args, named = entry
            if fn == "film":
                role.name = "picture:video wall" if named.get("tiles", 1) == 3 else ("picture:film" if args[2] or order.text is None else "picture:screen")
                if kind == "computer terminal": role.name = "picture:screen"
            elif fn == "planet":
                role.name = "picture:banded planet" if named.get("banded") else "picture:planet"
            elif fn == "pictogram_board":
                role.name = {"AED": "picture:heart", "restroom sign": "picture:restroom sign"}.get(kind, "picture:sign")
            elif fn == "blank_board":
                role.name = "words:back"
            elif fn == "sign_board":
                role.name = {"menu board": "picture:menu", "sign": "picture:sign"}.get(kind, "words:framed" if named.get("framed") else "words")
                if order.text is None and kind not in ("menu board", "sign"):
                    said = args[2]
                    extras["text"] = said.replace(order.category, "{category}") if said else ""
            else:
                role.name = PICTURE_ROLE[fn]
            if follows and f is not None:
                extras["shade"] = f
        elif how == "image":
            role.name, role.texture, role.rgba = "image", material.texture, (1, 1, 1, material.rgba[3])
        elif second and not follows:
            role.name = "second"
        elif follows:
            role.name = "body:wood" if how == "wood" else "body"
            if f != 1.0:
                extras["shade"] = f
        elif how == "paint" and len(in_oak) == len(base) and colour_in(in_oak[number][0])[0] == "wood":
            role.name = "trim"
        else:
            role.name = "wood" if how == "wood" else ("glass" if material.rgba[3] < 1 else "paint")
        if kind == "clock" and role.name == "body":
            extras["shade"] = 0.35
        role.extras = extras
        out.append(Piece(role, shape))
    return out


SAID: set = set()


def signature(found):
    return tuple((p.role.name, len(p.shape.vertices), len(p.shape.faces)) for p in found)


def geometry(found):
    return tuple((p.role.key(), p.shape.vertices.round(4).tobytes()) for p in found)


@dataclass
class Node:
    kind: str
    size: tuple
    found: list
    targets: list
    extras: dict = field(default_factory=dict)
    children: list = field(default_factory=list)


def with_targets(kind, builder, order, extras=None) -> Node:
    found = pieces(kind, builder, order, kind == "bench" and builder is builder_of(kind))
    sign = [(len(s.vertices), len(s.faces)) for _, s in raw(builder, order)]
    targets = []
    for what in ("length", "depth", "height"):
        at = getattr(order, what)
        ends = {}
        for way in (1, -1):
            for share in (0.12, 0.06, 0.03, 0.01, 0.003):
                step = way * share * at
                other = raw(builder, replace(order, **{what: at + step}))
                if [(len(s.vertices), len(s.faces)) for _, s in other] == sign:
                    ends[way] = (step, other)
                    break
        if not ends:
            print("   no way to stretch", kind, what, order)
            targets.append([np.zeros_like(p.shape.vertices) for p in found])
            continue
        base = raw(builder, order)
        (s1, one), (s0, zero) = ends.get(1, (0.0, base)), ends.get(-1, (0.0, base))
        targets.append([(a.vertices - b.vertices) / (s1 - s0) for (_, a), (_, b) in zip(one, zero)])
    return Node(kind, (order.length, order.depth, order.height), found, targets, dict(extras or {}))




def things_in_use() -> dict:
    """What stands on the shipped floors, and on two made ones of each kind."""
    from memorymaze.construction import BUILDING_KINDS, make_building
    from memorymaze.pictures.looks.catalogue import archetype_of
    from memorymaze.sites import load_site, load_sites

    found = defaultdict(list)
    sites = list(load_sites(None).values())
    with tempfile.TemporaryDirectory() as folder:
        for kind in BUILDING_KINDS:
            for seed in (0, 3):
                made = make_building(kind if isinstance(kind, str) else kind.name, seed)
                path = Path(folder) / f"{made.name}.geojson"
                path.write_bytes(made.plan if isinstance(made.plan, bytes) else json.dumps(made.plan).encode())
                sites.append(load_site(path))
    for site in sites:
        for m in site.landmarks:
            found[archetype_of(m.category)].append((m.size, m.mount, bool(m.text), m.color, m.category))
    return dict(found)


use = things_in_use()
USUAL = {  # archetypes that no plan has
    "A-frame": (0.6, 0.5, 1.0), "bicycle": (0.55, 1.7, 1.05), "cabinet": (1.0, 0.45, 1.9),
    "car": (3.9, 1.7, 1.45), "cardboard boxes": (0.6, 0.5, 0.8), "chair": (0.5, 0.55, 0.85),
    "desk": (1.4, 0.7, 0.74), "person": (0.55, 0.4, 1.72), "queue barrier": (1.8, 0.34, 0.95),
    "stool": (0.4, 0.4, 0.5), "suitcase": (0.45, 0.28, 1.05), "traffic cone": (0.36, 0.36, 0.7),
}
MORE = {"brochure rack": [],  # sizes besides those of plans
    "person": [(0.55, 0.85, 1.72)], "bicycle": [(1.7, 0.55, 1.05)], "car": [(1.7, 3.9, 1.45)], "animal": [(0.8, 1.6, 1.3)],
    "bench": [(1.6, 0.5, 0.85)], "cardboard boxes": [(0.5, 0.4, 0.4)], "trash can": [(0.35, 0.35, 0.45)],
    "sofa": [(0.85, 0.85, 0.8), (3.0, 0.85, 0.8)], "queue barrier": [(3.2, 0.34, 0.95)],
    "cabinet": [(0.5, 0.45, 1.8)], "exhibit panel": [(0.9, 0.5, 1.1)], "whiteboard": [(1.6, 0.5, 1.8)],
}
VARIED = {"potted plant": 6, "person": 6, "statue": 2, "sculpture": 2, "rock": 2, "city model": 1,
          "capsule toy machine": 1, "cloud chamber": 1, "core sample": 1, "planter": 1, "cardboard boxes": 2,
          "aquarium": 1, "aquarium window": 2}
FOR = {
    "display case": [("trophy", ["trophy", "award", "champion", "prize"]), ("mineral", ["mineral", "rock", "meteor", "ammon", "shell"])],
    "sculpture": [("spiral", ["spiral"]), ("fold", ["fold"])],
    "planet model": [("Jupiter", ["jupiter", "uranus", "neptune", "venus"]), ("Saturn", ["saturn"])],
}
TEXT = {"planet model": "Mars", "hanging sign": "← Lifts", "recycling bins": None, "vending machine": "Drinks"}


def evaluated(node, size):
    """Vertices of all shapes at another size, as the reader will have them."""
    deltas = [np.clip(s, 0.5 * n, 3 * n) - n for s, n in zip(size, node.size)]
    out = [p.shape.vertices + sum(d * t[i] for d, t in zip(deltas, node.targets)) for i, p in enumerate(node.found)]
    low = np.min([v.min(0) for v in out], axis=0)
    high = np.max([v.max(0) for v in out], axis=0)
    full = np.array((size[1], size[0], size[2]))
    scale = full / np.maximum(high - low, 1e-9)
    corner = np.array((-size[1] / 2, -size[0] / 2, 0.0))
    return [(v - low) * scale + corner for v in out]


def error(node, builder, order):
    actual = raw(builder, order)
    guess = evaluated(node, (order.length, order.depth, order.height))
    if [len(s.vertices) for _, s in actual] != [len(v) for v in guess]:
        return math.inf
    return max(float(np.abs(s.vertices - v).max()) for (_, s), v in zip(actual, guess))


def builder_of(kind):
    if kind == "unknown":
        return placeholder
    return archetypes()[kind].builder(kind)


def generic(kind) -> list:
    builder = builder_of(kind)
    sizes = defaultdict(int)
    for size, mount, text, *_ in use.get(kind, []):
        sizes[size] += 1
    if kind in USUAL:
        sizes[USUAL[kind]] += 1
    if kind == "sign":
        sizes = {s: n for s, n in sizes.items() if s[1] < 0.2}
    if kind == "A-frame":
        sizes = {USUAL[kind]: 1}
    for each in MORE.get(kind, []):
        sizes[each] += 1
    if not sizes:
        sizes[(1.0, 0.6, 1.2)] = 1
    mounts = sorted({u[1] for u in use.get(kind, [])}) or ["floor"]
    usual = max(sizes, key=lambda s: sizes[s])
    nodes: list[Node] = []
    seen: dict = {}
    name = {"unknown": "{category}"}.get(kind, kind)

    def order_at(size, text, mount, variant, category=None, colour=None):
        return Order(category or name, *size, colour_words=colour, text=text, mount=mount, variant=variant)

    words = TEXT.get(kind, "Information")
    if kind in ("menu board",): words = "Soup / Bread"
    mount_sets = [(mounts[0], None)]
    if kind in ("whiteboard", "exit sign", "globe"):
        mount_sets = {"whiteboard": [("wall", None), ("floor", "floor")], "exit sign": [("wall", None), ("ceiling", "ceiling")],
                      "globe": [("floor", None), ("ceiling", "ceiling")]}[kind]
    cases = [(None, None, text) for text in (words, None)]
    for example, also in FOR.get(kind, []):
        cases += [(example, also, text) for text in (words, None)]
    if kind == "drop box":
        cases += [("clear", ["clear", "glass"], t) for t in (words, None)]
    if kind == "bench":
        cases += [("painted", None, None)]
    for mount, only in mount_sets:
        for example, also, text in cases:
            colour = None
            category = None
            if example is not None:
                if kind == "drop box": colour = "clear"
                elif kind == "bench": colour = "blue"
                elif kind == "planet model": text = example if text else text
                else: category = f"{example} {kind}"
            if kind == "planet model" and example and text is None:
                continue
            for variant in range(VARIED.get(kind, 1)):
                todo = dict(sorted(sizes.items(), key=lambda kv: -kv[1]))
                mine: list[Node] = []
                while todo:
                    size = next(iter(todo))
                    order = order_at(size, text, mount, variant, category)
                    if kind in ("drop box", "bench") and colour:
                        real = builder
                        def forced(made, o, real=real, colour=colour):
                            real(made, replace(o, colour_words=o.colour_words if kind == "bench" and o.colour_words else colour))
                        node = with_targets(kind, forced, order)
                        the = forced
                    else:
                        node = with_targets(kind, builder, order)
                        the = builder
                    if text is not None:
                        none = pieces(kind, the, replace(order, text=None), kind == "bench" and the is builder)
                        same = [p.role.name for p in none] == [p.role.name for p in node.found]
                        for number, p in enumerate(node.found):
                            p.role.extras.pop("text", None)
                            if p.role.name.startswith("words"):
                                if kind in DEFAULTS: p.role.extras["text"] = DEFAULTS[kind]
                                elif same and "text" in none[number].role.extras: p.role.extras["text"] = none[number].role.extras["text"]
                    elif any(p.role.name.startswith("words") for p in node.found):
                        print("   words without a text:", kind, [p.role.extras for p in node.found if p.role.name.startswith("words")])
                    if only: node.extras["mount"] = only
                    if also: node.extras["for"] = also
                    mine.append(node)
                    for other in list(todo):
                        if other == size or error(node, the, order_at(other, text, mount, variant, category)) < TOLERANCE:
                            del todo[other]
                        elif kind in FEW and len(mine) >= FEW[kind]:
                            del todo[other]
                for node in mine:
                    key = (node.extras.get("mount"), tuple(node.extras.get("for", ())), geometry(node.found))
                    if key in seen: continue
                    # What is the same but for its words needs only the one with words.
                    bare = [p for p in node.found if not p.role.name.startswith("words")]
                    bkey = (node.extras.get("mount"), tuple(node.extras.get("for", ())), geometry(bare), "bare")
                    if bkey in seen and len(bare) == len(node.found): continue
                    seen[key] = seen[bkey] = True
                    nodes.append(node)
    return nodes


DEFAULTS = {"sign": "{category}", "hanging sign": "{category}", "A-frame": "{category}", "ticket machine": "Tickets",
            "eyewash station": "EYE WASH", "fire hydrant box": "FIRE HOSE", "room number sign": "", "banner": "",
            "unknown": "{category}?"}
TOLERANCE = 0.02
FEW: dict = {"potted plant": 1, "planet model": 2, "stroller rack": 1, "umbrella stand": 2, "city model": 1, "planter": 1, "rocket engine": 1, "space suit": 1, "rocket": 1, "pillar": 1}


from memorymaze.pictures.looks import storage, counters_and_cases, bins_and_barriers, vending
from memorymaze.pictures.looks.assembly import header
from memorymaze.pictures.looks.materials import (
    BEECH, CHARCOAL, IRON, PRINTS, SPINES, STEEL, SLATE, LIMESTONE, ALUMINIUM, BLACK, glass, metal, picture, wood, ink_on)
from memorymaze.pictures.looks.shapes import around, lathed, box
from memorymaze.pictures.looks.tubes import tube


def part(kind, builder, size, text=None, variant=0, extras=None, colour=None):
    """A node that need not fill its box."""
    order = Order("__part__", *size, text=text, variant=variant, colour_words=colour)
    return with_targets(kind, builder, order, extras)


def repeated(parent: Node, modules: dict) -> Node:
    """Hang modules {(name, repeat): [nodes]} on a node."""
    parent.extras["size"] = list(parent.size)
    for (name, *every), nodes in modules.items():
        for number, node in enumerate(nodes):
            node.extras = {"repeat": [dict(every).get(each, 0.0) for each in ("length", "depth", "height")], "size": list(node.size)}
            parent.children.append((name if len(nodes) == 1 else f"{name}.{number + 1}", node))
    return parent


def grid(kind, size, cell, rows, vents, texts):
    nodes = []
    for text in texts:
        def door(made, order, text=text):
            inner = Assembly()
            storage._door_grid(inner, replace(order, text=text), 1, rows, vents=vents)
            inner.shapes[next(iter(inner.shapes))].pop(0)
            for m, shapes in inner.shapes.items():
                if shapes and (m.texture is None or id(m.texture) not in drawn): made.add(m, *shapes)

        def frame(made, order, text=text):
            inner = Assembly()
            storage._door_grid(inner, replace(order, text=text), 1, rows, vents=vents)
            first = next(iter(inner.shapes))
            made.add(first, inner.shapes[first][0])
            for m, shapes in inner.shapes.items():
                if m.texture is not None and id(m.texture) in drawn: made.add(m, *shapes)

        nodes.append(repeated(part(kind, frame, size, text), {("door", ("length", cell)): [part(kind, door, (cell, *size[1:]))]}))
    return nodes


def filing_cabinet():
    def frame(made, order):
        made.box(paint(shade(order.colour(IRON), 0.75)), order.x.inset(0, 0.03), order.y, order.z)

    def drawer(made, order):
        colour = order.colour(IRON)
        z, rise = 0.0, order.height
        made.box(paint(colour, 0.3), order.x.end(0.05, 0.018), order.y.inset(0.01), (0.008, rise - 0.008), 0.006)
        hand = rise * 0.62
        made.box(metal(CHARCOAL), order.x.end(0.02), around(0, 0.07), (hand, hand + 0.025))
        made.box(paint((0.95, 0.95, 0.9)), order.x.end(0.02, 0.014), around(0, 0.05), (hand - 0.09, hand - 0.05))

    return [repeated(part("filing cabinet", frame, (0.9, 0.45, 1.3)),
                     {("drawer", ("length", 0.5), ("height", 0.33)): [part("filing cabinet", drawer, (0.45, 0.45, 0.325))]})]


def paper_shelf():
    def frame(made, order):
        body = order.body((0.72, 0.54, 0.35))
        made.box(body, order.x.start(0.015), order.y, order.z)
        made.box(body, order.x, order.y.end(0.0125), order.z)
        made.box(body, order.x.inset(0.015, 0.003), order.y.inset(0.0125), order.z.end(0.0125))

    def cell(made, order):
        body = order.body((0.72, 0.54, 0.35))
        made.box(body, order.x.inset(0.015, 0.0), order.y.start(0.025), order.z.inset(0, 0.001))
        made.box(body, order.x.inset(0.015, 0.003), order.y.inset(0.025, 0.0), (0, 0.025))
        rng = np.random.default_rng(order.variant)
        tall = order.height * float(rng.uniform(0.2, 0.65))
        tone = (0.96, 0.96, 0.94) if order.variant % 3 else PRINTS[order.variant % 5]
        made.box(paint(tone), order.x.inset(0.03, 0.02), order.y.inset(0.04), (0.025, 0.025 + tall))

    return [repeated(part("paper shelf", frame, (0.8, 0.3, 1.2)),
                     {("hole", ("length", 0.4), ("height", 0.3)): [part("paper shelf", cell, (0.4, 0.3, 0.3), variant=v) for v in range(5)]})]


def bookshelf():
    nodes = []
    for text in (None, "Library"):
        def frame(made, order, text=text):
            front = order.x[1]
            body = order.body(BEECH)
            made.box(body, order.x.start(0.015), order.y, order.z)
            for y in (order.y[0], order.y[1] - 0.03):
                made.box(body, order.x, (y, y + 0.03), order.z)
            made.box(body, order.x.inset(0, 0.005), order.y.inset(0.03), order.z.end(0.03))
            header(made, replace(order, text=text), order.z.end(0.2, 0.04), front - 0.02)

        def board(made, order):
            made.box(order.body(BEECH), order.x.inset(0, 0.005), order.y.inset(0.03), (0.02, 0.05))

        def books(made, order):
            rng = np.random.default_rng(100 + order.variant)
            shares = np.random.default_rng(order.variant).uniform(0.07, 0.16, 9)
            ends = np.cumsum([0, *shares]) / shares.sum()
            low, wide = order.y[0] + 0.04, order.length - 0.08
            for number in range(9):
                tall, deep = 0.28 * float(rng.uniform(0.68, 1.0)), float(rng.uniform(0.02, 0.06))
                spine = SPINES[int(rng.integers(len(SPINES)))]
                if rng.random() < 0.88:
                    made.box(paint(spine, 0.05), order.x.inset(0.03, deep),
                             (low + wide * ends[number], low + wide * ends[number + 1] - 0.008), (0.05, 0.05 + tall / 0.38 * (order.height)))

        node = part("bookshelf", frame, (1.6, 0.4, 1.7), text)
        nodes.append(repeated(node, {
            ("board", ("height", 0.38)): [part("bookshelf", board, (1.6, 0.4, 0.4))],
            ("books", ("length", 0.9), ("height", 0.38)): [part("bookshelf", books, (0.9, 0.4, 0.4), variant=v) for v in range(5)],
        }))
    return nodes


def kitchen_counter():
    def frame(made, order):
        top = order.height
        colour = order.colour(LIMESTONE)
        made.box(paint(shade(colour, 0.85)), order.x.inset(0, 0.04), order.y, (0.1, top - 0.04))
        made.box(paint(SLATE), order.x.inset(0, 0.1), order.y, (0, 0.1))
        made.box(paint((0.45, 0.43, 0.42), 0.4), order.x, order.y, order.z.end(0.04), 0.01)

    def door(made, order):
        top, colour, y = order.height, order.colour(LIMESTONE), order.y.inset(0.008)
        made.box(paint(colour, 0.3), order.x.end(0.05, 0.02), y, (0.12, top - 0.22), 0.006)
        made.box(paint(colour, 0.3), order.x.end(0.05, 0.02), y, order.z.end(0.2, 0.06), 0.006)
        for z in (top - 0.3, top - 0.14):
            made.box(metal(IRON), order.x.end(0.02, 0.002), around(0, 0.06), (z, z + 0.015))

    return [repeated(part("kitchen counter", frame, (2.0, 0.6, 0.9)), {("door", ("length", 0.5)): [part("kitchen counter", door, (0.5, 0.6, 0.9))]})]


def coat_rack():
    def frame(made, order):
        steel = metal(order.colour(STEEL))
        top, reach = order.height - 0.02, order.length / 2 - 0.02
        for side in (-1, 1):
            y = side * reach
            made.add(steel, tube([(0, y, 0.03), (0, y, top)], 0.018, 8), box(order.x, around(y, 0.018), (0, 0.03)))
        made.tube(steel, [(0, -reach, top), (0, reach, top)], 0.02, 8)

    coats = ((0.16, 0.2, 0.32), (0.45, 0.12, 0.14), (0.3, 0.34, 0.26), (0.6, 0.5, 0.36))

    def coat(made, order):
        top = order.height - 0.02
        half, thick = order.depth * 0.42, 0.05
        low = top - 0.95
        body = lathed([(0.8, low), (0.95, low + 0.3), (0.85, top - 0.25), (0.25, top - 0.1), (0.1, top - 0.05)], 10).scaled(half, thick, 1.0)
        made.add(paint(coats[order.variant], 0.02), body)
        made.tube(metal(order.colour(STEEL)), [(0, 0, top - 0.07), (0, 0, top)], 0.006, 5)

    return [repeated(part("coat rack", frame, (1.2, 0.4, 1.7)), {("coat", ("length", 0.3)): [part("coat rack", coat, (0.3, 0.4, 1.7), variant=v) for v in range(4)]})]


def display_case():
    nodes = []
    for size in ((1.7, 0.45, 1.6), (1.6, 0.6, 1.2)):
        shelves = 2 if size[2] > 1.5 else 1
        for category, also in (("display case", None), *FOR["display case"]):
            def frame(made, order):
                inner = Assembly()
                counters_and_cases._exhibits, real = (lambda *_: None), counters_and_cases._exhibits
                counters_and_cases.display_case(inner, order)
                counters_and_cases._exhibits = real
                for m, shapes in inner.shapes.items(): made.add(m, *shapes)
                if shelves == 2:
                    plinth, roof = 0.42, order.height - 0.05
                    floor = plinth + (roof - plinth) / 2
                    made.box(glass(alpha=0.45), order.x.inset(0.02, 0.03), order.y.inset(0.03), (floor - 0.012, floor))

            def exhibits(made, order, category=category):
                plinth = max(0.34, 0.3 * order.height) if order.height < 1.5 else 0.42
                roof = order.height - 0.05
                wide = replace(order, category=category, length=0.34)
                inner = Assembly()
                two = replace(wide, length=0.68)
                counters_and_cases._exhibits(inner, two, (plinth, roof))
                flat = [(m, x) for m, shapes in inner.shapes.items() for x in shapes if m.rgba[3] == 1.0]
                for m, x in flat:
                    middle = x.vertices[:, 1].mean()
                    if (middle < 0) == (order.variant % 2 == 0):
                        made.add(m, x.moved(y=0.17 if middle < 0 else -0.17))

            node = part("display case", frame, size, "Information", extras={"for": also} if also else {})
            nodes.append(repeated(node, {("exhibit", ("length", 0.34)): [part("display case", exhibits, (0.34, *size[1:]), variant=v) for v in range(3)]}))
    return nodes


def recycling_bins():
    nodes = []
    for count in (2, 3, 4):
        def bins(made, order, count=count):
            bins_and_barriers.recycling_bins(made, replace(order, text=" / ".join(f"Bin {n}" for n in range(count))))
        node = with_targets("recycling bins", bins, Order("bins", 0.45 * count, 0.45, 1.0))
        number = 0
        for p in node.found:
            if p.role.name == "words":
                p.role.extras = {"part": number, "text": ("Cans", "Paper", "Glass", "Rest")[number]}
                number += 1
        nodes.append(node)
    return nodes


def vending_machine():
    nodes = []
    for text in ("Drinks", None):
        for variant, boxed in ((0, False), (3, False), (1, True)):
            def machine(made, order, text=text, variant=variant, boxed=boxed):
                colour = order.colour((0.79, 0.13, 0.13))
                made.box(paint(colour, 0.3), order.x.inset(0, 0.03), order.y, (0.06, order.height), 0.02)
                made.box(paint(BLACK), order.x.inset(0.05, 0.08), order.y.inset(0.04), (0, 0.06))
                h = order.height - 0.1
                pixels = np.array(vending._vending_front(order.length, h, "Drinks" if text else "", (0.5, 0.5, 0.5), boxed, variant))
                rows, columns = pixels.shape[:2]
                head = 0.17 if text else 0.04
                y0, y1, wide = order.y[0] + 0.02, order.y[1] - 0.02, order.length - 0.04
                z0, tall = 0.08, order.height - 0.1
                made.box(paint(colour, 0.3), order.x.end(0.05, 0.012), (y0, y1), (z0, z0 + tall))
                goods = np.ascontiguousarray(pixels[int(head * rows):int(0.8 * rows), int(0.06 * columns):int(0.74 * columns)])
                made.plate(picture(goods, 0.3), order.x.end(0.05, 0.01), (y0 + 0.06 * wide, y0 + 0.74 * wide), (z0 + 0.2 * tall, z0 + (1 - head) * tall))
                for row in range(6):
                    z = z0 + tall * (1 - head - 0.06 - 0.06 * row)
                    made.box(paint((0.85, 0.86, 0.88)), order.x.end(0.05, 0.008), (y0 + 0.8 * wide, y0 + 0.92 * wide), (z - 0.035 * tall, z))
                made.box(paint((0.1, 0.5, 0.35)), order.x.end(0.05, 0.008), (y0 + 0.79 * wide, y0 + 0.93 * wide), (z0 + tall * (1 - head - 0.045), z0 + tall * (1 - head - 0.01)))
                made.words(text, colour, order.x.end(0.05, 0.01), (y0, y1), (z0 + (1 - 0.16) * tall, z0 + tall))
                made.box(paint(BLACK), order.x.end(0.02), order.y.start(0.1 * order.length, 0.68 * order.length), (0.2, 0.36), 0.008)
                made.box(metal(ALUMINIUM), order.x.end(0.02), order.y.start(0.8 * order.length, 0.92 * order.length), (0.9, 1.02))
            extras = {"for": ["snack", "food", "sandwich"]} if boxed else {}
            nodes.append(with_targets("vending machine", machine, Order("vending machine", 0.95, 0.75, 1.85), extras))
    return nodes


CUSTOM = {
    "lockers": lambda: grid("lockers", (1.8, 0.4, 1.8), 0.4, 1, True, (None, "Lockers")),
    "coin lockers": lambda: grid("coin lockers", (1.8, 0.5, 1.8), 0.42, 4, False, (None, "Lockers")),
    "mailboxes": lambda: grid("mailboxes", (1.6, 0.35, 1.6), 0.3, 5, False, (None, "Letters")),
    "filing cabinet": filing_cabinet, "paper shelf": paper_shelf, "bookshelf": bookshelf,
    "kitchen counter": kitchen_counter, "coat rack": coat_rack, "display case": display_case,
    "recycling bins": recycling_bins, "vending machine": vending_machine,
}


SCALED = {"core sample", "seismograph", "space suit", "trash can", "umbrella stand", "wheelchair"}
"""Kinds whose parts would turn inside out at other sizes."""


def needed_targets(node) -> list:
    """The directions in which scaling does not do what targets do, to 5 mm at an eighth."""
    if node.kind in SCALED:
        return []
    reach = 0.003 if node.extras.get("repeat") else 0.005
    needed = []
    for axis in range(3):
        ours = (1, 0, 2)[axis]
        for share in (0.875, 1.125):
            step = (share - 1) * node.size[axis]
            worst = 0.0
            for i, p in enumerate(node.found):
                v = p.shape.vertices
                two = v.copy(); two[:, ours] *= share
                worst = max(worst, float(np.abs(v + step * node.targets[axis][i] - two).max()))
            if worst > reach and axis not in needed:
                needed.append(axis)
    return needed


def all_nodes() -> dict:
    found = {}
    for kind in sorted([*archetypes(), "unknown"]):
        if kind in ("window", "shop window", "viewing window"): continue
        nodes = CUSTOM[kind]() if kind in CUSTOM else generic(kind)
        texts = [u[2] for u in use.get(kind, [])]
        if kind not in CUSTOM and len(nodes) > 1 and not any(n.extras.get("for") for n in nodes):
            wordy = [n for n in nodes if any(p.role.name.startswith("words") for p in n.found)]
            plain = [n for n in nodes if n not in wordy]
            if wordy and plain and sum(len(p.shape.vertices) for n in plain for p in n.found) > 500:
                if texts and all(texts): nodes = wordy
        found[kind] = nodes
    return found


def y_up(v):
    """From x front, y left, z up to glTF's x left, y up, z front."""
    return v[:, (1, 2, 0)]


class Writer:
    def __init__(self):
        self.binary = bytearray(); self.views = []; self.accessors = []; self.meshes = []; self.nodes = []
        self.materials = []; self.images = []; self.textures = []; self.known = {}; self.parts = {}

    def view(self, data, target=None):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target: view["target"] = target
        self.binary += data
        self.views.append(view)
        return len(self.views) - 1

    def accessor(self, array, target=34962, bounds=False):
        key = (array.tobytes(), array.dtype.str, array.shape)
        if key in self.known: return self.known[key]
        kinds = {"float32": 5126, "uint32": 5125, "uint16": 5123, "uint8": 5121}
        stride = 0 if target == 34963 else array.itemsize * array.shape[1]
        part = self.parts.setdefault((target, stride), bytearray())
        part += b"\0" * (-len(part) % 4)
        made = {"bufferView": (target, stride), "byteOffset": len(part), "componentType": kinds[array.dtype.name],
                "count": len(array), "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3"}[1 if array.ndim == 1 else array.shape[1]]}
        part += array.tobytes()
        if not array.any():
            del made["bufferView"], made["byteOffset"]
        if bounds: made |= {"min": array.min(0).tolist(), "max": array.max(0).tolist()}
        self.accessors.append(made)
        self.known[key] = len(self.accessors) - 1
        return self.known[key]

    def material(self, role):
        key = role.key()
        if key in self.known: return self.known[key]
        base = [round(x, 5) for x in linear(tuple(float(c) for c in role.rgba[:3]))] + [round(float(role.rgba[3]), 4)]
        pbr = {"baseColorFactor": base, "metallicFactor": 0.0, "roughnessFactor": round(1 - role.shininess, 3)}
        made = {"name": role.name, "pbrMetallicRoughness": pbr}
        if role.texture is not None:
            data = io.BytesIO(); Image.fromarray(role.texture).quantize(64, method=Image.Quantize.MAXCOVERAGE, kmeans=2).save(data, "PNG", optimize=True)
            self.images.append({"bufferView": self.view(data.getvalue()), "mimeType": "image/png"})
            self.textures.append({"source": len(self.images) - 1})
            pbr["baseColorTexture"] = {"index": len(self.textures) - 1}
        if role.rgba[3] < 1: made["alphaMode"] = "BLEND"
        if role.emission:
            made["emissiveFactor"] = [round(role.emission * b, 5) for b in base[:3]]
            if role.texture is not None: made["emissiveTexture"] = {"index": len(self.textures) - 1}
        if role.extras: made["extras"] = role.extras
        self.materials.append(made)
        self.known[key] = len(self.materials) - 1
        return self.known[key]

    def mesh(self, node) -> int:
        groups = {}
        axes = needed_targets(node)
        for number, p in enumerate(node.found):
            s = p.shape
            pictured = p.role.name == "image" or p.role.name.split(":")[0] in ("words", "picture")
            a, b, c = (s.vertices[s.faces[:, i]] for i in range(3))
            n = np.cross(b - a, c - a); n /= np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-12)
            flat = not pictured and bool((np.abs(s.normals[s.faces] - n[:, None]) < 2e-2).all())
            groups.setdefault((p.role.key(), flat, number if p.role.name.split(":")[0] in ("words", "picture") and p.role.name not in ("words:framed",) and False else 0), []).append((number, p))
        primitives = []
        for (key, flat, _), members in groups.items():
            role = members[0][1].role
            pictured = role.name == "image" or role.name.split(":")[0] in ("words", "picture")
            columns, faces, start = [], [], 0
            for number, p in members:
                s = p.shape
                row = [y_up(s.vertices)] + [y_up(node.targets[axis][number]) for axis in axes]
                if not flat: row.append(y_up(s.normals))
                if pictured: row.append(s.uv)
                columns.append(np.hstack(row)); faces.append(s.faces + start); start += len(s.vertices)
            rows = np.concatenate(columns)
            faces = np.concatenate(faces)
            # Equal corners only once; lengths to an eighth of a millimetre.
            many = 3 + 3 * len(axes)
            rows[:, :many] = np.round(rows[:, :many] * 8192) / 8192
            rows[:, many:] = np.round(rows[:, many:] * 1024) / 1024
            rows, where = np.unique(rows.astype(np.float32), axis=0, return_inverse=True)
            faces = where.reshape(-1)[faces]
            good = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
            faces = faces[good]
            attributes = {"POSITION": self.accessor(np.ascontiguousarray(rows[:, :3]), bounds=True)}
            at = many
            primitive = {"attributes": attributes}
            if axes:
                primitive["targets"] = [{"POSITION": self.accessor(np.ascontiguousarray(rows[:, 3 + 3 * i:6 + 3 * i]), bounds=True)} for i in range(len(axes))]
            if not flat:
                normals = rows[:, at:at + 3]; normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
                attributes["NORMAL"] = self.accessor(np.ascontiguousarray(np.round(normals * 512) / 512 if False else normals).astype(np.float32)); at += 3
            if pictured:
                attributes["TEXCOORD_0"] = self.accessor(np.ascontiguousarray(np.clip(rows[:, at:at + 2], 0, 1)))
            kind = np.uint8 if len(rows) < 256 else np.uint16
            primitive["indices"] = self.accessor(faces.astype(kind).reshape(-1), 34963)
            primitive["material"] = self.material(role)
            primitives.append(primitive)
        # All primitives of a mesh have the same targets.
        made = {"name": node.kind, "primitives": primitives}
        if axes: made["extras"] = {"targetNames": [("length", "depth", "height")[axis] for axis in axes]}
        key = ("mesh", json.dumps(made, sort_keys=True))
        if key not in self.known:
            self.meshes.append(made); self.known[key] = len(self.meshes) - 1
        return self.known[key]

    def node(self, name, node) -> int:
        made = {"name": name, "mesh": self.mesh(node)}
        if node.extras: made["extras"] = {k: ", ".join(v) if k == "for" else v for k, v in node.extras.items()}
        children = [self.node(f"{name}/{part_name}", child) for part_name, child in node.children]
        if children: made["children"] = children
        self.nodes.append(made)
        return len(self.nodes) - 1

    def write(self, path, found):
        roots = []
        place = 0
        for kind, nodes in found.items():
            for number, node in enumerate(nodes):
                at = self.node(kind if len(nodes) == 1 else f"{kind}.{number + 1}", node)
                self.nodes[at]["translation"] = [4.0 * (place % 16), 0.0, 4.0 * (place // 16)]
                place += 1
                roots.append(at)
        kinds = {}
        for (target, stride), part in self.parts.items():
            kinds[target, stride] = self.view(bytes(part), target)
            if stride: self.views[-1]["byteStride"] = stride
        for each in self.accessors:
            if "bufferView" in each: each["bufferView"] = kinds[each["bufferView"]]
        document = {"asset": {"version": "2.0", "generator": "memorymaze"}, "scene": 0, "scenes": [{"name": "things", "nodes": roots}],
                    "nodes": self.nodes, "meshes": self.meshes, "materials": self.materials, "accessors": self.accessors,
                    "bufferViews": self.views, "images": self.images, "textures": self.textures, "buffers": [{"byteLength": len(self.binary)}]}
        text = json.dumps(document, separators=(",", ":")).encode(); text += b" " * (-len(text) % 4)
        self.binary += b"\0" * (-len(self.binary) % 4)
        total = 12 + 8 + len(text) + 8 + len(self.binary)
        path.write_bytes(struct.pack("<III", 0x46546C67, 2, total) + struct.pack("<II", len(text), 0x4E4F534A) + text
                         + struct.pack("<II", len(self.binary), 0x004E4942) + bytes(self.binary))
        print("json", len(text), "binary", len(self.binary), "images", len(self.images), sum(self.views[i["bufferView"]]["byteLength"] for i in self.images),
              "nodes", len(self.nodes), "meshes", len(self.meshes), "materials", len(self.materials), "accessors", len(self.accessors))


if __name__ == "__main__" and sys.argv[1] == "write":
    found = all_nodes()
    out = Path(sys.argv[2])
    Writer().write(out, found)
    import zlib
    print(out.stat().st_size, len(zlib.compress(out.read_bytes(), 9)))
    print(sorted({(u[0], u[2]) for u in unresolved}))
