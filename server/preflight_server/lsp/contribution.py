"""The server's own settings in the manifest of the VS Code extension, so that there is one place to describe them.

`python -m preflight_server.lsp.contribution vscode-client/package.json` writes them.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path

from preflight_server.lsp.settings import SCHEMA

COMMAND = "python -m preflight_server.lsp.contribution vscode-client/package.json"


def contributed(manifest: str) -> str:
    """The manifest with the settings as the server has them now; what is the extension's own stays."""
    data = json.loads(manifest)
    properties = data["contributes"]["configuration"]["properties"]
    for name, described in SCHEMA.items():
        properties[f"rosPreflight.{name}"] = {**described, "scope": "window" if name == "runNodes" else "resource"}
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


def main(arguments: Sequence[str]) -> int:
    """The command line: one argument, the manifest."""
    if len(arguments) != 1:
        print(f"usage: {COMMAND}", file=sys.stderr)
        return 2
    path = Path(arguments[0])
    path.write_text(contributed(path.read_text(encoding="utf-8")), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
