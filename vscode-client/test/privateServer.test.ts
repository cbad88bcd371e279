import * as assert from "node:assert/strict";
import { chmodSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import * as path from "node:path";
import { after, beforeEach, describe, it } from "node:test";
import { type Installer, InstallFailed, install, installed } from "../src/privateServer";
import { isExecutable } from "./files";

const folder = mkdtempSync(path.join(tmpdir(), "private-"));
const storage = path.join(folder, "storage");
const requirements = path.join(folder, "requirements.txt");
const calls = path.join(folder, "calls");
after(() => rmSync(folder, { recursive: true }));
beforeEach(() => {
  rmSync(storage, { recursive: true, force: true });
  writeFileSync(requirements, "ros-preflight==0.1.0 --hash=sha256:00");
  writeFileSync(calls, "");
});

/** A Python that notes how it is called, and copies itself into the virtual environments that it makes. */
function python(name: string, version: string, venv = "", pip = ""): string {
  const file = path.join(folder, name);
  writeFileSync(
    file,
    `#!/bin/sh
echo "$@ PYTHONPATH=$PYTHONPATH" >>"${calls}"
case "$*" in
  "-I -c "*) echo ${version} ;;
  *venv*) ${venv || 'mkdir -p "$4/bin" && cp "$0" "$4/bin/python"'} ;;
  *pip*) ${pip || "echo fetched"} ;;
esac
`,
  );
  chmodSync(file, 0o755);
  return file;
}

function installer(more: Partial<Installer> = {}): Installer {
  const environment = { PATH: process.env["PATH"], PYTHONPATH: "/opt/ros/lib" };
  const signal = new AbortController().signal;
  return { storage, requirements, environment, line: () => undefined, step: () => undefined, signal, ...more };
}

describe("the private environment", () => {
  it("is made with the first Python that is new enough, without the modules of a sourced ROS", async () => {
    const [old, good] = [python("old", "3.8"), python("good", "3.11")];
    const steps: string[] = [];
    const command = await install([path.join(folder, "missing"), old, good], installer({ step: (s) => steps.push(s) }));
    assert.match(command.join(" "), /storage\/server-\w+-\d+-\d+\/bin\/python -I -m preflight_server$/);
    assert.equal(steps.length, 2);
    const called = readFileSync(calls, "utf8").trim().split("\n");
    assert.ok(called.every((line) => line.endsWith("PYTHONPATH=")));
    assert.deepEqual(installed(storage, requirements, isExecutable), command);
  });

  it("has only files whose hashes came with the extension, and nothing that is built", async () => {
    await install([python("good", "3.11")], installer());
    const pip = readFileSync(calls, "utf8").trim().split("\n").at(-1) ?? "";
    assert.match(pip, /^-I -m pip install .*--require-hashes --only-binary :all: /);
    assert.ok(pip.includes(` --find-links ${folder} --requirement ${requirements} `));
  });

  it("is made anew for other requirements, and the old one goes", async () => {
    const good = python("good", "3.13");
    await install([good], installer());
    writeFileSync(requirements, "ros-preflight==0.1.1 --hash=sha256:11");
    assert.equal(installed(storage, requirements, isExecutable), undefined);
    await install([good], installer());
    assert.notEqual(installed(storage, requirements, isExecutable), undefined);
    assert.equal(readdirSync(storage).filter((name) => name.startsWith("server-")).length, 1);
  });

  it("is not there before it was made, nor when its record is broken", () => {
    assert.equal(installed(storage, requirements, isExecutable), undefined);
    mkdirSync(storage);
    writeFileSync(path.join(storage, "server.json"), "{");
    assert.equal(installed(storage, requirements, isExecutable), undefined);
  });
});

describe("what goes wrong is said", () => {
  const cases: [what: string, pythons: () => string[], message: RegExp][] = [
    ["no Python", () => [], /needs Python 3\.10 to 3\.14, and none was found\.$/],
    ["one that is too old", () => [python("old", "3.8")], /none was found \(.*old is 3\.8\)/],
    ["one that is too new", () => [python("new", "3.15")], /none was found \(.*new is 3\.15\)/],
    [
      "no venv",
      () => [python("bare", "3.11", "echo 'ensurepip is not available'; exit 1")],
      /install the package python3-venv/,
    ],
    [
      "no network",
      () => [python("offline", "3.11", "", "echo 'ERROR: No matching distribution found for pygls' >&2; exit 1")],
      /with pip failed: No matching distribution found for pygls$/,
    ],
  ];
  for (const [what, pythons, message] of cases) {
    it(what, async () => {
      await assert.rejects(install(pythons(), installer()), { constructor: InstallFailed, message });
      assert.deepEqual(readdirSync(storage), [], "nothing is left behind");
    });
  }

  it("a cancelled one", async () => {
    const abort = new AbortController();
    const slow = python("slow", "3.11", "sleep 600");
    const started = install([slow], installer({ signal: abort.signal, step: () => abort.abort() }));
    await assert.rejects(started, { constructor: InstallFailed, message: /was cancelled/ });
  });
});
