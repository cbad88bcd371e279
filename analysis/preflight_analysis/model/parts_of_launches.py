"""Launch files that are made to be included: what they use may be configured where that is done (ROS 2)."""

from __future__ import annotations

import os

from preflight_analysis.evaluation.problems import ArgumentNeeded
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.entry import Entry
from preflight_analysis.model.name_index import in_package
from preflight_analysis.model.problems import problems_of


@derived
def is_part(context: Context) -> bool:
    """Whether what is launched here is made to be included: it needs arguments, and in ROS 2 all that is configured
    where it is included is known in it, declared or not."""
    return context.tree.ros.shared_configurations and any(problems_of(context, ArgumentNeeded))


def is_configured_elsewhere(context: Context, argument: str) -> bool:
    """Whether other launch files of the package include the root, under a condition at least, and have an argument of
    that name."""
    if not context.tree.ros.shared_configurations:
        return False
    included = Entry("file", os.path.basename(context.root)) in in_package(context, "file")
    return included and any(each.text == argument and each.role != "uses" for each in in_package(context, "argument"))
