"""How a broken contract is told."""


def expect(kept: bool, expected: str, got: object) -> None:
    """Do nothing where a contract is kept; else say what was expected and what came."""
    if not kept:
        raise AssertionError(f"expected {expected}; got {got!r}")
