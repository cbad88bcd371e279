"""xacro as it was before ROS Jade: its tags and macros have no prefix, or have one.

`xacro.py` of ROS Melodic still reads such files (http://wiki.ros.org/xacro, "Deprecated Syntax"). The xacro of today
does not, and takes these tags for URDF.
"""

from __future__ import annotations

from typing import Any

_TAGS = {
    "include": "filename",
    "property": "name",
    "macro": "name",
    "if": "value",
    "unless": "value",
    "insert_block": "name",
}
"""The tags, each with an attribute that it has in xacro."""


def install(xacro: Any) -> None:
    """From now on the module reads tags without a prefix too."""
    parse, call = xacro.parse, xacro.handle_macro_call

    def read(inp: Any, filename: Any = None) -> Any:
        document = parse(inp, filename)
        for tag, attribute in _TAGS.items():
            for element in document.getElementsByTagName(tag):
                if element.hasAttribute(attribute):
                    element.tagName = element.nodeName = f"xacro:{tag}"
        return document

    def handle_macro_call(node: Any, macros: Any, symbols: Any) -> Any:
        if node.tagName in macros:
            node.tagName = node.nodeName = f"xacro:{node.tagName}"
        return call(node, macros, symbols)

    xacro.parse, xacro.handle_macro_call = read, handle_macro_call
