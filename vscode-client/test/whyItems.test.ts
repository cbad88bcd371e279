import * as assert from "node:assert/strict";
import { describe, it } from "node:test";
import type { Location } from "vscode-languageserver-types";
import { type Link, partners, reasonItems } from "../src/whyItems";

const start = { line: 6, character: 4 };
const location: Location = { uri: "file:///ws/a.launch", range: { start, end: start } };
const shown = ({ uri, range }: Location) => `${uri.split("/").at(-1)}:${range.start.line + 1}`;

function link(state: Link["state"], text: string, more: Partial<Link> = {}): Link {
  return { state, text, location: null, fixes: [], ...more };
}

describe("the links of connections", () => {
  it("stand alone where there is one connection", () => {
    const items = reasonItems([{ title: "/a -> /b: connected", links: [link("ok", "/a is started")] }], shown);
    assert.deepEqual(
      items.map(({ label }) => label),
      ["$(pass) /a is started"],
    );
  });

  it("stand below the title of their connection, with place and fix", () => {
    const broken = link("broken", "different names", { location, fixes: ["Replace 'a' with 'b'"] });
    const items = reasonItems(
      [
        { title: "/a -> /b: not connected", links: [link("ok", "/a is started"), broken] },
        { title: "/a -> /b: connected", links: [] },
      ],
      shown,
    );
    assert.deepEqual(
      items.map(({ label, description, detail }) => [label, description, detail]),
      [
        ["/a -> /b: not connected", undefined, undefined],
        ["$(pass) /a is started", undefined, undefined],
        ["$(error) different names", "a.launch:7", "Quick fix: Replace 'a' with 'b'"],
        ["/a -> /b: connected", undefined, undefined],
      ],
    );
    assert.equal(items.at(2)?.link, broken);
  });

  it("have no icons and no commands of the workspace", () => {
    const [item] = reasonItems([{ title: "", links: [link("unknown", "$(python) [x](command:y) $(var a)")] }], shown);
    assert.equal(item?.label, "$(question) \\$(python) [x] (command:y) $(var a)");
  });
});

describe("the second node", () => {
  it("is first of all one at the other end", () => {
    assert.deepEqual(partners(["/a", "/b", "/c", "/d"], "/b", ["/d", "/b", "/gone"]), ["/d", "/a", "/c"]);
  });
});
