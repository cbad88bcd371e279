"""The kinds of `Problem` that reading and evaluating can meet, with the data each carries.

Each kind belongs to exactly one rule (a test holds us to that); a rule may own several kinds. `fatal` says whether
roslaunch itself stops there.
"""

from __future__ import annotations

KINDS: dict[str, str] = {
    # reading files
    "file-unreadable": "path, reason: the root file cannot be read (missing, no permission, a folder). fatal",
    "file-not-text": "path, reason: binary, not UTF-8, or larger than the limit; not analysed. fatal",
    "xml-malformed": "message: not well-formed XML, at the place of the cause. fatal",
    "yaml-malformed": "message: not YAML, at the place where it stops to be. fatal",
    "xml-entity": "name: an entity that a DOCTYPE defines; never expanded here, so values with it are unknown",
    "python-malformed": "message: not Python, at the place where it stops to be. fatal",
    "python-exception": "error (its class), message, frames (Locations, outermost first): a Python launch file raised. "
    "fatal",
    "python-import": "module, message: a Python launch file imports what is not there",
    "launch-file-not-run": "name, reason: a Python launch file, or a function or substitution of it",
    "root-not-launch": "tag (None in an empty file): the document element is not <launch>. fatal",
    # the language
    "unknown-element": "tag, parent, allowed (list): roslaunch prints a warning and skips it",
    "unknown-attribute": "name, tag, allowed (list): roslaunch reports it and goes on",
    "missing-attribute": "tag, names (list; one of them is needed). fatal",
    "attributes-exclude": "tag, names (list of those given). fatal",
    "bad-value": "tag, attribute, value, expected (a phrase), choices (list, may be empty). fatal",
    "invalid-name": "what (node, arg, ...), name, reason. fatal",
    "substitution-as-text": "text, meant (how it is written): looks like a substitution and is text to roslaunch",
    "stray-text": "text (its first line), tag: text between tags, which roslaunch does not look at",
    "ignored-child": "tag, parent: <include> takes only arg and env; roslaunch drops the rest with a warning",
    # substitutions
    "bad-substitution": "text, message. fatal",
    "eval-error": "expression, message: $(eval) fails. fatal",
    "eval-not-allowed": "expression, message: outside of what is evaluated without running code",
    "env-unset": "name: $(env name) of a variable that is not set. fatal",
    "package-not-found": "name: $(find name). fatal",
    # arguments
    "arg-undeclared": "name, declared (list), in ROS 2 not_followed (Location or None: what may have set it): $(arg "
    "name) of an argument that is not declared before. fatal if nothing may have set it",
    "arg-required": "name, file (the included), passed (list): an include without a value for a required arg. fatal",
    "root-arg-required": "name: the root file needs name:=value on the command line. fatal",
    "root-arg-undeclared": "name, declared (list): name:=value of the command line, which nothing asks for",
    "include-arg-undeclared": "name, file (the included), declared (list): roslaunch stops with 'unused args'. fatal",
    "arg-not-a-choice": "name, value, choices (list), declared (Location): ROS 2. fatal",
    "arg-redeclared": "name, first (Location), passed: declared twice in a file, or passed twice in an include. fatal",
    "arg-override": "name: an include passes a value for an arg that the file fixes with value=. fatal",
    "include-arg-no-value": "name: <arg> in an <include> without value. fatal",
    # includes and files
    "include-not-found": "path. fatal",
    "include-unreadable": "path, reason (binary, too large, no permission, a folder, malformed root). fatal",
    "include-cycle": "path, chain (list of paths). fatal",
    "value-too-long": "limit: a value that substitutions make has more characters than are kept here",
    "nested-too-deeply": "limit (a phrase): groups and includes go deeper, or are more, than is evaluated here",
    "param-file-not-found": "path, tag, attribute: textfile, binfile or rosparam file. fatal",
    "param-file-unreadable": "path, tag, attribute, reason. fatal",
    "bad-yaml": "message, path (None when inline). fatal",
    "command-malformed": "command, message: it cannot be split into words. fatal",
    "command-failed": "command, reason, stderr (list of lines): it was run and had no success. fatal",
    "command-missing": "command, reason: its program is not there. fatal",
    "command-not-run": "command, reason",
    "yaml-key-twice": "name, second (Location): a key stands twice in one dictionary, the later one counts",
    # nodes
    "duplicate-node": "name, first (Location). fatal in ROS 1",
    "machine-undefined": "name, declared (list). fatal",
}
