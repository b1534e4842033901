"""How numbers are said."""


def counted(number: int, what: str) -> str:
    """Return a number with its noun.

    >>> counted(1, "plan"), counted(0, "plan")
    ('1 plan', '0 plans')
    """
    return f"{number} {what}{'' if number == 1 else 's'}"
