import json
from functools import cache

import pytest

from memorymaze.construction import BUILDING_KINDS, make_building
from memorymaze.sites.loading import sound_site
from memorymaze.sites.reading import understand_plan


@cache
def made_building(kind):
    """Return a building of a kind, made once."""
    return make_building(kind, 2)


@cache
def made_site(kind):
    building = made_building(kind)
    return sound_site(understand_plan(json.loads(building.plan)), building.name)


@pytest.fixture(params=BUILDING_KINDS)
def site(request):
    """Return a made floor of each kind."""
    return made_site(request.param)
