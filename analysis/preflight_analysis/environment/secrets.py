"""Which environment variables are nobody's business."""

from __future__ import annotations

import re

_SECRET = re.compile("TOKEN|SECRET|PASS|KEY|CREDENTIAL|AUTH|COOKIE", re.IGNORECASE)
_WITH_PASSWORD = re.compile(r"://[^/?#\s@:]*:[^/?#\s@]+@")


def is_secret(name: str, value: str) -> bool:
    """Whether a variable has a value that nothing in the sandbox should see, by its name or, as an address with a
    password in it has (RFC 3986, section 3.2.1), by the value."""
    return _SECRET.search(name) is not None or _WITH_PASSWORD.search(value) is not None
