// Drives the page of `graph --format html` as a reader would. Arguments: where things are, as JSON. Prints what was
// seen as JSON; a step that fails is named on standard error.
import { mkdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { CHROMIUM_FLAGS, PATIENCE } from "./workbench.mjs";

const { pages, screenshots, browser: executablePath } = JSON.parse(process.argv[2]);
const seen = {};
const browser = await chromium.launch({ executablePath, args: CHROMIUM_FLAGS });
let page;
let current = "start";

async function open(name, { colorScheme = "light", inEditor = false } = {}) {
  await page?.context().close();
  const context = await browser.newContext({
    viewport: { width: 1400, height: 800 },
    colorScheme,
    acceptDownloads: true,
  });
  context.setDefaultTimeout(PATIENCE);
  page = await context.newPage();
  seen.wrong ??= [];
  const { wrong } = seen;
  page.on("pageerror", (error) => wrong.push(`${name}: ${error}`));
  page.on("console", (message) => message.type() === "error" && wrong.push(`${name}: ${message.text()}`));
  page.on("dialog", (dialog) => wrong.push(`${name}: ${dialog.message()}`) && dialog.dismiss());
  page.on(
    "request",
    (request) => request.url().startsWith("file:") || wrong.push(`${name}: asked for ${request.url()}`),
  );
  if (inEditor) {
    // What VS Code gives to a page in a webview.
    await page.addInitScript(() => {
      const sent = [];
      window.sent = sent;
      let state;
      window.acquireVsCodeApi = () => ({
        getState: () => state,
        setState: (next) => (state = next),
        postMessage: (message) => sent.push(message),
      });
    });
  }
  await page.goto(pathToFileURL(pages[name]).href);
  if (inEditor) {
    await page.evaluate(() => {
      document.body.classList.add("vscode-light");
      window.postMessage(
        {
          type: "graph",
          graph: JSON.parse(document.getElementById("data").textContent).plain,
          uri: "file:///robot.launch",
        },
        "*",
      );
    });
  }
  await page.locator("#canvas svg").waitFor();
}

async function step(name, action) {
  current = name;
  seen[name] = await action();
}

async function picture(name) {
  mkdirSync(screenshots, { recursive: true });
  await page.screenshot({ path: path.join(screenshots, `${name}.png`), animations: "disabled" });
}

const labels = (locator) => locator.evaluateAll((items) => items.map((item) => item.getAttribute("aria-label")).sort());
const shown = () =>
  labels(page.locator("[data-node]:not(.off):not(.context), .stack:not(.off) [data-channel]:not(.context)"));
const context = () => labels(page.locator("[data-node].context:not(.off), .stack:not(.off) [data-channel].context"));
const item = (name) => page.locator(`[aria-label^="${name}"]`).first();
const focused = () =>
  page.evaluate(() => document.activeElement.getAttribute("aria-label") ?? document.activeElement.id);
const press = async (...keys) => {
  for (const key of keys) {
    await page.keyboard.press(key);
  }
  return focused();
};

try {
  await step("open", () => open("robot"));
  await picture("graph-1-light");
  seen.all = (await shown()).length;
  seen.status = await page.locator("#status").innerText();

  await step("search", async () => {
    await page.keyboard.press("/");
    await page.keyboard.type("scan");
    const found = { first: await page.locator("#found").innerText(), all: (await shown()).length };
    found.marked = await labels(page.locator(".match"));
    found.second = await press("Enter").then(() => page.locator("#found").innerText());
    found.back = await press("Shift+Enter").then(() => page.locator("#found").innerText());
    await picture("graph-11-search");
    await press("Enter");
    found.escaped = await press("Escape");
    return { ...found, left: await page.locator(".match, .found").count() };
  });
  await step("fold", async () => {
    const space = page.locator("[data-frame]");
    const open = { label: await space.getAttribute("aria-label"), state: await space.getAttribute("aria-expanded") };
    const inside = await item("node /camera/driver").locator(".name").innerHTML();
    await space.locator(".name").click();
    const found = { open, inside, folded: await space.getAttribute("aria-expanded") };
    found.hidden = (await shown()).some((label) => label.startsWith("node /camera/"));
    await space.hover();
    found.hint = await page.locator("#hint").innerText();
    await picture("graph-12-folded");
    await space.focus();
    await press("Enter");
    found.unfolded = await space.getAttribute("aria-expanded");
    await page.locator("#fold").click();
    await page.locator("#filter").fill("detector");
    return { ...found, byAll: inside !== "" && (await space.getAttribute("aria-expanded")) };
  });
  await step("focus", async () => {
    await page.locator("#filter").fill("");
    await item("node /slam").focus();
    await press("f");
    const found = { shown: await shown(), button: await page.locator("#unfocus").innerText() };
    await picture("graph-13-focus");
    await press("Escape");
    return { ...found, all: (await shown()).length };
  });
  await step("legend", async () => {
    const legend = page.locator("#legend");
    const numbers = await page.locator("#legend .file").allTextContents();
    const onNode = await item("node /planner").locator(".file").innerHTML();
    await page.locator("#show-legend").click();
    const folded = await legend.isVisible();
    await page.locator("#show-legend").click();
    return { numbers, onNode, folded, open: await legend.isVisible() };
  });
  await step("filter", async () => {
    await page.locator("#only").check();
    await page.keyboard.press("/");
    await page.keyboard.type("ns:/camera");
    return { shown: await shown(), context: await context(), status: await page.locator("#status").innerText() };
  });
  await picture("graph-2-filter");
  await step("glob", async () => {
    await page.locator("#filter").fill("topic:/*map");
    return { shown: await shown(), context: await context() };
  });
  await step("without", async () => {
    await page.locator("#filter").fill("-camera -node:tele*");
    return shown();
  });
  await step("nothing", async () => {
    await page.locator("#filter").fill("no such thing");
    return { shown: await shown(), marked: await page.locator("#filter.nothing").count() };
  });
  await step("cleared", async () => {
    await page.keyboard.press("Escape");
    return { value: await page.locator("#filter").inputValue(), all: (await shown()).length };
  });
  await step("kinds", async () => {
    await page.locator("#show-service").uncheck();
    const without = await shown();
    await page.locator("#show-service").check();
    return without.filter((label) => label.startsWith("service"));
  });
  await step("problems", async () => {
    await page.locator("#problems").check();
    const found = { shown: await shown(), context: await context() };
    await picture("graph-3-problems");
    await page.locator("#problems").uncheck();
    return found;
  });
  await step("builtin", async () => {
    await page.locator("#builtin").check();
    const found = (await shown()).filter((label) => label.includes("rosout"));
    await page.locator("#builtin").uncheck();
    return found;
  });

  await step("hover", async () => {
    await item("topic /odom").hover();
    const topic = await page.locator("#hint").innerText();
    await picture("graph-4-hover");
    const route = page.locator(".route.error .wide").first();
    const [x, y] = await route.evaluate((line) => {
      const point = line.getPointAtLength(line.getTotalLength() / 2).matrixTransform(line.getScreenCTM());
      return [point.x, point.y];
    });
    await page.mouse.move(x, y, { steps: 3 });
    await page.locator("#hint", { hasText: "nav_msgs/Odometry" }).waitFor();
    return { topic, edge: await page.locator("#hint").innerText() };
  });
  await step("click", async () => {
    await item("node /planner").click();
    const text = await page.locator("#details").innerText();
    await page.mouse.move(700, 760);
    await picture("graph-5-details");
    await page.locator("#details button.item", { hasText: "/map" }).click();
    return { text, followed: await page.locator("#details h2").innerText(), focused: await focused() };
  });
  await step("keyboard", async () => {
    const found = { closed: await press("Escape").then(() => page.locator("#details").isVisible()) };
    await item("node /teleop").focus();
    found.right = await press("ArrowRight");
    found.along = await press("ArrowRight");
    found.back = await press("ArrowLeft");
    found.down = await press("ArrowDown");
    found.opened = await press("Enter").then(() => page.locator("#details h2").innerText());
    found.filter = await press("/");
    found.escaped = await press("Escape", "Escape");
    return found;
  });
  await step("tab", async () => {
    // From the last of the tool bar into the picture, and no other stop within it.
    await page.locator("#theme").focus();
    return [await press("Tab"), await press("Tab"), await press("Tab")];
  });
  await step("zoom", async () => {
    const width = () => page.locator("#canvas svg").evaluate((svg) => Number(svg.getAttribute("width")));
    const before = await width();
    await page.locator("#zoom-in").click();
    return (await width()) / before;
  });
  await step("saved", async () => {
    await page.locator("#filter").fill("odom");
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#save").click()]);
    return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
  });

  await step("dark", async () => {
    await open("robot", { colorScheme: "dark" });
    const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const dark = await paper();
    await picture("graph-6-dark");
    await page.locator("#theme").click();
    return { dark, light: await paper() };
  });
  await step("editor", async () => {
    await open("robot", { inEditor: true });
    await item("node /slam").click();
    await page.locator("#details button.place", { hasText: "robot.launch:3" }).click();
    await item("topic /odom").click();
    return (await page.evaluate(() => window.sent)).map(({ type, file, line }) => [type, file, line]);
  });
  await step("live", async () => {
    const tell = (states) => page.evaluate((given) => window.postMessage({ type: "live", states: given }, "*"), states);
    const nodes = { "/base": "missing", "/laser": "dead", "/slam": "present", "/stranger": "extra" };
    const message = "/slam subscribes to /odom as std_msgs/String";
    const issues = [{ node: "/slam", what: "subscriber", name: "/odom", message, since: "12:04:17" }];
    await tell({ nodes, topics: { "/odom": "wrong-type", "/scan": "present" }, services: {}, actions: {}, issues });
    await page.locator("#live:not([hidden])").waitFor();
    const found = {
      missing: await labels(page.locator(".state-missing")),
      wrong: await labels(page.locator(".state-wrong")),
      said: await page.locator("#live").innerText(),
    };
    await item("node /base").hover();
    found.hint = await page.locator("#hint").innerText();
    found.marked = await page.locator(".route.differs").count();
    await page.locator("#differences").click();
    found.list = await page.locator("#details li").allInnerTexts();
    await page.locator("#details li button").click();
    found.jumped = await focused();
    await picture("graph-10-live");
    await tell({});
    await page.locator("#live").waitFor({ state: "hidden" });
    return { ...found, after: await page.locator(".state-missing, .state-wrong").count() };
  });
  await step("hostile", async () => {
    await open("hostile");
    await item("node ").first().hover();
    await page.locator("#hint").waitFor();
    for (const node of await page.locator("[data-node]").all()) {
      await node.click();
      await page.locator("#details").waitFor();
    }
    await picture("graph-7-hostile");
    return page.locator("script").count();
  });
  await step("large", async () => {
    await open("large");
    await picture("graph-8-large");
    const all = (await shown()).length;
    const inView = await page.evaluate(() => {
      const view = document.querySelector("#canvas").getBoundingClientRect();
      return [...document.querySelectorAll("[data-node]")].filter((node) => {
        const box = node.getBoundingClientRect();
        return box.left >= view.left && box.right <= view.right && box.top >= view.top && box.bottom <= view.bottom;
      }).length;
    });
    const window_ = () => page.locator("#window").evaluate((rect) => Number(rect.getAttribute("y")));
    const box = await page.locator("#map").boundingBox();
    const map = [await window_()];
    await page.mouse.click(box.x + box.width / 2, box.y + box.height - 3);
    await page.waitForFunction(() => document.querySelector("#canvas").scrollTop > 2000);
    map.push(await window_());
    await page.locator("#filter").fill("node:/subsystem_3/*");
    await page.locator("#only").check();
    const found = {
      all,
      inView,
      map,
      shown: (await shown()).length,
      status: await page.locator("#status").innerText(),
    };
    await page.locator("#fit").click();
    await picture("graph-9-large-filter");
    // Beside an editor there is less room.
    await page.setViewportSize({ width: 515, height: 800 });
    await open("large");
    const bottom = (selector) => page.locator(selector).evaluate((e) => e.getBoundingClientRect().bottom);
    const [canvas, footer] = [await bottom("#canvas"), await bottom("footer")];
    found.narrow = { canvas, footer, map: await page.locator("#map").isVisible() };
    await picture("graph-11-narrow");
    return found;
  });
  console.log(JSON.stringify(seen));
} catch (error) {
  console.error(`step "${current}" failed: ${error.stack}`);
  await picture("failed-page").catch(() => undefined);
  process.exitCode = 1;
} finally {
  await browser.close();
}
