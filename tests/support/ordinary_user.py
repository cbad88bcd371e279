"""An ordinary user of this machine, where root runs the tests."""

from __future__ import annotations

import contextlib
import os
import pwd
import subprocess
from collections.abc import Iterator


@contextlib.contextmanager
def ordinary_user() -> Iterator[str]:
    """Its name: made for this with a home folder, and removed again. It is in the user database, as firejail looks
    there."""
    name = f"preflight-{os.getpid()}"
    subprocess.run(["useradd", "--create-home", name], check=True, capture_output=True)
    try:
        yield name
    finally:
        subprocess.run(["userdel", "--remove", name], check=False, capture_output=True)


def become(name: str) -> list[str]:
    """What to put before a command that is to run as that user."""
    return ["setpriv", f"--reuid={name}", f"--regid={pwd.getpwnam(name).pw_gid}", "--clear-groups"]
