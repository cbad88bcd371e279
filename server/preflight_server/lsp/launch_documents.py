"""Which open documents are launch files, or may be read by one: everything else is left alone, whatever the editor
calls it."""

from __future__ import annotations

import re

from preflight_analysis.launch.read import LAUNCH_FUNCTION, LAUNCH_SUFFIXES, PYTHON_SUFFIX, is_yaml

from preflight_server.lsp.text_store import OpenDocument

_LIKE_OTHER_XML = "_launch.xml"
"""Usual in ROS 2, but no name that only a launch file can have."""
_LAUNCH_ROOT = re.compile(
    r"\ufeff?\s*(?:<\?.*?\?>\s*|<!--.*?-->\s*|<!DOCTYPE[^<>]*>\s*)*<launch(?=[\s/>]|\Z)", re.DOTALL
)


def is_launch_file(document: OpenDocument) -> bool:
    """By its name, by the language that the editor gave it, or, for other XML, by its document element."""
    if document.path is None:
        return False
    if is_python_launch_file(document):
        return True
    says_so = document.path.endswith(LAUNCH_SUFFIXES) and not document.path.endswith(_LIKE_OTHER_XML)
    if document.language_id == "roslaunch" or says_so:
        return document.language_id != "python"
    return document.language_id == "xml" and _LAUNCH_ROOT.match(document.text) is not None


def is_python_launch_file(document: OpenDocument) -> bool:
    """By its name, or by the function that launch calls. The user's Python language server has it too: we say only
    what is ours to say."""
    if document.path is None or not document.path.endswith(PYTHON_SUFFIX):
        return False
    return document.path.endswith(LAUNCH_SUFFIXES) or LAUNCH_FUNCTION.search(document.text) is not None


def may_be_parameter_file(document: OpenDocument) -> bool:
    """By its name: whether it is one, the launch files say."""
    return document.path is not None and is_yaml(document.path) and not is_launch_file(document)
