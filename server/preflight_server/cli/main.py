"""The command's entry point: picks the verb, and turns what goes wrong into a message and an exit code."""

from __future__ import annotations

import argparse
import importlib
import logging
import os
import sys
from collections.abc import Sequence

from preflight_analysis import __version__
from preflight_analysis.findings.failure import error_line

from preflight_server.cli.errors import BROKEN, FAILED, CannotDoError
from preflight_server.cli.output import LogFormatter, say

_log = logging.getLogger(__name__)
VERBS = {
    "check": "find problems in launch files",
    "explain": "explain a rule or one finding",
    "why": "explain why two nodes are connected or not, or why a node starts",
    "where": "list the places that set a parameter",
    "tree": "list what a launch file starts",
    "graph": "print the communication graph of a launch",
    "frames": "print the coordinate frames of a launch",
    "trace": "run the nodes of a launch file in the sandbox and print their interfaces",
    "snapshot": "write the expected graph to a file",
    "diff": "compare two launch configurations",
    "watch": "compare a running system with its launch file",
    "capture": "write the interfaces of running nodes as annotations",
    "rules": "list the rules, or explain one",
    "completion": "print the completion script of a shell",
    "doctor": "report the ROS environment, the sandbox and missing packages",
    "lsp": "start the language server on standard input and output",
    "mcp": "start a server of the Model Context Protocol, for tools and agents",
}
"""The verbs with their help. The module of one is imported only if the command line has its name."""
_SEVERAL_FILES = ("check", "diff", "explain", "where", "why")
"""The verbs whose positional arguments are files or names too, in `launch_args`."""
_COMPLETING = "_ARGCOMPLETE"
"""The variable that a shell sets when it asks argcomplete for words."""
_EPILOG = "exit codes: 0 clean, 1 findings at or above --fail-on, 2 the command failed, 3 an error of ros-preflight"


def version() -> str:
    """The line of `--version`."""
    return f"ros-preflight {__version__}"


def main(argv: Sequence[str] | None = None, *, program: str = "ros-preflight") -> int:
    """Run the command, called as `program`; the return value is the exit code."""
    handler = logging.StreamHandler()
    handler.setFormatter(LogFormatter("ros-preflight: %(message)s"))
    logging.basicConfig(level=logging.WARNING, handlers=[handler])
    args = _parse(sys.argv[1:] if argv is None else argv, program)
    if getattr(args, "cache_dir", None):
        from preflight_analysis.tracing.cache_folder import VARIABLE  # noqa: PLC0415, `--version` starts faster without

        os.environ[VARIABLE] = args.cache_dir
    if getattr(args, "allow_secret", None):
        from preflight_analysis.documents.secrets import ALLOWED  # noqa: PLC0415, likewise

        os.environ[ALLOWED] = os.pathsep.join(filter(None, [os.environ.get(ALLOWED), *map(_secret, args.allow_secret)]))
    try:
        code: int = args.run(args)
        sys.stdout.flush()
    except CannotDoError as error:
        say(f"ros-preflight: {error}")
        return FAILED
    except BrokenPipeError:
        # Whoever read has read enough; Python would complain again at exit, when it flushes.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return FAILED
    except KeyboardInterrupt:
        say("ros-preflight: interrupted")
        return FAILED
    except Exception as error:
        _log.exception("internal error")
        say(f"ros-preflight: internal error: {error_line(error)}. Please report this.")
        return BROKEN
    return code


def _secret(given: str) -> str:
    """A path that is allowed, whole; the name of a variable as it is."""
    return os.path.abspath(os.path.expanduser(given)) if "/" in given or os.path.exists(given) else given


def _parse(argv: Sequence[str], program: str) -> argparse.Namespace:
    is_completing = _COMPLETING in os.environ
    named = os.environ.get("COMP_LINE", "").split() if is_completing else argv
    parser = argparse.ArgumentParser(
        prog=program,
        description="Find problems in ROS launch configurations before a robot moves.",
        epilog=_EPILOG,
    )
    parser.add_argument("--version", action="version", version=version())
    verbs = parser.add_subparsers(metavar="VERB", required=True)
    for verb, text in VERBS.items():
        sub = verbs.add_parser(verb, help=text)
        if verb not in named:
            continue
        module = importlib.import_module(f"preflight_server.cli.{verb}")
        sub.description = module.DESCRIPTION
        module.add_arguments(sub)
        if sub.get_default("fail_on") is not None:
            sub.epilog = _EPILOG  # the others tell theirs themselves
        sub.set_defaults(run=module.run, verb=verb)
    if is_completing:
        from preflight_server.cli.completion import complete  # noqa: PLC0415, only a shell asks for it

        complete(parser)
    args, rest = parser.parse_known_args(argv)
    if args.verb == "lsp":
        return args  # editors add arguments of their own, such as --clientProcessId
    # argparse gives up on positional arguments that follow an option.
    positional = [each for each in rest if not each.startswith("-")]
    late = [each for each in positional if ":=" in each or args.verb in _SEVERAL_FILES]
    if len(late) < len(rest) or (late and not hasattr(args, "launch_args")):
        parser.error(f"not understood: {' '.join(each for each in rest if each not in late) or ' '.join(late)}")
    if late:
        args.launch_args = [*args.launch_args, *late]
    return args


if __name__ == "__main__":
    sys.exit(main())
