import * as assert from "node:assert/strict";
import { it } from "node:test";
import { Activity } from "../src/activity";
import type { ServerStatus } from "../src/serverStatus";

const idle: ServerStatus = {
  state: "idle",
  done: 0,
  total: 0,
  notRun: null,
  broken: [],
  missing: { lines: [], commands: [] },
};

it("says what was done and how long it took, once it is done", () => {
  const activity = new Activity();
  assert.deepEqual(activity.next({ ...idle, state: "indexing" }, 1000), []);
  assert.deepEqual(activity.next({ ...idle, state: "indexing", done: 3, total: 40 }, 2000), []);
  assert.deepEqual(activity.next({ ...idle, state: "tracing", done: 0, total: 1 }, 3500), [
    "Indexed 40 launch files in 2.5 s.",
  ]);
  assert.deepEqual(activity.next(idle, 4000), ["Ran 1 node in the sandbox in 0.5 s."]);
  assert.deepEqual(activity.next(idle, 5000), []);
  assert.equal(activity.last, "Ran 1 node in the sandbox in 0.5 s");
});

it("says what is lacking when that changes, and only then", () => {
  const activity = new Activity();
  const notRun = { kind: "sandbox", message: "bwrap is not installed" } as const;
  const status = { ...idle, notRun, missing: { lines: ["1 package: amcl"], commands: [] } };
  assert.deepEqual(activity.next(status, 0), [
    "Nodes are not run: bwrap is not installed.",
    "Missing on this machine: 1 package: amcl.",
  ]);
  assert.deepEqual(activity.next(status, 1), []);
  assert.deepEqual(activity.next(idle, 2), []);
});
