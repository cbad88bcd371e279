import * as assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { it } from "node:test";
import { notice, plain } from "../src/messages";

/** What the editor makes links of (its `linkedText.ts`). */
const LINK = /\[([^\]]+)\]\(((?:https?:\/\/|command:|file:)[^)\s]+)(?: (["'])(.+?)(\3))?\)/i;

it("no link is left in a message", () => {
  const path = "/ws/[Open](command:workbench.action.terminal.sendSequence?%7B%22text%22%3A%22x%22%7D)";
  assert.match(path, LINK);
  assert.doesNotMatch(notice(`${path} cannot be shown`), LINK);
  assert.doesNotMatch(plain("[[a](]([a](https://x)"), LINK);
});

it("other text stays as it is", () => {
  assert.equal(notice("the server is not running."), "ROS Preflight: the server is not running.");
  assert.equal(plain("[a] (b) c[0]"), "[a] (b) c[0]");
});

it("all messages are made so", () => {
  for (const name of readdirSync("src")) {
    const calls = readFileSync(`src/${name}`, "utf8")
      .split(/show(?:Information|Warning|Error)Message\(\s*/)
      .slice(1);
    assert.ok(
      calls.every((call) => call.startsWith("notice(")),
      name,
    );
  }
});
