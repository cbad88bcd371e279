import * as assert from "node:assert/strict";
import { it } from "node:test";
import { UNWATCHED, watched } from "../src/live";

it("says in one line what the running system is like", () => {
  const say = (...given: Parameters<typeof watched>) => watched(...given).message;
  assert.equal(say({ event: "waiting", reason: "no master" }, undefined), "Waiting for the running system: no master");
  assert.equal(say({ event: "attached", to: "the master" }, undefined), "Watching the master");
  assert.equal(say({ event: "state", nodes: {}, issues: [] }, "the master"), "Watching the master: as it should be");
  const issues = ["/a is missing", "for information", "/b is missing"].map((message, n) => ({ message, counts: n !== 1 }));
  assert.equal(say({ event: "state", issues }, undefined), "Watching the running system: 2 differences. /a is missing");
  assert.equal(watched({ event: "stopped", reason: null }, "the master"), UNWATCHED);
  assert.equal(say({ event: "stopped", reason: "no rclpy" }, undefined), "Not watched any more: no rclpy");
});

it("has the states of nodes by their names", () => {
  const { states } = watched({ event: "state", nodes: { "/a": "present", "/b": "missing" } }, undefined);
  assert.deepEqual([...states], [["/a", "present"], ["/b", "missing"]]);
});
