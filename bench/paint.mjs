// Opens pages in Chromium and prints, as JSON, when each was first painted with something on it, in milliseconds.
import { pathToFileURL } from "node:url";
import { chromium } from "../tests/editors/vscode/node_modules/playwright-core/index.mjs";

const { pages, browser: executablePath, rounds } = JSON.parse(process.argv[2]);
const browser = await chromium.launch({ executablePath, args: ["--disable-gpu", "--no-sandbox", "--no-first-run"] });
const found = Object.fromEntries(Object.keys(pages).map((name) => [name, []]));
for (let round = 0; round < rounds; round += 1) {
  for (const [name, path] of Object.entries(pages)) {
    const page = await browser.newPage({ viewport: { width: 1400, height: 800 } });
    await page.goto(pathToFileURL(path).href);
    const painted = await page.waitForFunction(
      () => performance.getEntriesByName("first-contentful-paint")[0]?.startTime,
    );
    found[name].push(await painted.jsonValue());
    await page.close();
  }
}
await browser.close();
console.log(JSON.stringify(found));
