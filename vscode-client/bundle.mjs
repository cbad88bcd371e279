// Bundles the extension into dist/extension.js, with the page of the graph view in dist/view and the licences of what is bundled in dist/THIRD_PARTY_NOTICES.txt.
import { cpSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const { metafile } = await build({
  entryPoints: ["src/extension.ts"],
  outfile: "dist/extension.js",
  bundle: true,
  platform: "node",
  format: "cjs",
  target: "node20",
  external: ["vscode"],
  minify: true,
  metafile: true,
  logLevel: "info",
});

const packages = new Set(
  Object.keys(metafile.inputs).flatMap((input) => /^(?:.*\/)?node_modules\/(?:@[^/]+\/)?[^/]+/.exec(input)?.[0] ?? []),
);
const notices = [...packages].sort().map((folder) => {
  const { name, version, license } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  if (file === undefined) {
    throw new Error(`${folder} is bundled and has no licence file`);
  }
  return `${name} ${version} (${license})\n\n${readFileSync(`${folder}/${file}`, "utf8").trim()}\n`;
});
writeFileSync("dist/THIRD_PARTY_NOTICES.txt", notices.join(`\n${"-".repeat(80)}\n\n`));

// The same page as that of `ros-preflight graph --format html`.
const page = "../analysis/preflight_analysis/view/page";
mkdirSync("dist/view", { recursive: true });
for (const file of ["page.html", "drawing.css", "view.css"]) {
  cpSync(`${page}/${file}`, `dist/view/${file}`);
}
await build({ entryPoints: [`${page}/view.js`], outfile: "dist/view/view.js", bundle: true, format: "iife" });

// The page in the editor: its pictures are found in the repository alone.
writeFileSync("dist/README.md", readFileSync("README.md", "utf8").replaceAll(/^!\[.*\]\(images\/.*\)\n\n/gm, ""));
