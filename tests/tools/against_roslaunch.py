"""How `tree --format json` compares with what real roslaunch says of the same file: values, errors and their reason.

  python tests/tools/against_roslaunch.py --root CORPUS EXPECTED.jsonl ACTUAL.jsonl

roslaunch stops at the first error, we go on: what it stops at has to be the first of our `errors`. Its messages name
the file only where the exception passed an `<include>` on its way; where they do not, the file has to be one of those
that were being evaluated then.
"""

from __future__ import annotations

import argparse
import builtins
import hashlib
import json
import os
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

NODE_FIELDS = {"package": "pkg", "executable": "type", "args": "args", "machine": "machine", "cwd": "cwd"} | {
    "launch_prefix": "launch_prefix",
    "namespace": "ns",
    "respawn": "respawn",
    "respawn_delay": "respawn_delay",
    "required": "required",
}
"""Ours and the oracle's name; a test has no respawn, respawn_delay and required."""

ARGUMENT = ("ARG001", "ARG002", "ARG003")
VALUE = ("LCH008",)
REASONS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (r"(?:included file )?\[.*?\] requires the '(?P<name>.*?)' arg to be set", ARGUMENT),
    (r"arg '(?P<name>.*?)' is not defined\.", ARGUMENT),
    (r"(?:.*?: )?environment variable '(?P<name>.*?)' is not set", ("LCH012",)),
    (r"The following package was not found in .*?: (?P<name>[^\n]*)\nROS path", ("PKG001",)),
    (r"(?P<name>[^\n]*)\nROS path", ("PKG001",)),
    (r".*file does not exist \[(?P<path>.*?)\]", ("PRM002", "PRM003")),
    (r"Invalid roslaunch XML syntax: no root <launch> tag", ("LCH003", "LCH014")),
    (r"Invalid roslaunch XML syntax: no element found: line \d+, column 0", ("LCH001", "LCH003", "LCH014")),
    (r"Invalid roslaunch XML syntax: \[Errno 2\].*", ("LCH013", "LCH002")),
    (r"Invalid roslaunch XML syntax: \[Errno \d+\].*", ("LCH014", "LCH002")),
    (r"Invalid roslaunch XML syntax: .*", ("LCH001", "LCH014", "LCH002")),
    (r"\[Errno 2\] No such file or directory: '(?P<path>.*?)'", ("PRM002",)),
    (r"\[Errno \d+\] [^:]*: '(?P<path>.*?)'", ("PRM003",)),
    (r"(?:Invalid <param> tag: |error loading <rosparam> tag: \n\t)?'utf-8' codec can't decode", ("PRM003",)),
    (r"unused args \[(?P<names>.*?)\] for include of", ("ARG004",)),
    (r"<(?P<tag>\w+)> tag is missing required (?:attribute: '(?P<name>.*?)'|)", ("LCH006", "LCH011")),
    (r"Invalid <remap> tag: <remap> tag is missing required", ("LCH006", "LCH011")),
    (r"<node> tag must have a '(?P<name>name)' attribute", ("LCH006",)),
    (r"'ns' attribute must be set in order to use 'clear_params'", ("LCH006",)),
    (r"<param> tag must have one and only one of", ("LCH006", "LCH007")),
    (r"(?:Invalid <arg> tag: )?<arg> tag must have one and only one of value/default", ("LCH007",)),
    (r"cannot set both 'if' and 'unless' on the same tag", ("LCH007",)),
    (r"(?:Invalid <node> tag: )?respawn and required cannot both be set", ("LCH007",)),
    (r".*'file' attribute is invalid with 'delete' command", ("LCH007",)),
    (r"bool value for (?P<name>\S*) must be non-empty", VALUE),
    (r"invalid (?:bool|float) value for (?P<name>\S+): (?P<value>.*)", VALUE),
    (r"(?:Invalid <param> tag: )?(?!Invalid)(?P<value>.*?) is not a '.*?' type", VALUE),
    (r"<\w+> tag has an empty 'ns' attribute", VALUE),
    (r"(?:package|type) must be non-empty", VALUE),
    (r"(?:output|cwd) must be one of", VALUE),
    (r"'(?P<name>timeout|time-limit|retry)' .*", VALUE),
    (r"Invalid value for 'attribute': (?P<value>.*?)\. \n\nMachine", VALUE),
    (r"invalid literal for int\(\) with base 10: ['\"](?P<value>.*)['\"]$", (*VALUE, "LCH011")),
    (r"could not convert string to float: ['\"](?P<value>.*)['\"]$", (*VALUE, "LCH011")),
    (r"Unknown type '(?P<value>.*?)'", VALUE),
    (r"error loading <rosparam> tag: \n\tcommand must be", VALUE),
    (r".*'name' attribute must be non-empty", VALUE),
    (r"<machine>: ros-\* attributes are not supported", ("LCH005",)),
    (r"<machine>: <env> tag is not supported", ("LCH004",)),
    (r"<test> tags cannot have '(?P<name>.*?)' attribute", ("LCH005",)),
    (r"node name cannot contain a namespace", ("LCH009",)),
    (r"(?:Invalid <remap> tag: )?remap (?:from|to) \[(?P<value>.*?)\] is not a valid", ("LCH009",)),
    (r"(?:Invalid <remap> tag: )?remap from/to attributes cannot be empty", ("LCH009",)),
    (r"Machine \[(?P<value>.*?)\] already added and does not match", ("LCH009",)),
    (r"(?:Invalid <arg> tag: )?cannot override arg '(?P<name>.*?)'", ("ARG006",)),
    (r"(?:Invalid <arg> tag: )?arg '(?P<name>.*?)' has already been declared", ("ARG005",)),
    (r"include args must have declared values", ("ARG007",)),
    (r"ERROR: unknown machine \[(?P<name>.*?)\]", ("LCH017",)),
    (r"roslaunch file contains multiple nodes named \[(?P<name>.*?)\]", ("LCH016",)),
    (r"(?:Unknown substitution command|Dollar signs|Invalid left parenthesis)", ("LCH011",)),
    (r"\$\(\w+(?: \w+)?\) (?:command only accepts|must specify|may only specify)", ("LCH011",)),
    (r"\$\(eval ...\) may not contain", ("LCH011",)),
    (r".*'param' attribute must be set for non-dictionary", ("PRM004",)),
    (r"file (?P<path>.*?) contains invalid YAML", ("PRM004",)),
    (r".*(?:Error within YAML block|invalid YAML)", ("PRM004",)),
    (r".*Cannot load non-dictionary types into global namespace", ("PRM004",)),
    (r"cannot turn \[(?P<value>.*?)\] into a global name", ("LCH008", "LCH009")),
    (r"'(?P<name>file|name)'$", ("LCH006",)),
    (r"name '(?P<name>\w+)' is not defined", ("LCH011", *ARGUMENT)),
    (r"'\w+' object is not subscriptable|can only concatenate str", ("PRM004", "LCH011")),
    (r"'ROSLaunchConfig' object has no attribute", VALUE),
    (r"(?:Invalid <param> tag: )?No (?:closing quotation|escaped character)", ("PRM008",)),
    (r"(?P<name>\S+)\. \n\nMachine xml is", ARGUMENT),
    (r"(?:.*?: )?Invalid <param> tag: ", (*VALUE, "LCH011")),
    (r"Invalid <(?:arg|env|node)> tag: ", ("LCH011",)),
)
"""How roslaunch's messages begin, and our rules of which one has to say the same."""

