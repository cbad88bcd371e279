import * as assert from "node:assert/strict";
import { it } from "node:test";
import { advice } from "../src/doctorActions";

const PAGE = `server        /bin/ros-preflight lsp (found in PATH)
set-ups       not sourced: the workspace is not trusted
distribution  ROS 1 Noetic
sandbox       does not work: bwrap is not installed
traces        /home/me/.cache
missing       1 package: amcl
install with  sudo apt install ros-noetic-amcl
`;

it("offers what the doctor's page advises, at its line", () => {
  const found = advice(PAGE, false);
  const at = (line: number) =>
    found.filter((each) => each.line === line).map(({ command, arguments: given }) => [command, ...given]);
  assert.deepEqual(at(6), [["rosPreflight.writeIntoTerminal", "sudo apt install ros-noetic-amcl"]]);
  assert.deepEqual(at(3), [["rosPreflight.writeIntoTerminal", "sudo apt install bubblewrap"]]);
  assert.deepEqual(at(1), [["workbench.trust.manage"]]);
  assert.deepEqual(at(0), [["rosPreflight.restartServer"]]);
  assert.deepEqual(at(5), []);
});

it("leads to the setting where a set-up failed", () => {
  const [one] = advice("set-ups       not sourced: /x does not exist\n", true);
  assert.deepEqual(
    [one?.command, one?.arguments],
    ["workbench.action.openSettings", ["rosPreflight.environment.setup"]],
  );
});

it("offers nothing where nothing is wrong", () => {
  assert.deepEqual(advice("distribution  ROS 1 Noetic\nsandbox       works: bubblewrap\n", true), []);
});
