"""Which open documents are launch files, or what these hand over: everything else is left alone, whatever the editor
calls it."""

from __future__ import annotations

import re

from preflight_analysis.documents.python_text import LAUNCH_FUNCTION, is_python
from preflight_analysis.launch.read import LAUNCH_SUFFIXES, is_module, is_yaml
from preflight_analysis.workspace.handed_over import ROBOTS

from preflight_server.lsp.text_store import OpenDocument

_LIKE_OTHER_XML = "_launch.xml"
"""Usual in ROS 2, but no name that only a launch file can have."""
_BLANKS = re.compile(r"\s*")
_DOCTYPE = re.compile(r"<!DOCTYPE[^<>]*>")
_TAG = re.compile(r"<([\w:.-]+)(?=[\s/>]|\Z)")
_XML = ("xml", "urdf", "xacro", "srdf")
"""What editors call the languages of XML."""
_TREE = re.compile(r"<BehaviorTree\b|\b(?:BTCPP_format|main_tree_to_execute)\s*=")


def is_launch_file(document: OpenDocument) -> bool:
    """By its name, by the language that the editor gave it, or, for other XML, by its document element."""
    if document.path is None:
        return False
    if is_python_launch_file(document):
        return True
    says_so = document.path.endswith(LAUNCH_SUFFIXES) and not document.path.endswith(_LIKE_OTHER_XML)
    if document.language_id == "roslaunch" or says_so:
        return document.language_id != "python"
    return document.language_id == "xml" and _first_tag(document.text) == "launch"


def _first_tag(text: str) -> str:
    """The first tag, behind declarations and comments; "" where there is none."""
    at = 1 if text.startswith("\ufeff") else 0
    while True:
        blanks = _BLANKS.match(text, at)
        at = blanks.end() if blanks else at
        if text.startswith(("<?", "<!--"), at):
            closing = "?>" if text.startswith("<?", at) else "-->"
            close = text.find(closing, at + 2)
            if close < 0:
                return ""
            at = close + len(closing)
        elif doctype := _DOCTYPE.match(text, at):
            at = doctype.end()
        else:
            found = _TAG.match(text, at)
            return found[1] if found is not None else ""


def is_python_launch_file(document: OpenDocument) -> bool:
    """By its name, or by the function that launch calls. The user's Python language server has it too: we say only
    what is ours to say."""
    if document.path is None or not is_python(document.path, document.text):
        return False
    is_named = document.path.endswith(LAUNCH_SUFFIXES) and not is_module(document.path, document.text)
    return is_named or LAUNCH_FUNCTION.search(document.text) is not None


def may_be_parameter_file(document: OpenDocument) -> bool:
    """By its name: whether it is one, the launch files say."""
    return document.path is not None and is_yaml(document.path) and not is_launch_file(document)


def is_handed_over(document: OpenDocument) -> bool:
    """Whether it is a robot description (URDF, xacro, SRDF) or a behavior tree: by its name, or, for other XML, by what
    is in it."""
    path = document.path
    if path is None or is_launch_file(document) or not is_xml(document):
        return False
    if path.endswith(ROBOTS):
        return True
    tag = _first_tag(document.text)
    return tag == "robot" or (tag == "root" and _TREE.search(document.text) is not None)


def is_served(document: OpenDocument) -> bool:
    """Whether what is found in it is shown."""
    return is_launch_file(document) or may_be_parameter_file(document) or is_handed_over(document)


def is_xml(document: OpenDocument) -> bool:
    """Whether it is XML of any kind. Editors without a mode for it may call it text."""
    path = document.path or ""
    return document.language_id in _XML or path.endswith((".xml", *ROBOTS))
