"""Which environment variables are nobody's business."""

from __future__ import annotations

import re

_SECRET = re.compile("TOKEN|SECRET|PASS|KEY|CREDENTIAL|AUTH|COOKIE", re.IGNORECASE)


def is_secret(name: str) -> bool:
    """Whether the value of the variable may be one that nothing in the sandbox should see."""
    return _SECRET.search(name) is not None
