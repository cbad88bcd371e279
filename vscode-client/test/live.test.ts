import * as assert from "node:assert/strict";
import { it } from "node:test";
import { liveLines, UNWATCHED, watched } from "../src/live";

it("says in one line what the running system is like", () => {
  const say = (...given: Parameters<typeof watched>) => watched(...given).message;
  assert.equal(say({ event: "waiting", reason: "no master" }, undefined), "Waiting for the running system: no master");
  assert.equal(say({ event: "attached", to: "the master" }, undefined), "Watching the master");
  assert.equal(say({ event: "state", nodes: {}, issues: [] }, "the master"), "Watching the master: as it should be");
  const issues = ["/a is missing", "for information", "/b is missing"].map((message, n) => ({
    node: "/a",
    message,
    counts: n !== 1,
  }));
  assert.equal(say({ event: "state", issues }, undefined), "Watching the running system: 2 differences. /a is missing");
  assert.equal(watched({ event: "stopped", reason: null }, "the master"), UNWATCHED);
  assert.equal(say({ event: "stopped", reason: "no rclpy" }, undefined), "Not watched any more: no rclpy");
});

it("has the states of nodes by their names", () => {
  const { states } = watched({ event: "state", nodes: { "/a": "present", "/b": "missing" } }, undefined);
  assert.deepEqual(
    [...states],
    [
      ["/a", "present"],
      ["/b", "missing"],
    ],
  );
});

it("knows since when something is not as expected", () => {
  const [a, b] = ["/a is missing", "/b is missing"].map((message) => ({ node: "/a", message, counts: true }));
  const note = { node: "/c", message: "/c publishes /x", counts: false };
  assert.ok(a && b);
  const first = watched({ event: "state", issues: [note, a] }, undefined, UNWATCHED, 1000);
  const second = watched({ event: "state", issues: [b, a] }, undefined, first, 2000);
  assert.deepEqual(
    first.differences.map(({ message, since }) => [message, since]),
    [
      ["/a is missing", 1000],
      ["/c publishes /x", 1000],
    ],
  );
  assert.deepEqual(
    second.differences.map(({ message, since }) => [message, since]),
    [
      ["/b is missing", 2000],
      ["/a is missing", 1000],
    ],
  );
  assert.deepEqual(watched({ event: "waiting", reason: "gone" }, undefined, second, 3000).differences, []);
});

it("says of a node what is not as expected", () => {
  const issues = [
    { node: "/a", counts: true, message: "/a does not subscribe to /scan" },
    { node: "/b", counts: false, message: "/b publishes /x" },
  ];
  const all = watched(
    { event: "state", nodes: { "/a": "differs", "/b": "present", "/c": "inactive" }, issues },
    undefined,
  );
  assert.deepEqual(liveLines("/a", all), [
    "On the running robot: Runs, with differences.",
    "/a does not subscribe to /scan",
  ]);
  assert.deepEqual(liveLines("/b", all), ["On the running robot: Runs as expected.", "/b publishes /x"]);
  assert.deepEqual(liveLines("/c", all), ["On the running robot: Runs; the lifecycle node is not active."]);
  assert.deepEqual(liveLines("/a", UNWATCHED), []);
});
