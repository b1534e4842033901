from collections import Counter

from memorymaze.texts.datasets.splits import plan_buildings
from memorymaze.world.construction import BUILDING_KINDS


def test_ninety_buildings_are_split_as_those_of_r2r() -> None:
    splits = Counter(each.split for each in plan_buildings(90, 0))
    assert splits == {"train": 61, "val_unseen": 11, "test": 18}


def test_the_fewest_buildings_still_fill_every_split() -> None:
    splits = Counter(each.split for each in plan_buildings(3, 0))
    assert splits == {"train": 1, "val_unseen": 1, "test": 1}


def test_every_kind_of_building_is_in_every_split() -> None:
    planned = plan_buildings(100, 0)
    for split, least in (("train", 7), ("val_unseen", 1), ("test", 2)):
        kinds = Counter(each.kind for each in planned if each.split == split)
        assert set(kinds) == set(BUILDING_KINDS)
        assert min(kinds.values()) >= least


def test_val_seen_has_one_route_of_every_third_building_of_train() -> None:
    planned = plan_buildings(90, 3)
    held_out = [each for each in planned if each.held_out is not None]
    assert len(held_out) == 21
    for each in held_out:
        assert each.split == "train"
        split = each.splits(["R1", "R2", "R3"])
        assert sorted(split.values()) == ["train", "train", "val_seen"]
