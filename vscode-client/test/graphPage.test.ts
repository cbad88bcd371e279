import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { graphPage, utf16Column } from "../src/graphPage";

const PAGE = "../analysis/preflight_analysis/view/page";

test("the page counts only what carries the nonce", () => {
  const page = graphPage((file) => readFileSync(`${PAGE}/${file}`, "utf8"), "abc");
  assert.match(page, /content="default-src 'none'; style-src 'nonce-abc'; script-src 'nonce-abc'; /);
  assert.equal(page.match(/<style[^>]* nonce="abc">/g)?.length, 2);
  assert.equal(page.match(/<script nonce="abc">/g)?.length, 1);
  assert.doesNotMatch(page, /%[A-Z]+%/);
  assert.ok(page.includes(readFileSync(`${PAGE}/view.js`, "utf8")));
});

test("columns in code points become those of the editor", () => {
  assert.equal(utf16Column("<a b='x'/>", 4), 3);
  assert.equal(utf16Column("🤖🤖 x", 4), 5);
  assert.equal(utf16Column("ab", 9), 2);
});
