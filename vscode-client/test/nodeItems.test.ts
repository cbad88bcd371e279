import * as assert from "node:assert/strict";
import { describe, it } from "node:test";
import { colourOf, decorationOf, extras, iconOf, identified, type NodeItem } from "../src/nodeItems";

function item(kind: NodeItem["kind"], label: string, more: Partial<NodeItem> = {}): NodeItem {
  return {
    kind,
    label,
    detail: "",
    name: "",
    location: null,
    file: null,
    note: "",
    severity: null,
    findings: 0,
    children: [],
    ...more,
  };
}

describe("a line of the tree", () => {
  it("has the colour of its file, the root's being another than the next one's", () => {
    assert.notEqual(colourOf(0), colourOf(1));
    assert.equal(colourOf(0), colourOf(6));
    assert.equal(colourOf(null), undefined);
  });

  it("shows what the running robot does", () => {
    const node = item("node", "talker");
    const states = [undefined, "present", "missing", "dead", "extra", "wrong-type", "inactive", "unsure"] as const;
    assert.equal(new Set(states.map((live) => iconOf(node, live))).size, states.length);
  });

  it("is there for what runs and was not launched", () => {
    const [section] = extras(
      new Map([
        ["/b", "extra"],
        ["/ok", "present"],
        ["/a", "extra"],
      ]),
    );
    assert.deepEqual(
      section?.children.map(({ name }) => name),
      ["/a", "/b"],
    );
    assert.deepEqual(extras(new Map([["/ok", "present"]])), []);
  });

  it("is marked by the worst of its findings, and a namespace by those of its nodes", () => {
    const bad = item("node", "a", { severity: 1, findings: 2 });
    const fair = item("node", "b", { severity: 2, findings: 1 });
    const good = item("node", "c");
    assert.equal(decorationOf(bad), "error=2");
    assert.equal(decorationOf(fair), "warning=1");
    assert.equal(decorationOf(good), undefined);
    assert.equal(decorationOf(item("namespace", "ns/", { children: [bad, fair, good] })), "error=3");
    assert.equal(decorationOf(item("namespace", "ns/", { children: [good] })), undefined);
    assert.equal(decorationOf(item("not-taken", "d")), "left-out");
  });

  it("keeps its name when the tree is made anew, whatever comes before it", () => {
    const [a, b] = [item("node", "a", { name: "/a" }), item("node", "b", { name: "/b" })];
    const ids = identified([a, b]).map(({ id }) => id);
    assert.deepEqual(
      identified([item("node", "new", { name: "/new" }), a, b])
        .map(({ id }) => id)
        .slice(1),
      ids,
    );
    assert.equal(new Set(identified([a, a, a]).map(({ id }) => id)).size, 3);
  });
});
