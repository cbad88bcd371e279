"""TRC001: a node crashed when it was run."""

import re
from collections.abc import Iterator

from preflight_analysis.evaluation.tree import CommandValue
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.missing_params import missing_params
from preflight_analysis.rules.places import node_location
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.tracing.interface import REASON_COLUMNS, Outcome, without_stamp

_EXCEPTION = re.compile(r"[A-Za-z_][\w.]*(Error|Exception|Exit|Interrupt|Warning|Fault)\b")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    commands = {p.name for p in context.tree.params.values() if isinstance(p.value, CommandValue)}
    commands |= {c.param for c in context.tree.commands if c.result is None or c.result.status != "done"}
    for node, interface in zip(context.tree.nodes, context.graph.interfaces, strict=True):
        outcome = interface.outcome
        failed = outcome.status == "crashed" or (outcome.status == "exited" and outcome.exit_code not in (None, 0))
        if not failed:
            continue
        # After a made-up answer of ours, or without a value that we did not compute, the crash may be our own doing.
        lacking = next((r.name for r in context.graph.param_reads if r.node is node and r.name in commands), None)
        # Of a parameter that is missing another rule says more, as a warning.
        told = any(missing.died is not None for missing in context.once(missing_params).get(id(node), ()))
        ours = lacking is not None or bool(outcome.answers) or any(e.speculative for e in interface.endpoints)
        note = f"; it asked for '{lacking}', which comes from a command without a result" if lacking else ""
        yield rule.finding(
            _message(node.name, outcome) + note,
            node_location(node),
            severity="info" if ours or told else None,
            confidence="possible" if ours else "likely",
            related=include_chain(node.origin),
        )


def _message(name: str, outcome: Outcome) -> str:
    if outcome.reason:
        message = f"{name} crashed when it was run: {outcome.reason}"
    elif outcome.signal:
        message = f"{name} crashed when it was run: killed by {outcome.signal}"
    else:
        message = f"{name} crashed when it was run: exit code {outcome.exit_code}"
    lines = [line for text in outcome.stderr_tail if (line := without_stamp(text))]
    telling = next((line for line in reversed(lines) if _EXCEPTION.match(line)), lines[-1] if lines else "")
    telling = telling[:REASON_COLUMNS]
    return message if not telling or telling in message else f"{message}; {telling}"


RULE = Rule(
    id="TRC001",
    name="node-crashed",
    severity="warning",
    what="Reports a node that ended with an error before it reached its event loop, with the line of its standard "
    "error that tells why.",
    why="With the parameters and arguments of this launch file it would most likely end so on the robot too, unless it "
    "only lacks hardware or a network that the sandbox does not have. Only what it did until then is known of it. "
    "Where it was given a made-up answer before, the crash may come from that: it is only an information then, as "
    "where the node ended for a parameter that is missing, of which PRM010 or PRM001 warns.",
    example='<param name="model" value="/home/me/model.json"/> <!-- FileNotFoundError -->',
    instead='<param name="model" value="$(find my_package)/config/model.json"/>',
    check=_check,
    needs_graph=True,
)
