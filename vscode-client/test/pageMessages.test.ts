import * as assert from "node:assert/strict";
import { describe, it } from "node:test";
import { keptUri, pageMessage } from "../src/pageMessages";

const svg = '<?xml version="1.0" encoding="utf-8"?>\n<svg xmlns="http://www.w3.org/2000/svg"><g/></svg>\n';
const place = { file: "/ws/robot.launch", line: 3, column: 5 };

describe("what the page sends", () => {
  for (const message of [
    { type: "ready", builtin: false },
    { type: "builtin", shown: true },
    { type: "save", svg },
    { type: "open", ...place },
    { type: "why", node: "/talker", channel: "/chatter", others: ["/listener"] },
    { type: "why", node: "/talker", channel: null, others: [] },
  ]) {
    it(message.type, () => {
      assert.deepEqual(pageMessage(message), message);
      assert.deepEqual(
        pageMessage({ ...message, command: "x", uri: "command:x" }),
        message,
        "nothing more is passed on",
      );
    });
  }
});

describe("what the page does not send", () => {
  const crafted: unknown[] = [
    undefined,
    null,
    "open",
    7,
    [],
    ["open"],
    {},
    { type: "run", command: "x" },
    { type: "toString" },
    { type: ["open"], ...place },
    { type: "ready" },
    { type: "ready", builtin: "yes" },
    { type: "builtin", shown: 1 },
    { type: "builtin", shown: null },
    { type: "save" },
    { type: "save", svg: { toString: "x" } },
    { type: "save", svg: "#!/bin/sh\nrm -r ~" },
    { type: "save", svg: `#!/bin/sh\n${svg}` },
    { type: "save", svg: `${svg}more` },
    { type: "save", svg: svg.replace("<g/>", " ".repeat(65 * 1024 * 1024)) },
    { type: "open" },
    { type: "open", ...place, file: "robot.launch" },
    { type: "open", ...place, file: "../../etc/passwd" },
    { type: "open", ...place, file: "file:///etc/passwd" },
    { type: "open", ...place, file: "\\\\host\\share" },
    { type: "open", ...place, file: ["/ws/robot.launch"] },
    { type: "open", ...place, file: "/ws/\0robot.launch" },
    { type: "open", ...place, file: `/${"x".repeat(5000)}` },
    { type: "open", ...place, line: 0 },
    { type: "open", ...place, line: -1 },
    { type: "open", ...place, line: 1.5 },
    { type: "open", ...place, line: "3" },
    { type: "open", ...place, column: NaN },
    { type: "why" },
    { type: "why", node: "talker", channel: null, others: [] },
    { type: "why", node: "/talker", channel: 1, others: [] },
    { type: "why", node: "/talker", channel: null, others: "/a" },
    { type: "why", node: "/talker", channel: null, others: [1] },
    { type: "why", node: "/talker", channel: null, others: Array(10_001).fill("/a") },
    { type: "open", ...place, column: Infinity },
    { type: "open", file: place.file, line: 3 },
  ];
  for (const message of crafted) {
    it(`is no message: ${(JSON.stringify(message) ?? "undefined").slice(0, 80)}`, () =>
      assert.equal(pageMessage(message), undefined));
  }
});

describe("what a page has kept", () => {
  it("is the launch file that it was of", () =>
    assert.equal(keptUri({ uri: "file:///ws/a.launch" }), "file:///ws/a.launch"));
  for (const state of [
    undefined,
    null,
    "file:///x",
    {},
    { uri: 1 },
    { uri: "command:x" },
    { uri: "https://x" },
    { uri: "file://host/x" },
  ]) {
    it(`and no ${JSON.stringify(state)}`, () => assert.equal(keptUri(state), undefined));
  }
});
