"""Pages behind a token: only who was given the printed address gets to them."""

import hmac

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import BaseRoute, Route


class Entrance:
    """An address that ends with a token, and the cookie that stands for it afterwards."""

    def __init__(self, token: str, cookie: str, refusal: str) -> None:
        """Let in who knows the token; others read the refusal."""
        self._token, self._cookie, self._refusal = token, cookie, refusal

    @property
    def routes(self) -> list[BaseRoute]:
        """Where one enters."""
        return [Route("/enter/{token}", self._enter)]

    def check(self, request: Request) -> None:
        """Refuse who has not got the token."""
        if not self._is(request.cookies.get(self._cookie, "")):
            raise HTTPException(403, self._refusal)

    def _is(self, given: str) -> bool:
        return hmac.compare_digest(given.encode(), self._token.encode())

    def _enter(self, request: Request) -> Response:
        given = request.path_params["token"]
        if not self._is(given):
            raise HTTPException(403, "This is not the address that the server printed.")
        response = RedirectResponse("/", status_code=303)
        response.set_cookie(
            self._cookie,
            given,
            httponly=True,
            samesite="strict",
            secure=request.url.scheme == "https",
        )
        return response
