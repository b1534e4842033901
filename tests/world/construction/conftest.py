from functools import cache

import pytest

from memorymaze.world.construction import BUILDING_KINDS, make_building


@cache
def made_site(kind):
    """Return a building of a kind, made once."""
    return make_building(kind, 2)


@pytest.fixture(params=BUILDING_KINDS)
def site(request):
    """Return a made floor of each kind."""
    return made_site(request.param)
