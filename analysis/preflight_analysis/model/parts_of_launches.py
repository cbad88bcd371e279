"""Launch files that are made to be included: what they use may be configured where that is done (ROS 2)."""

from __future__ import annotations

import os
import re

from preflight_analysis.evaluation.problems import ArgumentNeeded
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import problems_of
from preflight_analysis.model.written_elsewhere import in_package

_FILES = (re.compile(r"""([^\s/"'$()]+(?:\.xml|\.py|\.ya?ml))["')\s]"""),)
_ARGUMENTS = (
    re.compile(r"""\bname\s*[=:]\s*["']?([\w./-]+)"""),
    re.compile(r"""\bDeclareLaunchArgument\s*\(\s*["']([\w./-]+)["']"""),
    re.compile(r"""[{,]\s*["']([\w./-]+)["']\s*:"""),
    re.compile(r"""\(\s*["']([\w./-]+)["']\s*,"""),
)
"""Of `<arg>` and `<let>`, and in Python of declarations and what an include is given."""


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
    included = in_package(context, _FILES).get(os.path.basename(context.root), 0) > 0
    return included and in_package(context, _ARGUMENTS).get(argument, 0) > 0
