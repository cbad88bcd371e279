import * as assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, realpathSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import * as path from "node:path";
import { after, describe, it } from "node:test";
import { ShownPlaces } from "../src/shownPlaces";

const top = realpathSync(mkdtempSync(path.join(tmpdir(), "places-")));
after(() => rmSync(top, { recursive: true }));

function file(name: string): string {
  const made = path.join(top, name);
  mkdirSync(path.dirname(made), { recursive: true });
  writeFileSync(made, "");
  return made;
}

function link(name: string, to: string): string {
  const made = path.join(top, name);
  mkdirSync(path.dirname(made), { recursive: true });
  symlinkSync(to, made);
  return made;
}

const launch = file("ws/launch/robot.launch");
const source = file("ws/scripts/talker");
const included = file("opt/share/launch/base.launch");
const key = file("home/.ssh/id_rsa");
const installed = file("opt/lib/driver.py");

describe("places of the shown graph", () => {
  const places = [{ file: launch, line: 3, column: 5 }];
  const graph = {
    title: "",
    files: [{ path: launch }],
    nodes: [{ places }],
    edges: [{ places: [{ file: source, line: 9, column: 1 }] }],
  };
  const shown = new ShownPlaces(graph);

  it("are known to the column", () => {
    assert.ok(shown.has({ file: launch, line: 3, column: 5 }));
    assert.ok(shown.has({ file: source, line: 9, column: 1 }));
    assert.ok(!shown.has({ file: launch, line: 4, column: 5 }));
    assert.ok(!shown.has({ file: launch, line: 3, column: 6 }));
    assert.ok(!shown.has({ file: key, line: 1, column: 1 }));
    assert.ok(!new ShownPlaces().has({ file: launch, line: 3, column: 5 }));
  });
});

describe("files are opened at once", () => {
  const launched = [launch, included, key, link("ws/launch/key.launch", key)].map((each) => ({ path: each }));
  const shown = new ShownPlaces({ title: "", files: launched, nodes: [], edges: [] });
  const folders = [path.join(top, "ws")];
  const own: [what: string, file: string][] = [
    ["a launch file of the workspace", launch],
    ["a source of the workspace", source],
    ["a launch file that is included from elsewhere", included],
    ["a link to a source of the workspace", link("install/lib/talker", source)],
  ];
  for (const [what, name] of own) {
    it(what, () => assert.equal(shown.belongs(name, folders), "workspace"));
  }
  const others: [what: string, file: string][] = [
    ["a source elsewhere, where a node may have said anything", installed],
    ["a key that a launch file includes", key],
    ["a link of the workspace to it", path.join(top, "ws/launch/key.launch")],
    ["what is hidden in the workspace", file("ws/.git/config")],
    ["a way out of the workspace", path.join(folders[0] ?? "", "../home/.ssh/id_rsa")],
    ["a folder whose name begins as the workspace's", file("ws-other/a.py")],
  ];
  for (const [what, name] of others) {
    it(`but not ${what}`, () => assert.equal(shown.belongs(name, folders), "elsewhere"));
  }
  it("and what is no file never", () => {
    const fifo = path.join(top, "ws/fifo");
    execFileSync("mkfifo", [fifo]);
    for (const name of [fifo, folders[0] ?? "", "/dev/zero", path.join(top, "gone"), "/etc/passwd/x"]) {
      assert.equal(shown.belongs(name, folders), "nowhere", name);
    }
  });
  it("without a folder it is launch files alone", () => {
    assert.equal(shown.belongs(launch, []), "workspace");
    assert.equal(shown.belongs(source, []), "elsewhere");
  });
});
