import * as assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { homedir, tmpdir } from "node:os";
import * as path from "node:path";
import { after, describe, it } from "node:test";
import { parseEnvironment, SetupFailed, Setups, setupPaths } from "../src/setups";

const folder = mkdtempSync(path.join(tmpdir(), "setups-"));
after(() => rmSync(folder, { recursive: true }));

function file(name: string, text: string): string {
  const made = path.join(folder, name);
  writeFileSync(made, text);
  return made;
}

const base = { PATH: process.env["PATH"], HOME: "/nowhere" };

describe("the setting", () => {
  it("knows the home folder and the workspace's", () => {
    assert.deepEqual(setupPaths(["~/a.bash", "${workspaceFolder}/install/setup.bash", "/opt/x/../y"], "/ws"), [
      `${homedir()}/a.bash`,
      "/ws/install/setup.bash",
      "/opt/y",
    ]);
    assert.deepEqual(setupPaths(undefined, undefined), []);
  });

  for (const wrong of ["setup.bash", "./x", "${workspaceFolder}/x"]) {
    it(`refuses ${wrong} where no folder is open`, () => {
      assert.throws(() => setupPaths([wrong], undefined), { constructor: SetupFailed, message: /no absolute path/ });
    });
  }
});

describe("sourcing", () => {
  it("gives what the files set, one after the other, with newlines and all", async () => {
    const one = file("one.bash", "export ONE=$'a\\nb=c'\nexport ROS_DISTRO=noetic\necho some words\n");
    const two = file("two 'quoted'.bash", 'export TWO="$ROS_DISTRO-$HOME"\nfalse\n');
    const said: string[] = [];
    const found = await new Setups().environment([one, two], base, (line) => said.push(line));
    assert.equal(found["ONE"], "a\nb=c");
    assert.equal(found["TWO"], "noetic-/nowhere");
    assert.equal(found["_"], undefined);
    assert.deepEqual(said, ["some words"]);
  });

  it("is done once while the files are the same", async () => {
    const count = path.join(folder, "count");
    const counting = file("counting.bash", `echo x >>"${count}"; export N=$(wc -l <"${count}")`);
    const setups = new Setups();
    const n = async () => (await setups.environment([counting], base, () => undefined))["N"]?.trim();
    assert.deepEqual([await n(), await n()], ["1", "1"]);
    setups.forget();
    assert.equal(await n(), "2");
  });

  it("leaves the environment alone where there is nothing to source", async () => {
    assert.equal(await new Setups().environment([], base, () => undefined), base);
  });

  it("says which file is not there", async () => {
    await assert.rejects(
      new Setups().environment(["/no/such.bash"], base, () => undefined),
      {
        constructor: SetupFailed,
        message: /the set-up \/no\/such\.bash .* does not exist/,
      },
    );
  });

  it("says what went wrong", async () => {
    const broken = file("broken.bash", "echo the reason >&2\nexit 3\n");
    await assert.rejects(
      new Setups().environment([broken], base, () => undefined),
      {
        constructor: SetupFailed,
        message: /failed: the reason$/,
      },
    );
  });

  it("does not wait for ever", async () => {
    const endless = file("endless.bash", "sleep 600\n");
    await assert.rejects(
      new Setups(200).environment([endless], base, () => undefined),
      {
        constructor: SetupFailed,
        message: /did not end within 0\.2 seconds/,
      },
    );
  });
});

it("an environment is read as env -0 prints it", () => {
  assert.deepEqual(parseEnvironment("A=1\0B=x=y\0_=/usr/bin/env\0BASH_FUNC_f%%=() { :; }\0"), {
    A: "1",
    B: "x=y",
    "BASH_FUNC_f%%": "() { :; }",
  });
});
