from pathlib import Path

import httpx2
import pytest

from .conftest import Served, Visitor


def test_pages_of_the_experimenter_need_the_printed_address(served: Served) -> None:
    address = served.addresses.experimenter
    origin = address.partition("/enter/")[0]
    assert origin != served.addresses.participants
    for path in ("/", "/ethics", "/find?id=x", "/participants/x", "/enter/guess"):
        assert httpx2.get(origin + path).status_code == 403
    with httpx2.Client(follow_redirects=True) as client:
        assert "Nobody has consented yet" in client.get(address).text
        assert client.get(f"{origin}/").status_code == 200
        # The participants' address has none of them, also for the experimenter.
        for path in ("/ethics", "/enter/x", "/participants/x"):
            other = client.get(served.addresses.participants + path)
            assert other.status_code == 404


@pytest.fixture
def experimenter(served: Served, one: Visitor) -> Visitor:
    one.client.base_url = served.addresses.experimenter.partition("/enter/")[0]
    one.get(served.addresses.experimenter)
    return one


def test_progress_and_participants_are_shown(
    served: Served, experimenter: Visitor
) -> None:
    one = served.browse()
    one.reach_first_way()
    [who] = served.store.participants()
    page = experimenter.get("/")
    assert who.id in page
    assert f'<th scope="row">{who.cell}</th><td class="num">0</td>' in page
    assert "familiarity" in experimenter.get(f"/participants/{who.id}")


def test_somebody_is_found_by_the_id_of_a_platform_and_removed(
    served: Served,
    experimenter: Visitor,
) -> None:
    store = served.store
    one = served.browse()
    one.consent("?PROLIFIC_PID=5f00")
    [who] = store.participants()
    store.add_export(Path("/somewhere/first.jsonl"), [who.id])
    assert "5f00" not in experimenter.get("/")
    assert "nobody of that number" in experimenter.get("/find?id=5f01")
    assert "5f00" in experimenter.get("/find?id=5f00")
    experimenter.post(f"/participants/{who.id}/withdraw")
    assert "/somewhere/first.jsonl" in experimenter.page
    assert store.participants() == []
    assert "make these exports anew" in experimenter.get("/")
    gone = experimenter.client.get(f"/participants/{who.id}")
    assert gone.status_code == 404


def test_the_page_for_the_ethics_board_says_where_and_how_long(
    served: Served,
    experimenter: Visitor,
) -> None:
    page = experimenter.get("/ethics")
    assert "120 months" in page
    assert str(served.store.folder) in page
    assert "PROLIFIC_PID" in page