EXCEPTIONS = {"RecursionError": ("LCH015",)} | dict.fromkeys(
    ("ScannerError", "ComposerError", "ConstructorError", "ReaderError"), VALUE
)
"""What is raised without a message of roslaunch's own; all else comes from an `$(eval)`."""
WRAPPERS = re.compile(r"(?:Invalid <(?:arg|node|env|param)> tag: |error loading <rosparam> tag: \n\t)")
TAG = re.compile(r"\. (?:\n\n)?\w+ xml is .*|\. ?\nXML is .*", re.DOTALL)
"""The tag that follows most messages."""
_LONGEST = 40
"""Characters of a value in a message."""
AT_THE_INCLUDE = ("ARG002", "ARG004", "ARG006", "LCH013", "LCH014")
"""Rules that speak where the file is included, when roslaunch names the included one."""


@dataclass(frozen=True)
class Stop:
    """What roslaunch stopped at: our rules for it, what a message has to say, and the files where it can be."""

    rules: tuple[str, ...]
    says: tuple[str, ...]
    files: frozenset[str]
    includers: frozenset[str]
    exact: bool
    """Whether `files` is what roslaunch said, and not all that were open then."""


def read_stop(record: dict[str, Any]) -> Stop | None:
    """None for a message that no line of `REASONS` knows."""
    message, exception = record["error"]["message"], record["error"]["exception"]
    chain: list[str] = []
    while found := re.match(r"while processing (.*?):\n", message):
        chain.append(found[1])
        message = message[found.end() :]
    rules, groups = _reason(message, exception)
    if rules is None:
        return None
    says = [text for key, text in groups.items() if key in ("name", "value") and text]
    for escaped, character in (("\\n", "\n"), ("\\t", "\t"), ("\\'", "'")):
        says = [text.replace(escaped, character) for text in says]
    says += groups["names"].split(", ")[:1] if groups.get("names") else []
    files, exact = _files(record, chain, message, exception)
    if rules == ("PRM004",):
        files |= {groups["path"]} if "path" in groups else set()
    elif groups.get("path"):
        says += [name for name in (os.path.basename(groups["path"]),) if name.strip(".")]
    return Stop(rules, tuple(says), frozenset(files), frozenset(_includers(record, files)), exact)


