"""The analysis' plain data to LSP types. Nothing else in the server builds diagnostics, edits or locations."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from operator import is_

from lsprotocol import types
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Text, read_text
from preflight_analysis.documents.span import LineIndex, Location, Span
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.finding import Finding, Severity
from preflight_analysis.queries.rename_edit import RenameEdit
from preflight_analysis.queries.symbols import Symbol

from preflight_server.lsp.positions import Positions
from preflight_server.lsp.rule_pages import RulePages
from preflight_server.lsp.text_store import TextStore, to_uri

SOURCE = "ros-preflight"

SEVERITIES: Mapping[Severity, types.DiagnosticSeverity] = {
    "error": types.DiagnosticSeverity.Error,
    "warning": types.DiagnosticSeverity.Warning,
    "info": types.DiagnosticSeverity.Information,
    "hint": types.DiagnosticSeverity.Hint,
}
SYMBOL_KINDS: Mapping[str, types.SymbolKind] = {
    "launch": types.SymbolKind.Module,
    "group": types.SymbolKind.Namespace,
    "include": types.SymbolKind.File,
    "node": types.SymbolKind.Class,
    "test": types.SymbolKind.Class,
    "node_container": types.SymbolKind.Class,
    "composable_node": types.SymbolKind.Class,
    "lifecycle_node": types.SymbolKind.Class,
    "executable": types.SymbolKind.Function,
    "machine": types.SymbolKind.Object,
    "arg": types.SymbolKind.Variable,
    "let": types.SymbolKind.Variable,
    "param": types.SymbolKind.Property,
    "set_parameter": types.SymbolKind.Property,
    "rosparam": types.SymbolKind.Struct,
    "remap": types.SymbolKind.Event,
    "set_remap": types.SymbolKind.Event,
    "env": types.SymbolKind.Constant,
    "set_env": types.SymbolKind.Constant,
}


@dataclass(frozen=True, slots=True)
class _OfFile:
    """The diagnostics of one file, each of the finding at its place. `places` has what all locations that they name
    were converted to, by file."""

    findings: tuple[Finding, ...]
    diagnostics: list[types.Diagnostic]
    places: Mapping[str, Mapping[Location, types.Location]]


class TextChangedError(Exception):
    """The texts of `paths` are others than those that were analysed: whoever asked has to ask again."""

    def __init__(self, paths: Sequence[str]) -> None:
        super().__init__(*paths)
        self.paths = paths


@dataclass(frozen=True, slots=True)
class EditSupport:
    """What a client knows of edits: the versions of the texts that they are for, and what is said of each."""

    versions: bool = False
    annotations: bool = False

    @classmethod
    def of(cls, capabilities: types.ClientCapabilities) -> EditSupport:
        """That of a client which says so."""
        edit = capabilities.workspace.workspace_edit if capabilities.workspace else None
        versions = bool(edit and edit.document_changes)
        return cls(versions, versions and bool(edit and edit.change_annotation_support))


class Converter:
    """Converts what speaks of files by path. `documents` are the texts the spans were computed on.

    A text that is neither there nor open is read from disk (YAML files, node sources), so use it off the event loop.
    `pages` are what the codes of diagnostics lead to, for a client that follows them; `edits` what it knows of edits.
    Diagnostics that `before` made of the same findings, in texts that have not changed, are the same objects again:
    to make thousands, and to compare them with what was published, takes longer than a keystroke may.
    """

    def __init__(
        self,
        texts: TextStore,
        documents: Mapping[str, Document],
        *,
        related: bool = True,
        pages: RulePages | None = None,
        edits: EditSupport | None = None,
        before: Converter | None = None,
    ) -> None:
        self._texts = texts
        self._documents = documents
        self._related = related
        self._pages = pages
        self._edits = edits or EditSupport()
        self.edited: set[str] = set()
        """The files that edits were made for."""
        self._positions: dict[str, Positions] = {}
        self._uris: dict[str, str] = {}
        self._made: dict[str, _OfFile] = {}
        """By the path of the file."""
        usable = before is not None and before._related == related
        self._before = before if usable else None
        self._unchanged: dict[str, bool] = {}

    def uri(self, path: str) -> str:
        """The URI as the editor spelled it, if the file is open there."""
        found = self._uris.get(path)
        if found is None:
            document = self._texts.by_path(path)
            found = self._uris[path] = document.uri if document else to_uri(path)
        return found

    def positions(self, path: str) -> Positions:
        """Conversion for the text of a file."""
        found = self._positions.get(path)
        if found is None:
            text, lines = self._text(path)
            found = self._positions[path] = Positions(text, lines, self._texts.encoding)
        return found

    def _text(self, path: str) -> tuple[str, LineIndex]:
        # Locations are where they are in the text as it is now.
        if (opened := self._texts.by_path(path)) is not None:
            return opened.text, opened.lines
        if (parsed := self._documents.get(path)) is not None:
            return parsed.text, parsed.lines
        read = read_text(path)
        text = read.text if isinstance(read, Text) else ""
        return text, LineIndex(text)

    def range(self, location: Location) -> types.Range:
        """The range of a location in its own file."""
        return self.positions(location.file).range(location.span)

    def location(self, location: Location) -> types.Location:
        """A place to show or go to."""
        return types.Location(self.uri(location.file), self.range(location))

    def link(self, target: Location, origin: Location) -> types.LocationLink:
        """A place to go to, with the text that is underlined on the way."""
        there = self.range(target)
        return types.LocationLink(self.uri(target.file), there, there, self.range(origin))

    def diagnostics(self, path: str, findings: Sequence[Finding]) -> list[types.Diagnostic]:
        """The findings of the file at `path`. Do not change the list: it is the same one for the same findings, as long
        as they are at the same places."""
        now = tuple(findings)
        known = self._before._made.get(path) if self._before is not None else None
        same_findings = known is not None and len(known.findings) == len(now) and all(map(is_, known.findings, now))
        moved = self._moved(known) if known is not None else frozenset()
        if known is None or moved or not same_findings:
            known = self._renewed(now, known, moved)
        self._made[path] = known
        return known.diagnostics

    def _moved(self, known: _OfFile) -> frozenset[Location]:
        """Those of the locations which are elsewhere now."""
        moved: set[Location] = set()
        for path, places in known.places.items():
            if not self._is_unchanged(path):
                uri, positions = self.uri(path), self.positions(path)
                moved.update(
                    location
                    for location, place in places.items()
                    if place.uri != uri or not positions.is_at(location.span, place.range)
                )
        return frozenset(moved)

    def _renewed(self, findings: tuple[Finding, ...], known: _OfFile | None, moved: frozenset[Location]) -> _OfFile:
        places: dict[str, dict[Location, types.Location]] = {}

        def place(location: Location) -> types.Location:
            of_file = places.setdefault(location.file, {})
            found = of_file.get(location)
            if found is None:
                before = known.places.get(location.file, {}).get(location) if known is not None else None
                found = of_file[location] = self.location(location) if before is None or location in moved else before
            return found

        made = {id(f): d for f, d in zip(known.findings, known.diagnostics, strict=True)} if known is not None else {}
        diagnostics = []
        for finding in findings:
            where = self._locations(finding)
            there = list(map(place, where))
            diagnostic = made.get(id(finding)) if moved.isdisjoint(where) else None
            diagnostics.append(diagnostic if diagnostic is not None else self._diagnostic(finding, there))
        return _OfFile(findings, diagnostics, places)

    def _locations(self, finding: Finding) -> list[Location]:
        related = finding.related if self._related else ()
        return [finding.location, *(each.location for each in related)]

    def diagnostic(self, finding: Finding) -> types.Diagnostic:
        """A finding in its own file."""
        return self._diagnostic(finding, list(map(self.location, self._locations(finding))))

    def _diagnostic(self, finding: Finding, places: Sequence[types.Location]) -> types.Diagnostic:
        """`places` has the finding's, and the related ones. How sure we are is said where we are not."""
        page = self._pages.uri(finding.rule) if self._pages is not None else None
        sure = "" if finding.confidence == "certain" else f" ({finding.confidence})"
        related = None
        if self._related and finding.related:
            related = [
                types.DiagnosticRelatedInformation(place, each.message)
                for place, each in zip(places[1:], finding.related, strict=True)
            ]
        return types.Diagnostic(
            range=places[0].range,
            message=finding.message + sure,
            severity=SEVERITIES[finding.severity],
            code=finding.rule,
            code_description=types.CodeDescription(page) if page is not None else None,
            source=SOURCE,
            related_information=related,
            data={"name": finding.name, "confidence": finding.confidence},
        )

    def _is_unchanged(self, path: str) -> bool:
        """Whether a file's text and URI are those that the converter before this one had."""
        found = self._unchanged.get(path)
        if found is None:
            known = self._before._positions.get(path) if self._before is not None else None
            same = known is not None and self.positions(path).are_those_of(known)
            found = same and self._before is not None and self._before.uri(path) == self.uri(path)
            self._unchanged[path] = found
        return found

    def end(self) -> None:
        """All diagnostics are made: let go of those that were not made again."""
        self._before = None

    def workspace_edit(self, edits: Iterable[Edit]) -> types.WorkspaceEdit:
        """Edits of any number of files, with what the client knows of: versions of the texts that they are for, and
        what is said of each edit. Raises `TextChangedError` where a text is another one by now."""
        changes: dict[str, list[types.TextEdit | types.AnnotatedTextEdit]] = {}
        annotations: dict[str, types.ChangeAnnotation] = {}
        for edit in edits:
            there, of_file = self.range(edit.location), changes.setdefault(edit.location.file, [])
            if isinstance(edit, RenameEdit) and self._edits.annotations:
                of_file.append(types.AnnotatedTextEdit(_annotated(edit, annotations), there, edit.text))
            else:
                of_file.append(types.TextEdit(there, edit.text))
        if changed := [path for path in changes if self._is_changed(path)]:
            raise TextChangedError(changed)
        self.edited.update(changes)
        if not self._edits.versions:
            plain = {
                self.uri(path): [e for e in found if isinstance(e, types.TextEdit)] for path, found in changes.items()
            }
            return types.WorkspaceEdit(changes=plain)
        return types.WorkspaceEdit(
            document_changes=[
                types.TextDocumentEdit(
                    types.OptionalVersionedTextDocumentIdentifier(self.uri(path), self._version(path)), found
                )
                for path, found in changes.items()
            ],
            change_annotations=annotations or None,
        )

    def _is_changed(self, path: str) -> bool:
        """Whether the text of a file, in the editor or on the disk, is another one than that which was analysed."""
        known, opened = self._documents.get(path), self._texts.by_path(path)
        if known is None:
            return False
        if opened is not None:
            return opened.text != known.text
        read = read_text(path)
        # What is not plain UTF-8 may have been read otherwise, as roslaunch reads it.
        return not isinstance(read, Text) or (read.plain and read.text != known.text)

    def _version(self, path: str) -> int | None:
        opened = self._texts.by_path(path)
        return opened.version if opened else None

    def symbol(self, symbol: Symbol, path: str) -> types.DocumentSymbol:
        """A symbol and those below it."""
        positions = self.positions(path)
        return types.DocumentSymbol(
            name=symbol.name,
            detail=symbol.detail or None,
            kind=SYMBOL_KINDS.get(symbol.kind, types.SymbolKind.Object),
            range=positions.range(symbol.span),
            selection_range=positions.range(symbol.selection),
            children=[self.symbol(child, path) for child in symbol.children],
        )

    def span(self, path: str, range_: types.Range) -> Span:
        """The editor's range in offsets."""
        positions = self.positions(path)
        return Span(positions.offset(range_.start), positions.offset(range_.end))


def _annotated(edit: RenameEdit, annotations: dict[str, types.ChangeAnnotation]) -> str:
    """The name of what is said of the edit: in `annotations`, once for all edits of which the same is said."""
    wanted = types.ChangeAnnotation(edit.label, edit.indirect or None, edit.reason or None)
    known = next((name for name, each in annotations.items() if each == wanted), None)
    name = known if known is not None else str(len(annotations) + 1)
    annotations[name] = wanted
    return name
