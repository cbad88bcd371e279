import * as assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { it } from "node:test";

interface Manifest {
  readonly contributes: {
    readonly configuration: { readonly properties: Readonly<Record<string, { readonly scope: string }>> };
  };
}

it("a workspace has no say in which server is started, and with which Python it is installed", () => {
  const { contributes } = JSON.parse(readFileSync("package.json", "utf8")) as Manifest;
  const ofTheServer = Object.entries(contributes.configuration.properties).filter(([name]) =>
    name.startsWith("rosPreflight.server."),
  );
  assert.equal(ofTheServer.length, 3);
  for (const [name, { scope }] of ofTheServer) {
    assert.equal(scope, "machine", name);
  }
});
