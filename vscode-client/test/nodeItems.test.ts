import * as assert from "node:assert/strict";
import { describe, it } from "node:test";
import {
  colourOf,
  decorationOf,
  differenceSection,
  extras,
  iconOf,
  identified,
  type NodeItem,
  spoken,
  written,
} from "../src/nodeItems";

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

  it("has the number of its file in the graph where there are several, and the name of an include first", () => {
    const node = item("node", "talker", { detail: "demo/talker.py", file: 1 });
    assert.deepEqual(written(node, 2), { label: "talker", description: "② demo/talker.py" });
    assert.deepEqual(written(node, 1), { label: "talker", description: "demo/talker.py" });
    const include = item("include", "robot/launch/arm.launch", { detail: "2 nodes", file: 20 });
    assert.deepEqual(written(include, 30), { label: "arm.launch", description: "(21) 2 nodes  robot/launch" });
    const plain = item("include", "unresolved include", { detail: "0 nodes" });
    assert.deepEqual(written(plain, 2), { label: "unresolved include", description: "0 nodes" });
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

  it("lists what is not as expected on the running robot, with what was seen and when", () => {
    const difference = {
      node: "/a",
      what: "publisher",
      name: "/odom",
      message: "/a publishes /odom as std_msgs/String",
      expected: "nav_msgs/Odometry",
      actual: "std_msgs/String",
      counts: true,
      since: new Date(2026, 1, 2, 12, 4, 17).getTime(),
    };
    const [section] = differenceSection([difference]);
    assert.equal(section?.label, "Differences on the running robot");
    assert.equal(section.children[0]?.detail, "since 12:04:17");
    assert.equal(section.children[0]?.note, "expected: nav_msgs/Odometry\nseen: std_msgs/String");
    assert.deepEqual(differenceSection([]), []);
  });

  it("is read out with its findings, its file and what it does", () => {
    const files = ["robot.launch", "arm.launch"];
    const bad = item("node", "driver", { detail: "arm/driver.py", severity: 1, findings: 2, file: 1 });
    assert.equal(
      spoken(bad, files, "missing"),
      "node driver, arm/driver.py, 2 findings, the worst: error, on the running robot: not running, from arm.launch",
    );
    assert.equal(
      spoken(item("namespace", "ns/", { children: [bad] }), files, undefined),
      "namespace ns/, 2 findings, the worst: error",
    );
    assert.equal(
      spoken(item("not-taken", "simulator", { detail: "if $(arg sim)" }), files, undefined),
      "not started: simulator, if $(arg sim)",
    );
    assert.equal(spoken(item("section", "Includes", { detail: "2" }), files, undefined), "Includes, 2");
    assert.equal(spoken(item("param", "rate", { detail: "5" }), files, undefined), "parameter rate, 5");
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
