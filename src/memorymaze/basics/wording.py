"""How numbers are said, and texts shown."""

_STEERING: dict[int, str] = {
    **dict.fromkeys([*range(0x20), *range(0x7F, 0xA0)], "\N{REPLACEMENT CHARACTER}"),
    **{ord("\t"): "\t", ord("\n"): "\n", ord("\r"): "\n"},
}


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
    return " ".join(printable(text).split())


def printable(text: str) -> str:
    r"""Return a text without characters that steer terminals and that no page can have.

    >>> printable("\x1b[31mred\x00\n")
    '�[31mred�\n'
    """
    return text.translate(_STEERING)
