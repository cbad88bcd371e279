"""Claims about values at which a node of ROS 2 stops."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject, Text
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.places import related_node
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import ParamUse

OF_REFUSALS = (Reason.FROM_SOURCE, Reason.CATALOGUE, Reason.DEPENDS, Reason.LIBRARY)
"""The doubts that `refusal` may have."""


def refusal(
    rule: Rule, node: LaunchNode, param: Param, use: ParamUse, said: Text, against: Iterable[Doubt] = ()
) -> Finding:
    """The finding for a value at which a node of ROS 2 stops when it declares the parameter."""
    finding = rule.claim(
        said,
        param.place,
        subject=Subject("parameter", param.name),
        doubts=(
            *against,
            *doubts(
                DEPENDS=node.name if use.evidence.assumed else "",
                LIBRARY=use.evidence.assumed,
                FROM_SOURCE=use.evidence.inferred,
                CATALOGUE=use.evidence.of_catalogue,
            ),
        ),
        related=(related_node(node), *include_chain(node.origin)),
    )
    return replace(finding, crash_of=node.name) if use.refused is not None else finding
