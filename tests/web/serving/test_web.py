"""The application that all pages share, over real connections."""

import re
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from typing import Any

import httpx2
import pytest
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route

from memorymaze.basics.errors import SettingsError
from memorymaze.web.serving.web import (
    RateLimit,
    ServedApplication,
    make_app,
    render,
    serving,
)


async def show(request: Request) -> Response:
    return render(
        request, "error.html", status=200, text=request.query_params.get("text", "")
    )


async def take(request: Request) -> Response:
    if "content-type" not in request.headers:
        return PlainTextResponse(await request.body())
    return PlainTextResponse(str((await request.form())["text"]))


def fail(request: Request) -> Response:
    raise RuntimeError("the secret of /etc/passwd")


ROUTES = [
    Route("/", show),
    Route("/take", take, methods=["POST"]),
    Route("/fail", fail),
]


@contextmanager
def visiting(
    routes: Sequence[Route] = ROUTES, **limits: Any
) -> Generator[httpx2.Client]:
    with (
        serving(ServedApplication(make_app(routes, **limits))) as [address],
        httpx2.Client(base_url=address) as client,
    ):
        yield client


@pytest.fixture
def client() -> Generator[httpx2.Client]:
    with visiting() as client:
        yield client


def token_of(page: httpx2.Response) -> str:
    found = re.search(r'name="csrf-token" content="(\w+)"', page.text)
    assert found
    return found[1]


def test_pages_carry_headers_that_keep_foreign_scripts_out(
    client: httpx2.Client,
) -> None:
    for path in ("/", "/nowhere", "/static/study.css"):
        headers = client.get(path).headers
        assert "default-src 'self'" in headers["content-security-policy"]
        assert headers["x-content-type-options"] == "nosniff"
    assert client.get("/").headers["cache-control"] == "no-store"


def test_texts_of_others_are_escaped(client: httpx2.Client) -> None:
    page = client.get("/", params={"text": "<script>alert(1)</script>\x1b"}).text
    assert "&lt;script&gt;alert(1)" in page
    assert "<script>" not in page
    assert "\x1b" not in page


def test_a_form_of_our_own_page_is_taken(client: httpx2.Client) -> None:
    token = token_of(client.get("/"))
    sent = client.post("/take", data={"text": "left & right", "csrf_token": token})
    assert (sent.status_code, sent.text) == (200, "left & right")
    by_script = client.post("/take", content=b"draft", headers={"X-CSRF-Token": token})
    assert (by_script.status_code, by_script.text) == (200, "draft")


def test_a_form_outlives_a_restart_of_the_server() -> None:
    with visiting() as before:
        token = token_of(before.get("/"))
        cookies = dict(before.cookies)
    with visiting() as after:
        after.cookies.update(cookies)
        sent = after.post("/take", data={"text": "kept", "csrf_token": token})
    assert sent.text == "kept"


@pytest.mark.parametrize(
    ("token", "headers"),
    [
        pytest.param(None, {}, id="no token"),
        pytest.param("0" * 64, {}, id="guessed token"),
        pytest.param("ü", {}, id="a token that is no ASCII"),
        pytest.param("right", {"Sec-Fetch-Site": "cross-site"}, id="from elsewhere"),
    ],
)
def test_forms_of_other_sites_are_refused(
    client: httpx2.Client, token: str | None, headers: dict[str, str]
) -> None:
    right = token_of(client.get("/"))
    given = right if token == "right" else token
    fields = {"text": "x"} | ({} if given is None else {"csrf_token": given})
    sent = client.post("/take", data=fields, headers=headers)
    assert sent.status_code == 403
    assert "load the page again" in sent.text


def test_the_token_of_another_browser_is_refused(client: httpx2.Client) -> None:
    client.get("/")
    with httpx2.Client(base_url=client.base_url) as other:
        token = token_of(other.get("/"))
    sent = client.post("/take", data={"text": "x", "csrf_token": token})
    assert sent.status_code == 403


def test_what_is_too_large_is_refused_also_when_its_length_is_not_told() -> None:
    with visiting(max_body=1000) as client:
        headers = {"X-CSRF-Token": token_of(client.get("/"))}
        fits = client.post("/take", content=b"x" * 1000, headers=headers)
        assert fits.status_code == 200
        told = client.post("/take", content=b"x" * 1001, headers=headers)
        assert told.status_code == 413
        chunks = client.post("/take", content=iter([b"x" * 600] * 2), headers=headers)
        assert chunks.status_code == 413


def test_more_requests_than_the_rate_are_told_to_wait() -> None:
    with visiting(rate=3) as client:
        codes = [client.get("/").status_code for _ in range(4)]
        assert codes == [200, 200, 200, 429]
        assert client.get("/").headers["retry-after"] == "60"


def test_who_waited_may_ask_again() -> None:
    now = 0.0
    limit = RateLimit(2, clock=lambda: now)
    assert [limit.allows("a") for _ in range(3)] == [True, True, False]
    assert limit.allows("b")
    now = 30.0
    assert [limit.allows("a") for _ in range(2)] == [True, False]


def test_other_names_of_this_machine_are_refused_where_names_are_given() -> None:
    with visiting(hosts=["127.0.0.1"]) as client:
        assert client.get("/").status_code == 200
        other = client.get("/", headers={"Host": "evil.example"})
        assert other.status_code == 403


def test_no_file_outside_the_static_ones_is_reachable(client: httpx2.Client) -> None:
    for path in ("/static/../web.py", "/static/%2e%2e/web.py", "/static//etc/passwd"):
        assert client.get(path).status_code == 404


def test_a_fault_tells_nothing_of_the_host(client: httpx2.Client) -> None:
    page = client.get("/fail")
    assert page.status_code == 500
    assert "passwd" not in page.text
    assert "Something went wrong" in page.text
    assert "content-security-policy" in page.headers


def test_a_port_in_use_is_named() -> None:
    with serving(ServedApplication(make_app(ROUTES))) as [address]:
        port = int(address.rsplit(":", 1)[1])
        with (
            pytest.raises(SettingsError, match=f"port {port}: cannot be served at"),
            serving(ServedApplication(make_app(ROUTES), port=port)),
        ):
            pass


def test_a_port_that_cannot_be_is_named() -> None:
    with (
        pytest.raises(SettingsError, match=r"to 65535, got 99999999"),
        serving(ServedApplication(make_app(ROUTES), port=99999999)),
    ):
        pass


def test_a_door_to_all_networks_has_an_address_that_can_be_opened() -> None:
    with serving(ServedApplication(make_app(ROUTES), host="0.0.0.0")) as [address]:
        assert "0.0.0.0" not in address
        assert httpx2.get(address).status_code == 200
