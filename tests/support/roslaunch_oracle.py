"""What real roslaunch makes of launch files. Runs under the interpreter that has ROS 1, in one process for many files.

  /usr/bin/python3 roslaunch_oracle.py < jobs.jsonl > answers.jsonl

A line is a job, `{"file", "args": ["name:=value"], "env": {}, "package_path": [...]}`. Nothing is started: no node,
no command of a parameter. Anonymous names are numbered in the order of evaluation, as `tree` does. The answers have the
form of the records that `against_roslaunch.py` compares with; an error has the file that was being evaluated.
"""

import contextlib
import hashlib
import io
import json
import os
import re
import shlex
import sys


class Command:
    """Instead of the output of a parameter's command."""

    def __init__(self, command):
        self.command = command


def isolate(job):
    """The environment of the job and its packages, and nothing else."""
    import roslaunch.substitution_args
    import rospkg
    import rospkg.environment
    import rospkg.rospack

    os.environ.clear()
    os.environ.update(job["env"])
    os.environ["ROS_PACKAGE_PATH"] = ":".join(job["package_path"])

    # Debian's rospkg would add /usr/share; a job's package path is all there is.
    def package_path(env=None):
        return os.environ["ROS_PACKAGE_PATH"]

    rospkg.environment._get_ros_package_path = package_path
    for module in (rospkg.environment, rospkg.rospack):
        if hasattr(module, "get_ros_package_path"):
            module.get_ros_package_path = package_path
    roslaunch.substitution_args._rospack = rospkg.RosPack()


def observe(log):
    """Number anonymous names, run no commands, and note the includes and the file that an error is in."""
    import rosgraph.names
    import roslaunch.loader
    import roslaunch.xmlloader

    counts = {}

    def anonymous_name(identifier):
        counts[identifier] = counts.get(identifier, 0) + 1
        return "%s_ANON%d" % (identifier, counts[identifier])

    rosgraph.names.anonymous_name = anonymous_name

    loader, xml_loader = roslaunch.loader.Loader, roslaunch.xmlloader.XmlLoader
    param_value, parse, recurse = loader.param_value, xml_loader._parse_launch, xml_loader._recurse_load
    launch_tag, include_child = xml_loader._launch_tag, roslaunch.loader.LoaderContext.include_child

    def our_param_value(self, verbose, name, ptype, value, textfile, binfile, command):
        if value is None and textfile is None and binfile is None:
            shlex.split(command)
            return Command(command)
        return param_value(self, verbose, name, ptype, value, textfile, binfile, command)

    def our_include_child(self, ns, filename):
        context = include_child(self, ns, filename)
        log["includes"].append({"file": filename, "parent": self.filename})
        return context

    @contextlib.contextmanager
    def inside(file):
        try:
            yield
        except Exception:
            log.setdefault("file", file)
            raise

    def our_parse(self, filename, verbose):
        with inside(filename):
            return parse(self, filename, verbose)

    def our_launch_tag(self, tag, ros_config, filename=None):
        with inside(filename):
            return launch_tag(self, tag, ros_config, filename)

    def our_recurse(self, ros_config, tags, context, *rest):
        with inside(context.filename):
            return recurse(self, ros_config, tags, context, *rest)

    loader.param_value = our_param_value
    roslaunch.loader.LoaderContext.include_child = our_include_child
    xml_loader._parse_launch, xml_loader._recurse_load, xml_loader._launch_tag = our_parse, our_recurse, our_launch_tag


def load(job):
    import roslaunch.config
    import roslaunch.xmlloader

    isolate(job)
    log = {"includes": []}
    observe(log)
    config = roslaunch.config.ROSLaunchConfig()
    config.resolved_node_names.append("/rosout")
    loader = roslaunch.xmlloader.XmlLoader()
    loader.ignore_unset_args = False
    answer = {"file": job["file"], "args": job["args"], "includes": log["includes"]}
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            loader.load(job["file"], config, argv=["roslaunch"] + job["args"], verbose=False)
            for node in config.nodes + config.tests:
                config._select_machine(node)
    except Exception as error:
        # Which file a node with an undeclared machine stands in is not known by then.
        found = {"exception": type(error).__name__, "message": str(error)[:3000], "file": log.get("file")}
        return dict(answer, ok=False, error=found)
    resolved = loader.root_context.resolve_dict.get("arg", {})
    machines = {m.name: {"address": m.address, "user": m.user} for m in config.machines.values() if m.name}
    return dict(
        answer,
        ok=True,
        root_args=[{"name": name, "value": resolved.get(name)} for name in loader.root_context.arg_names],
        nodes=[describe(n) for n in config.nodes],
        tests=[describe(n) for n in config.tests],
        params={key: value(p.value) for key, p in config.params.items()},
        clear_params=config.clear_params,
        machines=machines,
    )


def describe(node):
    import rosgraph.names

    return {
        "name": rosgraph.names.canonicalize_name(rosgraph.names.ns_join(node.namespace, node.name or "")),
        "ns": node.namespace,
        "pkg": node.package,
        "type": node.type,
        "args": node.args,
        "remaps": [list(r) for r in node.remap_args],
        "env": [list(e) for e in node.env_args],
        "machine": node.machine_name,
        "output": node.output,
        "cwd": node.cwd,
        "launch_prefix": node.launch_prefix,
        "respawn": node.respawn,
        "respawn_delay": plain(node.respawn_delay),
        "required": node.required,
    }


def value(found):
    from xmlrpc.client import Binary

    kind = type(found).__name__
    if isinstance(found, Command):
        return {"type": kind, "source": {"kind": "command", "command": found.command}}
    if isinstance(found, (Binary, bytes)):
        data = found.data if isinstance(found, Binary) else found
        return {"type": "binary", "sha1": hashlib.sha1(data).hexdigest()}
    return {"type": kind, "value": plain(found)}


def plain(found):
    """What JSON can say of a value; text for the rest."""
    if isinstance(found, dict):
        return {str(key): plain(each) for key, each in found.items()}
    if isinstance(found, (list, tuple)):
        return [plain(each) for each in found]
    if isinstance(found, bytes):
        return {"binary_sha1": hashlib.sha1(found).hexdigest()}
    if isinstance(found, float) and not re.match(r"-?\d", repr(found)):
        return repr(found)
    return found if found is None or isinstance(found, (bool, int, float, str)) else str(found)


def main():
    # Imported once, before the forks.
    import rosgraph.names  # noqa: F401
    import roslaunch.xmlloader  # noqa: F401
    import rosparam  # noqa: F401

    for line in sys.stdin:
        # Each in a process of its own: the environment and the caches of the packages are global.
        read, write = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(read)
            with os.fdopen(write, "w") as out:
                out.write(json.dumps(load(json.loads(line))))
            os._exit(0)
        os.close(write)
        with os.fdopen(read) as stream:
            print(stream.read(), flush=True)
        os.waitpid(child, 0)


if __name__ == "__main__":
    main()
