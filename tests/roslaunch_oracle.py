"""What real roslaunch makes of launch files. Runs under the interpreter that has ROS 1, in one process for many files.

  /usr/bin/python3 roslaunch_oracle.py < jobs.json > answers.json

A job is `{"file", "args": ["name:=value"], "env": {}, "package_path": [...]}`. Nothing is started. Anonymous names are
numbered in the order of evaluation, as `tree` does.
"""

import contextlib
import io
import json
import os
import sys


def load(job):
    import rosgraph.names
    import roslaunch.config
    import roslaunch.substitution_args
    import roslaunch.xmlloader
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

    counts = {}

    def anonymous_name(identifier):
        counts[identifier] = counts.get(identifier, 0) + 1
        return "%s_ANON%d" % (identifier, counts[identifier])

    rosgraph.names.anonymous_name = anonymous_name
    config = roslaunch.config.ROSLaunchConfig()
    config.resolved_node_names.append("/rosout")
    loader = roslaunch.xmlloader.XmlLoader()
    loader.ignore_unset_args = False
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            loader.load(job["file"], config, argv=["roslaunch", *job["args"]], verbose=False)
            for node in config.nodes + config.tests:
                config._select_machine(node)
    except Exception as error:
        return {"error": "%s: %s" % (type(error).__name__, error)}
    return {
        "error": None,
        "nodes": sorted((describe(n) for n in config.nodes + config.tests), key=lambda n: n["name"]),
        "params": {key: value(p.value) for key, p in config.params.items()},
        "clear_params": sorted(config.clear_params),
    }


def describe(node):
    import rosgraph.names

    return {
        "name": rosgraph.names.ns_join(node.namespace, node.name),
        "namespace": node.namespace,
        "package": node.package,
        "executable": node.type,
        "args": node.args,
        "remaps": [list(r) for r in node.remap_args],
        "env": [list(e) for e in node.env_args],
        "machine": node.machine_name,
        "output": node.output or "log",
        "cwd": node.cwd,
        "launch_prefix": node.launch_prefix,
        "respawn": bool(node.respawn),
        "required": bool(node.required),
    }


def value(found):
    from xmlrpc.client import Binary

    if isinstance(found, Binary):
        return {"binary": list(found.data)}
    # The type is part of the value: 1, 1.0, "1" and True are four different parameters.
    return [type(found).__name__, repr(found)]


def main():
    # Imported once, before the forks.
    import rosgraph.names  # noqa: F401
    import roslaunch.xmlloader  # noqa: F401
    import rosparam  # noqa: F401

    answers = []
    for job in json.load(sys.stdin):
        # Each in a process of its own: the environment and the caches of the packages are global.
        read, write = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(read)
            with os.fdopen(write, "w") as out:
                out.write(json.dumps(load(job)))
            os._exit(0)
        os.close(write)
        with os.fdopen(read) as stream:
            answers.append(json.loads(stream.read()))
        os.waitpid(child, 0)
    json.dump(answers, sys.stdout)


if __name__ == "__main__":
    main()
