"""Findings as JUnit's XML, which CI servers show as tests."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Collection, Sequence

from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import Report, closing, finding_lines, relative


def to_junit(report: Report, failing: Collection[Finding], checked: Sequence[str], base: str) -> str:
    """A test case for each rule that speaks in a file, one for each of the `checked` files in which none does.

    `failing` are the findings that are failures; the others are in the output of a case that passes. A rule of ours
    that failed is an error.
    """
    cases: dict[tuple[str, str], list[Finding]] = {}
    for finding in report.findings:
        cases.setdefault((finding.location.file, f"{finding.rule} {finding.name}"), []).append(finding)
    spoken_of = {file for file, _ in cases}
    suite = ET.Element("testsuite", name="ros-preflight")
    for file in checked:
        if file not in spoken_of:
            ET.SubElement(suite, "testcase", classname=printable(relative(file, base)), name="no findings")
    failures = 0
    for (file, name), findings in cases.items():
        case = ET.SubElement(suite, "testcase", classname=printable(relative(file, base)), name=name)
        text = "\n\n".join("\n".join(finding_lines(finding, report.documents, base)) for finding in findings)
        failed = [finding for finding in findings if finding in failing]
        if failed:
            failures += 1
            more = f" (and {len(failed) - 1} more)" if len(failed) > 1 else ""
            message = printable(failed[0].message) + more
            ET.SubElement(case, "failure", message=message, type=failed[0].severity).text = text
        else:
            ET.SubElement(case, "system-out").text = text
    for broken in report.failures:
        message = printable(broken.message(relative(broken.file, base)))
        case = ET.SubElement(
            suite, "testcase", classname=printable(relative(broken.file, base)), name=broken.rule or "analysis"
        )
        ET.SubElement(case, "error", message=message, type="ros-preflight").text = message
    errors = str(len(report.failures))
    counts = {"tests": str(len(suite)), "failures": str(failures), "errors": errors, "skipped": "0"}
    suite.attrib.update(counts)
    ET.SubElement(suite, "system-out").text = "\n\n".join(closing(report, base))
    suites = ET.Element("testsuites", {"name": "ros-preflight", **counts})
    suites.append(suite)
    ET.indent(suites)
    return ET.tostring(suites, encoding="unicode", xml_declaration=False) + "\n"