def _reason(message: str, exception: str) -> tuple[tuple[str, ...] | None, dict[str, str]]:
    # What is inside of a wrapper says more than the wrapper.
    for text in (WRAPPERS.sub("", TAG.sub("", message)), message):
        for pattern, rules in REASONS:
            if found := re.match(pattern, text, re.DOTALL):
                return rules, {k: v for k, v in found.groupdict().items() if v is not None}
    return EXCEPTIONS.get(exception, ("LCH011",) if exception in vars(builtins) else None), {}


def _files(record: dict[str, Any], chain: list[str], message: str, exception: str) -> tuple[set[str], bool]:
    if record["error"].get("file"):
        return {record["error"]["file"]}, True
    root = record["file"]
    if found := re.match(r"(?:included file )?\[(.*?)\] requires", message):
        return {found[1]}, True
    if found := re.search(r"unused args \[.*?\] for include of \[(.*?)\]", message):
        return {found[1]}, True
    # A substitution that fails outside of <arg> and <machine> passes all includes and is wrapped at the root only.
    bare = re.match(r"environment variable|Unknown substitution|Dollar signs|Invalid left|\$\(", message)
    if exception == "XmlParseException" and (chain or not bare):
        return {chain[-1] if chain else root}, True
    # Machines are looked for when everything is read.
    everywhere = {record["file"], *(include["file"] for include in record.get("includes") or [])}
    opened = everywhere if message.startswith("ERROR: unknown machine") else _open_files(record)
    return opened, len(opened) == 1


def _open_files(record: dict[str, Any]) -> set[str]:
    """The files that may have been in evaluation: the one included last, and those around it."""
    includes = record.get("includes") or []
    opened = {record["file"]}
    if includes:
        file, at = includes[-1]["file"], len(includes) - 1
        opened.add(file)
        while at >= 0:
            parent = includes[at]["parent"]
            opened.add(parent)
            at = next((i for i in range(at - 1, -1, -1) if includes[i]["file"] == parent), -1)
    return opened


def _includers(record: dict[str, Any], files: set[str]) -> Iterator[str]:
    for include in record.get("includes") or []:
        if include["file"] in files:
            yield include["parent"]


def error_difference(record: dict[str, Any], answer: dict[str, Any]) -> str | None:
    """Why the first of our errors is not what roslaunch stopped at."""
    stop = read_stop(record)
    if stop is None:
        return f"no reason of ours is known for {record['error']['exception']}: {record['error']['message'][:300]}"
    errors = answer["errors"]
    if not errors:
        return f"{record['error']['message'][:300]!r}, and no error of ours"
    first = errors[0]
    said = f"{record['error']['message'][:300]!r}, and first of ours: {first}"
    if first["rule"] not in stop.rules:
        return f"other reason: {said}"
    # Anonymous names are lower-cased with the value that they are part of.
    # A name is shown as it is written, with its substitutions.
    written = first["rule"] == "LCH009" and "$(" in first["message"]
    if not written and not all(_shown(text) in " ".join(first["message"].lower().split()) for text in stop.says):
        return f"other words than {stop.says}: {said}"
    files = stop.files | stop.includers if first["rule"] in AT_THE_INCLUDE else stop.files
    if first["file"] not in files:
        return f"other file than {sorted(files)}: {said}"
    return None


def _shown(text: str) -> str:
    """A text as messages have it: on one line, and of a long one its beginning."""
    line = " ".join(text.lower().split())
    return line if len(line) <= _LONGEST else line[: _LONGEST - 3]


def differences(record: dict[str, Any], answer: dict[str, Any]) -> list[str]:
    """All that differs between a record of the oracle and the JSON of `tree` for the same file."""
    if not record["ok"]:
        difference = error_difference(record, answer)
        return [] if difference is None else [difference]
    if answer["errors"]:
        return [f"roslaunch accepts it, and first of our errors: {answer['errors'][0]}"]
    return list(_value_differences(record, answer))


