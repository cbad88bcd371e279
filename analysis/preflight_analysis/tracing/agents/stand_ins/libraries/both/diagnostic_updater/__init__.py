"""Diagnostics (http://wiki.ros.org/diagnostic_updater): the topic on which they are published, and a parameter."""

from __future__ import annotations

import importlib
import os
from typing import Any


def __getattr__(name: str) -> Any:
    if name.startswith("__"):
        raise AttributeError(name)
    return importlib.import_module("preflight_agents.anything").Anything(f"diagnostic_updater.{name}")


class DiagnosticTask:
    """What is looked at."""

    def __init__(self, name: str) -> None:
        self.name = name

    def getName(self) -> str:
        return self.name

    def run(self, stat: Any) -> Any:
        return stat


class FunctionDiagnosticTask(DiagnosticTask):
    """By a function."""

    def __init__(self, name: str, fn: Any) -> None:
        super().__init__(name)
        self.fn = fn


class CompositeDiagnosticTask(DiagnosticTask):
    """Several of them."""

    def addTask(self, t: Any) -> None:
        pass


class FrequencyStatusParam:
    """How often something should come."""

    def __init__(self, freq_bound: Any, tolerance: float = 0.1, window_size: int = 5) -> None:
        self.freq_bound, self.tolerance, self.window_size = freq_bound, tolerance, window_size


class FrequencyStatus(DiagnosticTask):
    """How often it does."""

    def __init__(self, params: Any, name: str = "FrequencyStatus") -> None:
        super().__init__(name)

    def tick(self) -> None:
        pass


class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    """Of a topic."""

    def __init__(self, name: str, diag: Any, freq: Any) -> None:
        super().__init__(name + " topic status")

    def tick(self, *args: Any) -> None:
        pass


class TopicDiagnostic(HeaderlessTopicDiagnostic):
    """Of a topic with times."""

    def __init__(self, name: str, diag: Any, freq: Any, stamp: Any = None) -> None:
        super().__init__(name, diag, freq)


class Updater:
    """Publishes what tasks say."""

    def __init__(self, node: Any = None, period: Any = 1.0) -> None:
        kind = importlib.import_module("diagnostic_msgs.msg").DiagnosticArray
        self.verbose = False
        if "PREFLIGHT_NODE" in os.environ:
            name = "diagnostic_updater.period"
            self.node = node
            self.publisher = node.create_publisher(kind, "/diagnostics", 1)
            self.period = (
                node.get_parameter(name) if node.has_parameter(name) else node.declare_parameter(name, float(period))
            ).value
        else:
            rospy = importlib.import_module("rospy")
            self.publisher = rospy.Publisher("/diagnostics", kind, queue_size=10)
            self.period = rospy.get_param("~diagnostic_period", 1)

    def add(self, *args: Any) -> None:
        pass

    removeByName = setHardwareID = broadcast = add

    def update(self, *args: Any) -> None:
        pass

    force_update = update
