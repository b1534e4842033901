"""The package that pages with word clouds need."""

from importlib.util import find_spec

from memorymaze.errors import SettingsError

__all__ = ["require_extra"]


def require_extra() -> None:
    """Check that the package of the extra is installed.

    Raises:
        SettingsError: It is missing; says how to get it.
    """
    if find_spec("wordcloud") is None:
        raise SettingsError(
            "--format html: needs the package wordcloud; install it with "
            "`pip install 'memorymaze[analysis]'`, or choose --format text or csv"
        )
