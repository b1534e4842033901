"""Which texts of a server count as replies; the same online and in files."""

LONGEST_REPLY = 200_000
"""Characters beyond which a reply is taken for garbage."""


def why_unusable(
    text: object, finish_reason: object = None, refusal: object = None
) -> str | None:
    """Say what is wrong with the text of an answer, or return None when it is a reply."""
    if not isinstance(text, str) or not text.strip():
        said = ""
        if isinstance(refusal, str):
            said = f"; it refuses: {' '.join(refusal.split())[:200]}"
        return f"without text in it (finish_reason {finish_reason}){said}"
    if len(text) > LONGEST_REPLY:
        return f"of {len(text)} characters, more than {LONGEST_REPLY}"
    if any("\ud800" <= each <= "\udfff" for each in text):
        return "with halves of characters in it"
    return None
