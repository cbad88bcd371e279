import * as assert from "node:assert/strict";
import { it } from "node:test";
import type { Uri } from "vscode";
import { type PythonApi, selectedInterpreter } from "../src/pythonInterpreter";

function api(environment: { executable: { uri: Uri | undefined } } | undefined): PythonApi {
  return {
    environments: {
      getActiveEnvironmentPath: () => ({ path: "/venv" }),
      resolveEnvironment: ({ path }) => Promise.resolve(path === "/venv" ? environment : undefined),
    },
  };
}

it("gives the file of the selected interpreter", async () => {
  const uri = { fsPath: "/venv/bin/python" } as Uri;
  assert.equal(await selectedInterpreter(api({ executable: { uri } }), undefined), "/venv/bin/python");
});

it("gives nothing for an environment without Python, or for none", async () => {
  assert.equal(await selectedInterpreter(api({ executable: { uri: undefined } }), undefined), undefined);
  assert.equal(await selectedInterpreter(api(undefined), undefined), undefined);
});
