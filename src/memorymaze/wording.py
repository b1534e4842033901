"""How numbers are said, and texts shown."""


def counted(number: int, what: str) -> str:
    """Return a number with its noun.

    >>> counted(1, "plan"), counted(0, "plan")
    ('1 plan', '0 plans')
    """
    return f"{number} {what}{'' if number == 1 else 's'}"


def single_spaced(text: str) -> str:
    r"""Return a text that somebody typed with single spaces between words.

    >>> single_spaced(" Go  on,\n then\tstop.")
    'Go on, then stop.'
    """
    return " ".join(text.split())
