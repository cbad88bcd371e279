import * as assert from "node:assert/strict";
import { it } from "node:test";
import { RestartPolicy } from "../src/restartPolicy";

it("allows five restarts in three minutes, then none until the first is three minutes old", () => {
  let minutes = 0;
  const policy = new RestartPolicy(5, 3 * 60_000, () => minutes * 60_000);
  const at = (when: number) => {
    minutes = when;
    return policy.allowsRestart();
  };
  assert.deepEqual([0, 0.5, 1, 1.5, 2].map(at), [true, true, true, true, true]);
  assert.equal(at(2.5), false);
  assert.equal(at(2.9), false);
  assert.equal(at(3), true);
  assert.equal(at(3.4), false);
});
