import * as assert from "node:assert/strict";
import { describe, it } from "node:test";
import { choices, hint, parseArguments, prefilled, type Root } from "../src/roots";

const path = (uri: string) => uri.replace("file:///ws/", "");

const robot: Root = {
  uri: "file:///ws/robot.launch",
  args: { name: "husky", note: "two words" },
  declared: [
    { name: "name", default: null, doc: null, required: true },
    { name: "port", default: null, doc: "where it is", required: true },
    { name: "camera", default: "true", doc: null, required: false },
    { name: "title", default: "a b", doc: null, required: false },
  ],
};

describe("choices", () => {
  it("marks the shown one and offers the file itself and the usual root", () => {
    const found = choices({ shown: { ...robot }, roots: [robot] }, "file:///ws/inc.launch", path);
    assert.deepEqual(
      found.map(({ label, description, root }) => [label, description, root?.uri]),
      [
        ['robot.launch name:=husky note:="two words"', "shown", robot.uri],
        ["inc.launch", "this file", "file:///ws/inc.launch"],
        ["Default", "what counts where you choose none", undefined],
      ],
    );
  });

  it("does not offer the file twice", () => {
    const alone: Root = { uri: "file:///ws/inc.launch", args: {}, declared: [] };
    const found = choices({ shown: alone, roots: [alone] }, alone.uri, path);
    assert.deepEqual(
      found.map(({ label }) => label),
      ["inc.launch", "Default"],
    );
    assert.equal(found[0]?.description, "this file, shown");
  });
});

describe("the input of arguments", () => {
  it("starts with what the root has and what it needs", () => {
    assert.equal(prefilled(robot), 'name:=husky note:="two words" port:=');
    assert.equal(hint(robot), 'camera:=true title:="a b"');
  });

  it("comes back as it was prefilled", () => {
    assert.deepEqual(parseArguments(prefilled(robot)), { name: "husky", note: "two words", port: "" });
  });

  it("takes quotes and empty values", () => {
    assert.deepEqual(parseArguments(`  a:=1 b:='x "y"'  c:="" d:= e_1:=/dev/x:0 `), {
      a: "1",
      b: 'x "y"',
      c: "",
      d: "",
      e_1: "/dev/x:0",
    });
    assert.deepEqual(parseArguments("   "), {});
  });

  for (const typed of ["a", "a=1", "a:=1 b", "1a:=2", 'a:="x', 'a:="x"y', "a:= :=b"]) {
    it(`says what is wrong with ${typed}`, () => {
      assert.match(String(parseArguments(typed)), /is not name:=value$/);
    });
  }
});
