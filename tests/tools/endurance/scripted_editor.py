"""What an editor and other programs do to a workspace, as steps of plain data that can be replayed.

A step is a list of strings and numbers. Paths are relative to the folder of all workspaces, places are offsets in code
points that are clamped, and what does not apply (an edit of a file that is not open) does nothing: so any part of a
sequence of steps is one too.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tools.endurance.lsp_process import LspProcess

Step = Sequence[Any]
CREATED, CHANGED, DELETED = 1, 2, 3
AT_PLACE = (
    "hover",
    "definition",
    "references",
    "completion",
    "signatureHelp",
    "prepareRename",
    "rename",
    "prepareCallHierarchy",
)
OF_FILE = (
    "documentSymbol",
    "semanticTokens/full",
    "semanticTokens/range",
    "codeAction",
    "foldingRange",
    "documentLink",
    "inlayHint",
    "codeLens",
)
MAX_UNANSWERED = 40
PAUSE_SECONDS = 0.7
"""Longer than the server waits after the last keystroke before it runs anything."""
_LINE_END = re.compile(r"\r\n|\r|\n")
_LANGUAGES = {".yaml": "yaml", ".yml": "yaml", ".py": "python"}


def position(text: str, at: int) -> dict[str, int]:
    """A place as LSP counts it: lines, and units of UTF-16."""
    lines = _LINE_END.split(text[:at])
    return {"line": len(lines) - 1, "character": len(lines[-1].encode("utf-16-le")) // 2}


_CONTEXTS: Mapping[str, Mapping[str, Any]] = {
    "references": {"includeDeclaration": True},
    "completion": {"triggerKind": 1},
    "signatureHelp": {"triggerKind": 1, "isRetrigger": False},
    "codeAction": {"diagnostics": []},
}


def question(method: str, uri: str, text: str, at: int) -> dict[str, Any]:
    """The parameters of a request about a place of a document."""
    where = position(text, at)
    params: dict[str, Any] = {"textDocument": {"uri": uri}, "position": where, "newName": "renamed"}
    whole = {"start": {"line": 0, "character": 0}, "end": position(text, len(text))}
    params["range"] = {"start": where, "end": where} if method == "codeAction" else whole
    return {**params, "context": _CONTEXTS[method]} if method in _CONTEXTS else params


@dataclass
class ScriptedEditor:
    """An editor with some files of a folder open, connected to a server."""

    root: Path
    server: LspProcess
    texts: dict[str, str] = field(default_factory=dict)
    """Of open documents, the one that was last opened or edited last."""
    undo: dict[str, list[str]] = field(default_factory=dict)
    edits: int = 0
    requests: int = 0
    cancelled: int = 0
    changes_on_disk: int = 0
    _versions: dict[str, int] = field(default_factory=dict)
    _asked: list[int] = field(default_factory=list)

    def do(self, step: Step) -> None:
        kind, *given = step
        getattr(self, f"_{kind}")(*given)

    def path(self, name: str) -> Path:
        return self.root / name

    def uri(self, name: str) -> str:
        return self.path(name).as_uri()

    # The editor

    def _open(self, name: str) -> None:
        if name in self.texts or (text := readable(self.path(name))) is None:
            return
        self.texts[name], self._versions[name], self.undo[name] = text, 1, []
        self.server.notify("textDocument/didOpen", {"textDocument": self._item(name)})

    def _item(self, name: str) -> dict[str, Any]:
        language = _LANGUAGES.get(Path(name).suffix, "roslaunch")
        return {"uri": self.uri(name), "languageId": language, "version": 1, "text": self.texts[name]}

    def _close(self, name: str) -> None:
        if self.texts.pop(name, None) is not None:
            self.server.notify("textDocument/didClose", {"textDocument": {"uri": self.uri(name)}})

    def _save(self, name: str) -> None:
        if name in self.texts:
            self._write(name, self.texts[name])
            self.server.notify("textDocument/didSave", {"textDocument": {"uri": self.uri(name)}})

    def _edit(self, name: str, *changes: Sequence[Any]) -> None:
        """Each change is a start, an end and a new text; a later one is of the text that an earlier one left."""
        text = self.texts.pop(name, None)
        if text is None:
            return
        self.undo[name] = [*self.undo[name][-20:], text]
        sent = []
        for start, end, new in changes:
            start, end = sorted((min(start, len(text)), min(end, len(text))))
            start -= text[start - 1 : start + 1] == "\r\n"
            end += text[end - 1 : end + 1] == "\r\n"
            sent.append({"range": {"start": position(text, start), "end": position(text, end)}, "text": new})
            text = text[:start] + new + text[end:]
        self.texts[name] = text
        self._versions[name] += 1
        self.edits += 1
        document = {"uri": self.uri(name), "version": self._versions[name]}
        self.server.notify("textDocument/didChange", {"textDocument": document, "contentChanges": sent})

    def _ask(self, method: str, name: str, at: int, cancelled: bool) -> None:
        if method == "workspace/symbol":
            number = self.server.ask(method, {"query": Path(name).stem[:2]})
        elif method.startswith("rosPreflight/"):
            number = self.server.ask(method, {"uri": self.uri(name)})
        else:
            text = self.texts.get(name, "")
            number = self.server.ask(
                f"textDocument/{method}", question(method, self.uri(name), text, min(at, len(text)))
            )
        self.requests += 1
        self._asked.append(number)
        if cancelled:
            self.cancelled += 1
            self.server.cancel(number)
        if len(self._asked) > MAX_UNANSWERED:
            self.server.answer(self._asked.pop(0))

    def _wait(self) -> None:
        """Until all is answered, so that what was typed is analysed."""
        while self._asked:
            self.server.answer(self._asked.pop(0))

    def _pause(self) -> None:
        """As long as a user has to look at something: until all is run that is to be run."""
        self._wait()
        self.server.rest(0, PAUSE_SECONDS, 60.0)

    def reopen_in(self, server: LspProcess) -> None:
        """Open the same texts in another server, in the order in which they were last looked at."""
        for name in self.texts:
            server.notify("textDocument/didOpen", {"textDocument": self._item(name)})

    # The disk

    def _write(self, name: str, text: str) -> None:
        """As editors do: a new file takes the place of what was there."""
        path = self.path(name)
        if any(parent.exists() and not parent.is_dir() for parent in path.parents):
            return
        gone = self._below(name)
        beside = path.with_name(path.name + "~")
        path.parent.mkdir(parents=True, exist_ok=True)
        beside.write_bytes(text.encode())
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        beside.replace(path)
        self._changed({**dict.fromkeys(gone, DELETED), name: CHANGED if name in gone else CREATED})

    def _delete(self, name: str) -> None:
        self._changed(dict.fromkeys(self._remove(name), DELETED))

    def _rename(self, name: str, new: str) -> None:
        """A file or a folder; open documents stay open under their old names, as after `git mv`."""
        if not os.path.lexists(self.path(name)) or os.path.lexists(self.path(new)):
            return
        gone = self._below(name)
        self.path(new).parent.mkdir(parents=True, exist_ok=True)
        self.path(name).rename(self.path(new))
        self._changed({**dict.fromkeys(gone, DELETED), **dict.fromkeys(self._below(new), CREATED)})

    def _folder(self, name: str, text: str) -> None:
        """A file becomes a folder with a file in it."""
        if not os.path.lexists(self.path(name)):
            return
        gone = self._remove(name)
        self.path(name).mkdir(parents=True)
        self.path(name).joinpath("inside.launch").write_text(text)
        self._changed({**dict.fromkeys(gone, DELETED), **dict.fromkeys(self._below(name), CREATED)})

    def _link(self, name: str, target: str) -> None:
        """A link in place of what was there; the target is as it is written into the link."""
        if not self.path(name).parent.is_dir():
            return
        gone = self._remove(name)
        self.path(name).symlink_to(target)
        self._changed({**dict.fromkeys(gone, DELETED), name: CHANGED if name in gone else CREATED})

    def _pipe(self, name: str) -> None:
        """A named pipe, which who opens it waits for."""
        if not self.path(name).parent.is_dir():
            return
        gone = self._remove(name)
        os.mkfifo(self.path(name))
        self._changed({**dict.fromkeys(gone, DELETED), name: CHANGED if name in gone else CREATED})

    def _bytes(self, name: str, hexadecimal: str) -> None:
        """No text, or one in another encoding."""
        path = self.path(name)
        if path.is_file() and not path.is_symlink():
            path.write_bytes(bytes.fromhex(hexadecimal))
            self._changed({name: CHANGED})

    def _remove(self, name: str) -> list[str]:
        gone = self._below(name)
        path = self.path(name)
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)
        return gone

    def _below(self, name: str) -> list[str]:
        """A file, or a folder with all files in it."""
        path = self.path(name)
        if not os.path.lexists(path):
            return []
        if path.is_symlink() or not path.is_dir():
            return [name]
        inner = (Path(folder, file) for folder, _, files in os.walk(path) for file in files)
        return [name, *sorted(str(each.relative_to(self.root)) for each in inner)]

    def _changed(self, kinds: Mapping[str, int]) -> None:
        if kinds:
            self.changes_on_disk += 1
            changes = [{"uri": self.uri(name), "type": kind} for name, kind in kinds.items()]
            self.server.notify("workspace/didChangeWatchedFiles", {"changes": changes})


def readable(path: Path) -> str | None:
    """The text of a regular file, None for anything else."""
    with contextlib.suppress(OSError, UnicodeDecodeError):
        if path.is_file():
            return path.read_bytes().decode()
    return None
