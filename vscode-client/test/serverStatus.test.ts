import * as assert from "node:assert/strict";
import { describe, it } from "node:test";
import { type Life, type NotRun, type ServerStatus, shown, showsTrustBadge } from "../src/serverStatus";

const running: Life = { state: "running" };
const idle: ServerStatus = {
  state: "idle",
  done: 0,
  total: 0,
  notRun: null,
  broken: [],
  missing: { lines: [], commands: [] },
};
const notRun = (kind: NotRun["kind"]): ServerStatus => ({ ...idle, notRun: { kind, message: "the reason" } });

describe("the status bar", () => {
  it("says how far it is", () => {
    assert.match(shown(running, { ...idle, state: "tracing", done: 3, total: 12 }).text, /: tracing 3 of 12$/);
    assert.match(shown(running, { ...idle, state: "indexing", done: 120, total: 300 }).text, /: indexing 120 of 300$/);
    assert.match(shown(running, { ...idle, state: "indexing" }).text, /: indexing$/);
    assert.equal(shown(running, idle).text, "$(check) ROS Preflight");
    assert.equal(shown(running, undefined).text, "$(sync~spin) ROS Preflight");
  });

  it("says what keeps nodes from being run", () => {
    const sandbox = shown(running, notRun("sandbox"));
    assert.deepEqual([sandbox.severity, sandbox.tooltip], ["warning", "Nodes are not run: the reason"]);
    assert.match(sandbox.text, /no sandbox/);
    assert.equal(shown(running, notRun("off")).tooltip, "Nodes are not run: the reason");
    assert.equal(shown(running, notRun("cancelled")).severity, "none");
  });

  it("names the files with a syntax error", () => {
    const one = shown(running, { ...idle, broken: ["file:///w/my%20robot.launch"] });
    assert.deepEqual(one, {
      text: "$(warning) ROS Preflight: syntax error in my robot.launch",
      tooltip: "Syntax error in my robot.launch: nodes that it affects are not run.",
      severity: "warning",
    });
    assert.match(
      shown(running, { ...idle, broken: ["file:///a.launch", "file:///b.launch"] }).text,
      /a\.launch and 1 more$/,
    );
    assert.match(shown(running, { ...notRun("off"), broken: ["file:///a.launch"] }).tooltip, /^Nodes are not run/);
  });

  it("tells what is missing on this machine, which is no fault", () => {
    const missing = { lines: ["2 packages: amcl, map_server"], commands: [] };
    assert.deepEqual(shown(running, { ...idle, missing }), {
      text: "$(check) ROS Preflight",
      tooltip: "Everything is up to date.\nMissing on this machine:\n2 packages: amcl, map_server",
      severity: "none",
    });
    assert.equal(shown(running, idle).tooltip, "Everything is up to date.");
    const last = "Ran 3 nodes in the sandbox in 1.2 s";
    assert.equal(shown(running, idle, last).tooltip, `Everything is up to date.\n${last}.`);
  });

  it("says that there is no server, and why", () => {
    const missing = shown({ state: "missing", reason: "no Python" }, idle);
    assert.deepEqual([missing.severity, missing.tooltip], ["error", "no Python"]);
    assert.match(shown({ state: "installing", reason: "x" }, undefined).text, /installing/);
    assert.match(shown({ state: "stopped" }, undefined).text, /stopped/);
  });

  it("has a badge in a workspace that is not trusted, and only there", () => {
    assert.equal(showsTrustBadge(running, notRun("untrusted")), true);
    assert.equal(showsTrustBadge({ state: "stopped" }, notRun("untrusted")), false);
    assert.equal(showsTrustBadge(running, notRun("off")), false);
    assert.equal(showsTrustBadge(running, undefined), false);
  });
});
