"""In which launch an open file is shown: the one place where that is decided, for all that speaks of a file.

The root that was chosen or watched last counts for every file that it reaches. Else the roots count that the settings
name. Then a launch file that needs nobody, as all of its arguments have values, is launched alone. Any other file is
shown in the launch in which an open one is shown that reaches it, or in the one of which most is known. What was
decided so once stays, as long as that launch reaches the file.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.workspace.facts import FileFacts
from preflight_analysis.workspace.handed_over import roots_naming
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.workspace import Workspace

from preflight_server.lsp.choice_store import ChoiceStore
from preflight_server.lsp.launch_documents import is_handed_over, may_be_parameter_file

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session

MAX_ROOTS = 8
"""How many of the roots that reach a file are analysed while it is open, the one that it is shown in first."""
MAX_CHOSEN = 16
"""How many choices are remembered, the latest."""


class RootChoice:
    """Of one session; use it on the event loop."""

    def __init__(self, server: PreflightServer, session: Session) -> None:
        self._server = server
        self._session = session
        self._store = ChoiceStore()
        self._folder: str | None = None
        self.open: list[str] = []
        """Paths of open launch files, and of what these may hand over, the one that was last opened or edited
        first."""
        self.chosen: Mapping[Root, frozenset[str]] = {}
        """The roots that the user chose, the latest first, and the files that each reaches."""
        self._settled: dict[str, Root] = {}
        """What was decided for open files."""
        self._naming: dict[str, tuple[WorkspaceIndex, tuple[Root, ...]]] = {}
        """Of files that no analysed launch is known to hand over: the roots that seem to, by an index."""
        self._alone: dict[str, tuple[FileFacts, bool]] = {}

    def to_front(self, path: str) -> None:
        """A file was opened or edited."""
        self.open = [path, *(p for p in self.open if p != path)]

    def leave(self, path: str) -> None:
        """A file is not open any more, or none that is shown."""
        self.open = [p for p in self.open if p != path]
        self._naming.pop(path, None)
        self._settled.pop(path, None)

    # What the user chooses

    def load(self, folder: str | None) -> Mapping[Root, frozenset[str]]:
        """What was chosen in a folder, of the files that are still there. Call it in a thread."""
        known = self._store.load(folder) if folder is not None else {}
        return {root: files for root, files in known.items() if os.path.isfile(root.path)}

    def take(self, folder: str | None, chosen: Mapping[Root, frozenset[str]]) -> None:
        """What was chosen in a folder earlier counts, unless that was known already."""
        if folder != self._folder:
            self._folder, self.chosen = folder, chosen

    async def choose(self, root: Root, reached: Iterable[str]) -> None:
        """The user chose a root, or launches it: it counts for all that it reaches, from now on."""
        await self._keep({root: frozenset(reached), **{r: files for r, files in self.chosen.items() if r != root}})

    def known_to_reach(self, root: Root, path: str) -> Iterable[str]:
        """The files that a root reaches, where a file is known to be one of them; else none."""
        analysis, entry = self._session.analyses.all.get(root), self._session.indexing.index.entries.get(root)
        if analysis is not None and self._session.analyses.is_current(analysis):
            return analysis.reached if analysis.reaches(path) else ()
        return (*entry.files, *entry.inputs) if entry is not None and path in entry.inputs else ()

    async def unchoose(self, path: str) -> None:
        """A file is to be shown as if nobody had chosen anything for it."""
        await self._keep({root: files for root, files in self.chosen.items() if path not in files})

    async def _keep(self, chosen: Mapping[Root, frozenset[str]]) -> None:
        self.chosen = dict(list(chosen.items())[:MAX_CHOSEN])
        self._settled.clear()
        self._session.analyses.ask_again()
        await self._session.interrupt()
        await self._save()

    async def _save(self) -> None:
        if (folder := self._session.folder) is not None:
            await self._session.in_pool(partial(self._store.save, folder, self.chosen))

    def _chosen_for(self, path: str) -> Iterator[Root]:
        return (root for root, files in self.chosen.items() if path in files or root.path == path)

    # What there is to choose from

    def of(self, path: str) -> list[Root]:
        """The roots that reach a launch file, or to which another file is handed over, the one that it is shown in
        first. None reads a file that is something else."""
        found, is_launched = [*dict.fromkeys(self._ranked(path))], self.is_launched(path)
        if not is_launched:
            found = [root for root in found if root.path != path]  # it was a launch file when that was decided
        first = next((root for root in found if not self._is_refuted(root, path)), None)
        if first is None and is_launched:
            first = Root(path)
        return [*dict.fromkeys((first, *found))] if first is not None else found

    def _ranked(self, path: str) -> Iterator[Root]:
        index, settled = self._session.indexing.index, self._settled.get(path)
        yield from self._chosen_for(path)
        if self.is_launched(path):
            known = index.roots_of(path)
            yield from (root for root in self._session.indexing.named if root in known)
            if self._stands_alone(index.files.get(path)):
                yield Root(path)
            yield from (settled,) if settled in known else ()
            yield from known
            return
        readers = self._readers(path)
        yield from (root for root in self._session.indexing.named if root in readers)
        yield from (settled,) if settled is not None else ()
        yield from self._followed(path)
        yield from readers

    def _readers(self, path: str) -> Sequence[Root]:
        """The roots that read, or hand over, a file that is no launch file."""
        index = self._session.indexing.index
        if not self.is_handed_over(path):
            return index.roots_reading(path) or self._analysed(path)
        return self._analysed(path) or (*index.roots_reading(path), *self._naming.get(path, (index, ()))[1])

    def _followed(self, path: str) -> Iterator[Root]:
        """The roots that open launch files are shown in and that read the file."""
        launched = (each for each in self.open if each != path and self.is_launched(each))
        return (root for each in launched for root in self.of(each)[:1] if self._reads(root, path))

    def _reads(self, root: Root, path: str) -> bool:
        analysis = self._session.analyses.all.get(root)
        entry = self._session.indexing.index.entries.get(root)
        return analysis.reaches(path) if analysis is not None else entry is not None and path in entry.inputs

    def _is_refuted(self, root: Root, path: str) -> bool:
        """Whether the root was analysed, and does not reach the file as it is now."""
        analysis = self._session.analyses.all.get(root)
        return analysis is not None and self._session.analyses.is_current(analysis) and not analysis.reaches(path)

    def is_launched(self, path: str) -> bool:
        """Whether a file may be launched: it is not open as one that launches hand over."""
        document = self._server.texts.by_path(path)
        return document is None or not (is_handed_over(document) or may_be_parameter_file(document))

    def _stands_alone(self, facts: FileFacts | None) -> bool:
        if facts is None:
            return False
        known = self._alone.get(facts.path)
        if known is None or known[0] is not facts:
            known = self._alone[facts.path] = facts, facts.stands_alone
        return known[1]

    def is_handed_over(self, path: str) -> bool:
        """Whether an open file is one that launches hand over: it is never launched itself."""
        document = self._server.texts.by_path(path)
        return document is not None and is_handed_over(document)

    def _analysed(self, path: str) -> tuple[Root, ...]:
        """The roots that are analysed and to which the file is handed over."""
        analyses = self._session.analyses.all.items()
        return tuple(root for root, each in analyses if path not in each.tree.files and each.document(path) is not None)

    # What is decided

    def settle(self, workspace: Workspace) -> None:
        """Decide for the open files, now that all is known of them. Where the launch that was decided for does not
        reach a file any more, the user is told. For those that no analysed launch reads, look in the background."""
        index, analyses = self._session.indexing.index, self._session.analyses
        for root, files in self.chosen.items():
            analysis = analyses.all.get(root)
            if analysis is not None and analyses.is_current(analysis) and (now := analysis.reached) != files:
                self.chosen = {**self.chosen, root: now}
                self._server.spawn(self._save())
        for path in self.open if index.complete else ():
            found = self.of(path)
            if found and found[0] in analyses.all:
                before = self._settled.get(path)
                self._settled[path] = found[0]
                if before not in (None, found[0]):
                    self._tell(path, found[0])
            known = self._naming.get(path)
            if (known is None or known[0] is not index) and self.is_handed_over(path) and not self._analysed(path):
                self._naming[path] = (index, known[1] if known is not None else ())
                self._server.spawn(self._find(workspace, index, path))

    def _tell(self, path: str, root: Root) -> None:
        given = "".join(f" {name}:={value}" for name, value in root.args)
        name, by = os.path.basename(path), os.path.basename(root.path)
        how = f"on its own{given}" if root.path == path else f"as launched by {by}{given}"
        text = f"ros-preflight: {name} is now analysed {how}."
        self._server.window_show_message(types.ShowMessageParams(types.MessageType.Info, text))

    async def _find(self, workspace: Workspace, index: WorkspaceIndex, path: str) -> None:
        sources, environment = workspace.sources, workspace.environment
        found = await self._session.in_pool(partial(roots_naming, index, sources, environment, path))
        known = self._naming.get(path)
        if known is not None and known[0] is index and known[1] != found:
            self._naming[path] = (index, found)
            self._session.analyses.ask_again()

    def shown(self) -> Iterator[tuple[str, Root]]:
        """The open files, each with the root that it is shown in."""
        for path in self.open:
            root = next(iter(self.of(path)), None)
            if root is not None:
                yield path, root

    def others(self) -> list[Root]:
        """All roots that reach open files, as many of each as are analysed."""
        return list(dict.fromkeys(root for path in self.open for root in self.of(path)[:MAX_ROOTS]))
