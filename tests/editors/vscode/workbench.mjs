// VS Code's workbench as served by code-server, in Chromium: started, looked at, operated, ended.
import { spawn } from "node:child_process";
import { createWriteStream, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const ENTRY = fileURLToPath(import.meta.resolve("code-server/out/node/entry.js"));
export const CHROMIUM_FLAGS = [
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--no-sandbox",
];
const USER_SETTINGS = {
  "editor.minimap.enabled": false,
  "extensions.ignoreRecommendations": true,
  "security.workspace.trust.startupPrompt": "never",
  "telemetry.telemetryLevel": "off",
  "update.mode": "none",
  "window.commandCenter": false,
  "workbench.editor.empty.hint": "hidden",
  "workbench.startupEditor": "none",
  "workbench.tips.enabled": false,
};

/** How long anything that is waited for may take. */
export const PATIENCE = 60_000;

/** One code-server and one browser page on it. */
export class Workbench {
  #ends = [];
  /** Those that the workbench starts with, of the machine. */
  settings = {};

  /**
   * @param {{home: string, vsix: string, workspace: string, log: string, chromium: string}} harness
   */
  constructor(harness) {
    this.harness = harness;
  }

  /**
   * Installs the extension, starts code-server on the workspace and opens it in the browser.
   *
   * @param {string[]} options more arguments for code-server
   */
  async open(options = []) {
    const { home, vsix, workspace, log } = this.harness;
    const folders = ["--user-data-dir", path.join(home, "data"), "--extensions-dir", path.join(home, "extensions")];
    this.configure(USER_SETTINGS, "User");
    this.configure(this.settings);

    const output = createWriteStream(log);
    this.#ends.push(() => output.end());
    const installing = this.#codeServer([...folders, "--install-extension", vsix], output);
    const installed = await ended(installing);
    if (installed !== 0) {
      throw new Error(`code-server did not install ${vsix} (exit code ${installed}); see ${log}`);
    }

    const port = await freePort();
    const serverArguments = ["--bind-addr", `127.0.0.1:${port}`, "--auth", "none", "--disable-telemetry"];
    serverArguments.push("--disable-update-check", "--disable-getting-started-override", ...options, workspace);
    const serving = this.#codeServer([...folders, ...serverArguments], output);
    this.#ends.push(async () => {
      serving.kill("SIGTERM");
      await ended(serving);
    });
    const url = `http://127.0.0.1:${port}/`;
    await until("code-server to answer", async () => {
      if (serving.exitCode !== null) {
        throw new Error(`code-server ended with exit code ${serving.exitCode}; see ${log}`);
      }
      return (await fetch(`${url}healthz`).catch(() => undefined))?.ok;
    });

    const browser = await chromium.launch({ executablePath: this.harness.chromium, args: CHROMIUM_FLAGS });
    this.#ends.push(() => browser.close());
    this.page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    this.page.setDefaultTimeout(PATIENCE);
    await this.page.goto(`${url}?folder=${encodeURIComponent(workspace)}`);
    await this.page.locator(".monaco-workbench").waitFor();
  }

  /** Ends the browser and code-server, whatever happened before. */
  async close() {
    for (const end of this.#ends.reverse()) {
      await end();
    }
  }

  /** Runs a command of the command palette by its title. */
  async command(title) {
    await this.#pick("F1", `>${title}`, title);
  }

  /** Opens a file of the workspace by its name. */
  async openFile(name) {
    await this.#pick("Control+p", name, name);
    await this.page.locator(".editor-instance .view-lines").first().waitFor();
  }

  // Commands are contributed one by one while the workbench starts, so the list may have to be asked again.
  async #pick(chord, text, label) {
    const box = this.page.locator(".quick-input-widget input");
    const row = this.page.locator(".quick-input-list .monaco-list-row", { hasText: label }).first();
    await until(`'${label}' in the list of ${chord}`, async () => {
      await this.page.keyboard.press(chord);
      // What was clicked just before may take the focus only now, which closes the list again.
      if ((await appears(box)) && (await happens(box.fill(text, { timeout: 3000 }))) && (await appears(row))) {
        return happens(row.click({ timeout: 3000 }));
      }
      await this.page.keyboard.press("Escape");
      return false;
    });
    await box.waitFor({ state: "hidden" });
  }

  /** The drawn line of the editor that holds a text. */
  line(text) {
    return this.page.locator(".editor-instance .view-line", { hasText: withDrawnSpaces(text) });
  }

  /**
   * Puts the mouse on the middle of a text and returns what the hover says, with the hover still there.
   *
   * @param {string} text
   * @param {string} line what the text's line holds
   * @param {string} wanted what the hover is to say: its parts come one after another
   */
  async hover(text, line, wanted) {
    const contents = ".monaco-hover:not(.hidden) .hover-contents";
    await until(`a hover on ${text}`, async () => {
      await this.parkMouse();
      await this.#moveTo(await this.#boxOf(text, line));
      return appears(this.page.locator(contents, { hasText: wanted }).first(), 4000);
    });
    return (await this.page.locator(contents, { hasText: /\S/ }).allInnerTexts()).join("\n");
  }

  /** Clicks into the middle of a text. */
  async putCursorOn(text) {
    const box = await this.#boxOf(text, text);
    await this.page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  }

  async parkMouse() {
    await this.page.mouse.move(640, 795);
    await this.page.locator(".monaco-editor .monaco-hover:not(.hidden)").first().waitFor({ state: "hidden" });
  }

  #moveTo(box) {
    return this.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 4 });
  }

  // Where a text is drawn. The tokens of a line are elements of their own, and a text may start inside one.
  async #boxOf(text, line) {
    await this.line(line).first().waitFor();
    return this.line(line)
      .first()
      .evaluate((element, wanted) => {
        const start = element.textContent.indexOf(wanted);
        const range = document.createRange();
        const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
        let before = 0;
        for (let node = walker.nextNode(); node; node = walker.nextNode()) {
          const [from, to] = [start - before, start + wanted.length - before];
          if (from >= 0 && from < node.length) {
            range.setStart(node, from);
          }
          if (to > 0 && to <= node.length) {
            range.setEnd(node, to);
            return range.getBoundingClientRect().toJSON();
          }
          before += node.length;
        }
        throw new Error(`${wanted} is not drawn`);
      }, withDrawnSpaces(text));
  }

  /** A message box that holds a text. */
  message(text) {
    return this.page.locator(".notification-toast", { hasText: text });
  }

  /** How many messages that hold a text were shown so far and not closed. */
  async toldSoFar(text) {
    await this.command("Notifications: Show Notifications");
    const center = this.page.locator(".notifications-center.visible");
    await center.waitFor();
    const count = await center.locator(".notification-list-item", { hasText: text }).count();
    await this.command("Notifications: Hide Notifications");
    await center.waitFor({ state: "hidden" });
    return count;
  }

  /** An entry of the status bar that holds a text. */
  status(text) {
    return this.page.locator(".statusbar-item", { hasText: text });
  }

  /** A line of the tree of nodes that holds a text. */
  treeLine(text) {
    return this.page.locator(".customview-tree .monaco-list-row", { hasText: text });
  }

  /** What all lines of the tree say, by how deep they are. */
  async treeLines() {
    const rows = await this.page.locator(".customview-tree .monaco-list-row").all();
    return Promise.all(
      rows.map(async (row) => {
        const level = Number(await row.getAttribute("aria-level"));
        const words = await row.locator(".label-name, .label-description").allTextContents();
        return "  ".repeat(level - 1) + words.join(" ").replaceAll("\u00a0", " ");
      }),
    );
  }

  /** The lines of the tree that hold a text and are marked with findings. */
  badge(text) {
    const mark = this.page.locator("[class*='monaco-decoration-itemBadge']");
    return this.treeLine(text).filter({ has: mark });
  }

  /** Waits until the server has nothing left to do. */
  idle() {
    return this.page.locator(".statusbar-item:has(.codicon-check)", { hasText: "ROS Preflight" }).waitFor();
  }

  /** The tab of the editor that is in front. */
  activeTab(name) {
    return this.page.locator(".tab.active", { hasText: name });
  }

  /** Goes from a text to the definition of what it names, which is in another file. */
  async goTo(text, file) {
    await until(`the definition of ${text}`, async () => {
      await this.putCursorOn(text);
      await this.page.keyboard.press("F12");
      return appears(this.activeTab(file));
    });
  }

  /** Renames what stands in a text. */
  async rename(text, old, name) {
    const box = this.page.locator(".rename-box input");
    await until(`the box to rename ${text}`, async () => {
      await this.putCursorOn(text);
      await this.page.keyboard.press("F2");
      return appears(box);
    });
    await until(`'${old}' to be renamed`, async () => (await box.inputValue()) === old);
    await box.fill(name);
    await this.page.keyboard.press("Enter");
    await box.waitFor({ state: "hidden" });
  }

  /** Changes settings as an edit of settings.json would. Those of the scopes `machine*` count in `Machine` alone. */
  configure(settings, scope = "Machine") {
    const file = path.join(this.harness.home, "data", scope, "settings.json");
    mkdirSync(path.dirname(file), { recursive: true });
    writeFileSync(file, JSON.stringify(settings));
  }

  /** Opens the Problems panel and returns its rows' texts, waiting for one that holds `text`. */
  async problems(text) {
    await this.command("Problems: Focus on Problems View");
    await this.page.locator(".markers-panel .monaco-list-row", { hasText: text }).first().waitFor();
    return this.page.locator(".markers-panel .monaco-list-row").allInnerTexts();
  }

  /** Opens the quick-fix menu at the cursor and returns its entry that holds `text`. */
  async quickFix(text) {
    const entry = this.page.locator(".action-widget .monaco-list-row.action", { hasText: text }).first();
    await until(`a quick fix that names ${text}`, async () => {
      await this.page.keyboard.press("Control+.");
      if (await appears(entry)) {
        return true;
      }
      await this.page.keyboard.press("Escape");
      return false;
    });
    return entry;
  }

  /** Clicks an entry of the quick-fix menu. The menu takes clicks only after the mouse has moved over it. */
  async choose(entry) {
    await this.#moveTo(await entry.boundingBox());
    await entry.click();
  }

  /** Saves a picture of the page once nothing on it is fading. */
  async screenshot(file) {
    mkdirSync(path.dirname(file), { recursive: true });
    await this.page.waitForFunction(() =>
      [...document.querySelectorAll(".monaco-hover:not(.hidden), .action-widget")].every(
        (element) => getComputedStyle(element).opacity === "1",
      ),
    );
    await this.page.screenshot({ path: file, animations: "disabled" });
  }

  #codeServer(serverArguments, output) {
    const process_ = spawn(process.execPath, [ENTRY, ...serverArguments], {
      env: { ...process.env, EXTENSIONS_GALLERY: "{}" },
      stdio: ["ignore", "pipe", "pipe"],
    });
    process_.stdout.pipe(output, { end: false });
    process_.stderr.pipe(output, { end: false });
    return process_;
  }
}

/** Waits for a condition to hold; asked again and again, as it may have to act. */
export async function until(what, condition) {
  const end = Date.now() + PATIENCE;
  for (;;) {
    const value = await condition();
    if (value) {
      return value;
    }
    if (Date.now() > end) {
      throw new Error(`gave up waiting for ${what}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

function appears(locator, timeout = 3000) {
  return happens(locator.waitFor({ timeout }));
}

function happens(action) {
  return action.then(
    () => true,
    () => false,
  );
}

/** What a file holds now. */
export function contents(file) {
  return readFileSync(file, "utf8");
}

function withDrawnSpaces(text) {
  return text.replaceAll(" ", "\u00a0");
}

function ended(child) {
  return child.exitCode !== null || child.signalCode !== null
    ? Promise.resolve(child.exitCode)
    : new Promise((resolve) => child.once("exit", resolve));
}

function freePort() {
  return new Promise((resolve, reject) => {
    const probe = createServer().once("error", reject);
    probe.listen(0, "127.0.0.1", () => {
      const { port } = probe.address();
      probe.close(() => resolve(port));
    });
  });
}
