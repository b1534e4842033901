import pytest

from memorymaze.world.construction import BUILDING_KINDS


@pytest.fixture(params=BUILDING_KINDS)
def site(request, made_building):
    """Return a made floor of each kind."""
    return made_building(request.param)