def _value_differences(record: dict[str, Any], answer: dict[str, Any]) -> Iterator[str]:
    for kind, key in (("node", "nodes"), ("test", "tests")):
        fields = NODE_FIELDS if kind == "node" else {k: v for k, v in NODE_FIELDS.items() if not k.startswith("re")}
        theirs = sorted((_their_node(n, fields) for n in record[key]), key=repr)
        ours = sorted((_our_node(n, fields) for n in answer["nodes"] if n["kind"] == kind), key=repr)
        yield from _pairs(f"{kind} of {{}}", {n["name"]: n for n in theirs}, {n["name"]: n for n in ours})
        if len(theirs) != len(ours):
            yield f"{len(theirs)} of kind {kind}, and {len(ours)} of ours"
    names = record["params"].keys() | answer["params"].keys()
    for name in sorted(names):
        if name not in answer["params"] or name not in record["params"]:
            yield f"parameter {name} is there for {'roslaunch' if name in record['params'] else 'us'} only"
        elif not _same_value(record["params"][name], answer["params"][name]):
            yield f"parameter {name}: {record['params'][name]!r:.200}, and ours {answer['params'][name]!r:.200}"
    if sorted(record["clear_params"]) != sorted(answer["clear_params"]):
        yield f"clear_params {record['clear_params']}, and ours {answer['clear_params']}"
    includes = [os.path.normpath(include["file"]) for include in record["includes"]]
    if includes != [os.path.normpath(path) for path in answer["includes"]]:
        yield f"includes {includes}, and ours {answer['includes']}"
    machines = {n: {"address": m["address"], "user": m["user"]} for n, m in record["machines"].items()}
    ours_machines = {n: {"address": m["address"], "user": m["user"] or None} for n, m in answer["machines"].items()}
    yield from _pairs("machine {}", machines, ours_machines)
    arguments = {a["name"]: a["value"] for a in record["root_args"]}
    yield from _pairs("argument {}", arguments, {name: a["value"] for name, a in answer["args"].items()})


def _pairs(what: str, theirs: dict[str, Any], ours: dict[str, Any]) -> Iterator[str]:
    for name in sorted(theirs.keys() | ours.keys()):
        if theirs.get(name) != ours.get(name):
            yield f"{what.format(name)}: {theirs.get(name)}, and ours {ours.get(name)}"


def _their_node(node: dict[str, Any], fields: dict[str, str]) -> dict[str, Any]:
    found = {ours: node[theirs] or None for ours, theirs in fields.items()}
    return {"name": node["name"], **found, **{k: node[k] for k in ("remaps", "env")}, "output": node["output"] or "log"}


def _our_node(node: dict[str, Any], fields: dict[str, str]) -> dict[str, Any]:
    found = {ours: node[ours] or None for ours in fields}
    return {"name": node["name"], **found, **{k: node[k] for k in ("remaps", "env")}, "output": node["output"]}


def _same_value(theirs: dict[str, Any], ours: Any) -> bool:
    """A value is equal with its type: 1, 1.0, "1" and True are four different parameters."""
    source = theirs.get("source") or {}
    if source.get("kind") == "command":
        return bool(ours == {"command": source["command"]})
    if theirs["type"] in ("binary", "bytes"):
        return bool(ours == {"binary_sha1": theirs["sha1"]})
    if "sha1" in theirs:
        text = ours if isinstance(ours, str) else json.dumps(ours, sort_keys=True)
        return hashlib.sha1(text.encode("utf-8", "surrogatepass")).hexdigest() == theirs["sha1"]
    return json.dumps(_spelled(theirs["value"]), sort_keys=True) == json.dumps(ours, sort_keys=True)


def _spelled(value: Any) -> Any:
    """Infinities in lists as Python writes them: the records have JavaScript's names."""
    if isinstance(value, list):
        return [_spelled(each) for each in value]
    if isinstance(value, dict):
        return {key: _spelled(each) for key, each in value.items()}
    return {"Infinity": "inf", "-Infinity": "-inf", "NaN": "nan"}.get(value, value) if isinstance(value, str) else value


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", required=True, help="the folder that the oracle calls $CORPUS")
    parser.add_argument("expected", type=Path)
    parser.add_argument("actual", type=Path)
    options = parser.parse_args()
    records = [json.loads(line) for line in options.expected.read_text().splitlines()]
    root = options.root.rstrip("/")
    answers = [json.loads(line.replace(root, "$CORPUS")) for line in options.actual.read_text().splitlines()]
    if len(records) != len(answers):
        print(f"{len(records)} records and {len(answers)} answers")
        return 1
    equal = {True: 0, False: 0}
    total = {True: 0, False: 0}
    vague = 0
    for record, answer in zip(records, answers, strict=True):
        found = differences(record, answer)
        total[record["ok"]] += 1
        equal[record["ok"]] += not found
        if not record["ok"] and not found:
            stop = read_stop(record)
            vague += stop is not None and not stop.exact
        for difference in found[:1]:
            print(f"{record['file']} {' '.join(record.get('args') or [])} {record.get('env') or ''}\n    {difference}")
    print(f"{equal[True]} of {total[True]} launch files without error are equal in all values")
    print(f"{equal[False]} of {total[False]} errors are the same in file and reason")
    print(f"({vague} of them in one of the files being evaluated then: roslaunch does not say in which)")
    print(f"{sum(equal.values())} of {len(records)} records are equal")
    return 0 if sum(equal.values()) == len(records) else 1


if __name__ == "__main__":
    sys.exit(main())
