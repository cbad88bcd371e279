// The linter of prose fails on what it should find, and only on that.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const PROSE = fileURLToPath(new URL("prose.mjs", import.meta.url));

function lint(argument, input) {
  const { status, stderr } = spawnSync(process.execPath, [PROSE, argument], { encoding: "utf8", input });
  return { status, said: stderr };
}

function lintTexts(...texts) {
  return lint("-", JSON.stringify(texts.map((text) => ({ place: "--help", text }))));
}

test("plain words pass", () => {
  assert.deepEqual(lintTexts("'/scan' has no publisher.", "Run `check` in ROS 2."), { status: 0, said: "" });
});

test("a phrase to avoid", () => {
  const { status, said } = lintTexts("Runs the node anew.");
  assert.equal(status, 1);
  assert.match(said, /^--help: 'anew': write again/);
});

test("a spelling", () => {
  assert.equal(lintTexts("Works with ROS2.").status, 1);
});

test("code has its own words", () => {
  assert.equal(lintTexts("Set `anew` to `ROS2`.").status, 0);
});

test("the length of a sentence", () => {
  assert.equal(lintTexts(`${"word ".repeat(24)}word.`).status, 0);
  const { status, said } = lintTexts(`${"word ".repeat(25)}word.`);
  assert.equal(status, 1);
  assert.match(said, /a sentence of 26 words: at most 25/);
});

test("the place in a Markdown file: in text, a heading, a list and a table, across lines", () => {
  const folder = mkdtempSync(path.join(tmpdir(), "prose-"));
  const file = path.join(folder, "page.md");
  writeFileSync(
    file,
    "# What holds\n\nOne is\ntold.\n\n- run anew\n\n| a | b |\n| --- | --- |\n| anew | `anew` |\n\n```text\nanew\n```\n",
  );
  const { status, said } = lint(file);
  rmSync(folder, { recursive: true });
  assert.equal(status, 1);
  const places = said.split("\n").flatMap((line) => line.match(/:(\d+:\d+): '/)?.[1] ?? []);
  assert.deepEqual(places, ["1:3", "1:8", "3:5", "6:7", "10:3"]);
});
