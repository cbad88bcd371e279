"""The signature around a cursor: the arguments that an included file takes, in Python the parameters of a call."""

from __future__ import annotations

import os

from preflight_analysis.documents.document import Document, Element
from preflight_analysis.evaluation.files import Files
from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.queries.arguments import accepted, included_file
from preflight_analysis.queries.call_python import signature_of_call
from preflight_analysis.queries.cursor import is_closed
from preflight_analysis.queries.language import place_in
from preflight_analysis.queries.signature_items import Parameter, Signature
from preflight_analysis.workspace.facts import ArgDeclaration
from preflight_analysis.workspace.workspace import Analysis


def signature(analysis: Analysis, launch_file: LaunchFile, offset: int, files: Files) -> Signature | None:
    """The signature of the `<include>` around `offset`, in Python that of the call of launch; None where there is none,
    or the included file is not known."""
    document = launch_file.document
    if launch_file.is_python:
        return signature_of_call(document.text, offset)
    place = place_in(launch_file, offset)
    if place is None:
        return None
    include = next((e for e in reversed(place.parents) if e.tag.lower() == "include"), None)
    target = included_file(analysis, files, document.path, include) if include is not None else None
    if include is None or target is None:
        return None
    label = os.path.basename(target.path) + "("
    parameters: list[Parameter] = []
    for declared in accepted(target):
        label += ", " if parameters else ""
        start = len(label)
        label += declared.name if declared.default is None else f"{declared.name}:={declared.default}"
        parameters.append(Parameter(declared.name, _doc(declared), start, len(label)))
    argument = _argument_at(document, include, offset)
    name = argument.get("name") if argument is not None else None
    written = name.value.text if name is not None else None
    active = next((n for n, parameter in enumerate(parameters) if parameter.name == written), None)
    return Signature(f"{label})", code(target.path), tuple(parameters), active)


def _argument_at(document: Document, include: Element, offset: int) -> Element | None:
    return next(
        (
            child
            for child in include.elements
            if child.span.start < offset
            and (offset < child.span.end or (offset == child.span.end and not is_closed(document.text, child)))
        ),
        None,
    )


def _doc(declared: ArgDeclaration) -> str:
    return " ".join(part for part in (escaped(declared.doc or ""), "(required)" if declared.required else "") if part)
