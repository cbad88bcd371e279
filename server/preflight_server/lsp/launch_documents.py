"""Which open documents are launch files, or what these hand over: everything else is left alone, whatever the editor
calls it."""

from __future__ import annotations

import os
import re

from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.xml_text import document_element
from preflight_analysis.environment.build import BUILD_FILES
from preflight_analysis.launch.recognize import is_yaml, launch_format
from preflight_analysis.workspace.handed_over import ROBOTS

from preflight_server.lsp.text_store import OpenDocument

_XML = ("xml", "urdf", "xacro", "srdf")
"""What editors call the languages of XML."""
_TREE = re.compile(r"<BehaviorTree\b|\b(?:BTCPP_format|main_tree_to_execute)\s*=")


def is_launch_file(document: OpenDocument) -> bool:
    """By what is in it and by its name, or by the language that the editor gave it."""
    if document.path is None:
        return False
    path, text, language = document.path, document.text, document.language_id
    if launch_format(path, text) is not None or (language == "roslaunch" and not is_python(path, text)):
        return True
    return language == "xml" and document_element(text) == "launch"


def is_python_launch_file(document: OpenDocument) -> bool:
    """The user's Python language server has it too: we say only what is ours to say."""
    return document.path is not None and launch_format(document.path, document.text) == "python"


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
    tag = document_element(document.text)
    return tag == "robot" or (tag == "root" and _TREE.search(document.text) is not None)


def is_build_file(document: OpenDocument) -> bool:
    """Whether it may say how a package is built: what is found in it is shown, whatever launch starts its nodes."""
    return document.path is not None and os.path.basename(document.path) in BUILD_FILES


def is_served(document: OpenDocument) -> bool:
    """Whether what is found in it is shown."""
    return is_launch_file(document) or may_be_parameter_file(document) or is_handed_over(document)


def is_xml(document: OpenDocument) -> bool:
    """Whether it is XML of any kind. Editors without a mode for it may call it text."""
    path = document.path or ""
    return document.language_id in _XML or path.endswith((".xml", *ROBOTS))
