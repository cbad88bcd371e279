// Drives one VS Code as a user would. Arguments: the scenario's name and the desk, as JSON.
// Prints what was seen as JSON; a step that fails is named on standard error, with a picture of the moment.
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { contents, until, Workbench } from "./workbench.mjs";

const [scenario, deskText] = process.argv.slice(2);
const desk = JSON.parse(deskText);
const seen = {};
const workbench = new Workbench(desk);
let current = "start";

async function step(name, action) {
  current = name;
  const started = performance.now();
  const result = await action();
  (seen.seconds ??= {})[name] = Math.round(performance.now() - started) / 1000;
  return result;
}

function picture(name) {
  return workbench.screenshot(path.join(desk.screenshots, `${name}.png`));
}

const squiggle = () => workbench.page.locator(".squiggly-warning").first();
const noSquiggle = () => squiggle().waitFor({ state: "detached" });

// The server of this editor, and no other: the process whose home is the desk's.
function serverProcess() {
  const servers = readdirSync("/proc").filter((pid) => {
    try {
      const words = readFileSync(`/proc/${pid}/cmdline`, "utf8").split("\0");
      const environment = readFileSync(`/proc/${pid}/environ`, "utf8").split("\0");
      return words.includes("lsp") && environment.includes(`HOME=${desk.home}`);
    } catch {
      return false; // not a process, or one that has just ended
    }
  });
  if (servers.length !== 1) {
    throw new Error(`one server was expected, not ${servers.length}`);
  }
  return Number(servers[0]);
}

async function killServer() {
  process.kill(serverProcess(), "SIGKILL");
  await noSquiggle();
}

// By the badge in the status bar.
async function trust() {
  await workbench.status("Not trusted").click();
  const editor = workbench.page.locator(".workspace-trust-editor");
  await editor.getByRole("button", { name: "Trust", exact: true }).click();
  await workbench.page.locator(".workspace-trust-editor", { hasText: "You trust this folder" }).waitFor();
  await workbench.command("View: Close Editor");
}

const scenarios = {
  // Squiggle, hover, quick fix.
  async fix() {
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    await step("open the launch file", () => workbench.openFile("talker_listener.launch"));
    await step("squiggle", () => squiggle().waitFor());
    await step("picture of the squiggle", async () => {
      await workbench.parkMouse();
      await picture("1-squiggle");
    });
    seen.hoverOnTopic = await step("hover on the topic", () => workbench.hover("chater", 'to="chater"'));
    await step("picture of the hover", () => picture("2-hover"));
    seen.hoverOnNode = await step("hover on the node", () => workbench.hover("node", 'type="listener.py"'));
    await step("picture of the node's hover", () => picture("3-hover-node"));
    await step("quick-fix menu", async () => {
      await workbench.parkMouse();
      await workbench.putCursorOn("chater");
      const entry = await workbench.quickFix("chatter");
      seen.quickFix = await entry.innerText();
      await picture("4-quick-fix");
      await workbench.choose(entry);
    });
    await step("diagnostic gone", noSquiggle);
    await step("file saved", async () => {
      await workbench.page.keyboard.press("Control+s");
      await until("the fixed file on disk", () => contents(desk.launchFile).includes('to="chatter"'));
    });
    seen.fixed = contents(desk.launchFile);
    await step("picture after the fix", async () => {
      await workbench.parkMouse();
      await picture("5-after");
    });
  },

  // Nothing is run and the reason is shown; once trust is granted, the finding comes without a restart.
  async untrusted() {
    await step("open the workspace", () => workbench.open());
    await step("open the launch file", () => workbench.openFile("talker_listener.launch"));
    seen.problems = await step("reason shown", () => workbench.problems("not trusted"));
    await step("picture of the reason", () => picture("6-untrusted"));
    seen.squiggles = await squiggle().count();
    seen.sandboxStarts = contents(desk.sandboxRecord).length;
    const before = serverProcess();
    await step("trust the workspace", trust);
    await step("badge gone", () => workbench.status("Not trusted").waitFor({ state: "detached" }));
    await step("squiggle", () => squiggle().waitFor());
    await step("picture after trust", () => picture("7-trusted"));
    seen.sameServer = serverProcess() === before;
  },

  // A server that is not there is asked for; one that dies is started again, but not for ever.
  async restarts() {
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    await step("open the launch file", () => workbench.openFile("talker_listener.launch"));
    const missing = workbench.message("installing the server with pip failed");
    seen.missing = await step("message about the missing server", () => missing.innerText());
    await step("status of the missing server", () => workbench.status("no server").waitFor());
    seen.buttons = await step("its buttons", () => missing.locator(".monaco-button").allInnerTexts());
    await step("picture of the message", () => picture("8-no-server"));
    workbench.configure({ "rosPreflight.server.command": [desk.server] });
    await step("squiggle of the configured server", () => squiggle().waitFor());
    for (let death = 1; death <= 5; death += 1) {
      await step(`death ${death}`, killServer);
      await step(`restart ${death}`, () => squiggle().waitFor());
      if (death === 1) {
        await step("told that it came back", () => workbench.message("is started again").waitFor());
        await step("picture of the restarted server", () => picture("9-came-back"));
      }
    }
    seen.told = await step("how often it was told", () => workbench.toldSoFar("is started again"));
    await step("death 6", killServer);
    const gaveUp = workbench.message("the server stopped 6 times within 3 minutes");
    await step("message that it is left stopped", () => gaveUp.waitFor());
    await step("picture of that message", () => picture("10-left-stopped"));
    await step("Restart Server", () => gaveUp.getByRole("button", { name: "Restart Server" }).click());
    await step("squiggle of the restarted server", () => squiggle().waitFor());
  },
};

try {
  await scenarios[scenario]();
  console.log(JSON.stringify(seen));
} catch (error) {
  console.error(`step "${current}" failed: ${error.stack}`);
  if (workbench.page) {
    const messages = await workbench.page.locator(".notification-list-item-message").allInnerTexts();
    console.error(`messages shown: ${JSON.stringify(messages)}`);
    await workbench.page.screenshot({ path: path.join(desk.screenshots, `failed-${scenario}.png`) }).catch(() => undefined);
  }
  process.exitCode = 1;
} finally {
  await workbench.close();
}
