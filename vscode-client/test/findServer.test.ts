import * as assert from "node:assert/strict";
import { describe, it } from "node:test";
import { findServer, ServerNotFound, type Surroundings } from "../src/findServer";

function around(executables: string[], more: Partial<Surroundings> = {}): Surroundings {
  return {
    searchPath: "/usr/local/bin:/usr/bin",
    home: "/home/user",
    isExecutable: (file) => executables.includes(file),
    ...more,
  };
}

describe("findServer without a setting", () => {
  for (const setting of [undefined, null, "", "  ", []]) {
    it(`looks on PATH when the setting is ${JSON.stringify(setting)}`, () => {
      const server = findServer(setting, around(["/usr/bin/ros-preflight"]));
      assert.deepEqual(server, { program: "/usr/bin/ros-preflight", args: ["lsp"], foundIn: "PATH" });
    });
  }

  it("takes PATH before ~/.local/bin", () => {
    const all = ["/usr/bin/ros-preflight", "/home/user/.local/bin/ros-preflight"];
    const found = [0, 1].map((from) => findServer([], around(all.slice(from)))?.program);
    assert.deepEqual(found, all);
  });

  it("leaves relative entries of PATH out", () => {
    const searchPath = ".::bin:/usr/bin";
    const isExecutable = () => true;
    assert.equal(findServer([], around([], { searchPath, isExecutable }))?.program, "/usr/bin/ros-preflight");
  });

  it("gives nothing when it is nowhere", () => {
    assert.equal(findServer([], around([], { searchPath: undefined })), undefined);
  });
});

describe("findServer with a setting", () => {
  it("takes a path", () => {
    const server = findServer("/opt/x/ros-preflight", around(["/opt/x/ros-preflight", "/usr/bin/ros-preflight"]));
    assert.deepEqual([server?.program, server?.args], ["/opt/x/ros-preflight", ["lsp"]]);
  });

  it("takes a list, whose arguments come before lsp", () => {
    const server = findServer(["python3", "-m", "preflight_server"], around(["/usr/bin/python3"]));
    assert.deepEqual([server?.program, server?.args], ["/usr/bin/python3", ["-m", "preflight_server", "lsp"]]);
  });

  it("knows ~", () => {
    const server = findServer("~/venv/bin/ros-preflight", around(["/home/user/venv/bin/ros-preflight"]));
    assert.equal(server?.program, "/home/user/venv/bin/ros-preflight");
  });

  for (const setting of ["/nowhere/ros-preflight", "no-such-command", "./ros-preflight", "../x/ros-preflight"]) {
    it(`does not fall back when '${setting}' leads nowhere`, () => {
      const isExecutable = (file: string) => file === "/usr/bin/ros-preflight" || !file.startsWith("/");
      assert.throws(() => findServer(setting, around([], { isExecutable })), {
        constructor: ServerNotFound,
        message: /rosPreflight\.server\.command names '/,
      });
    });
  }

  for (const setting of [42, [1], ["x", null], { command: "x" }]) {
    it(`refuses ${JSON.stringify(setting)}`, () => {
      assert.throws(() => findServer(setting, around(["/usr/bin/x"])), {
        constructor: ServerNotFound,
        message: /must be a path or a list of strings/,
      });
    });
  }
});
