// Drives one VS Code as a user would. Arguments: the scenario's name and the harness, as JSON.
// Prints what was seen as JSON; a step that fails is named on standard error, with a picture of the moment.
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { walkThroughGraph } from "./graph.mjs";
import { contents, until, Workbench } from "./workbench.mjs";

const [scenario, harnessText] = process.argv.slice(2);
const harness = JSON.parse(harnessText);
const seen = {};
const workbench = new Workbench(harness);
let current = "start";

async function step(name, action) {
  current = name;
  const started = performance.now();
  const result = await action();
  seen.seconds ??= {};
  seen.seconds[name] = Math.round(performance.now() - started) / 1000;
  return result;
}

/** What `seen` comes to, which may be there only while `action` is under way. */
async function during(seen, action) {
  const [result] = await Promise.all([seen, action()]);
  return result;
}

function picture(name) {
  return workbench.screenshot(path.join(harness.screenshots, `${name}.png`));
}

/** How long it may take to make a virtual environment and install into it. */
const INSTALLING = 240_000;

const squiggle = () => workbench.page.locator(".squiggly-warning").first();
const noSquiggle = () => squiggle().waitFor({ state: "detached" });

// The server of this editor, and no other: the process whose home is the harness's.
function processes() {
  const servers = readdirSync("/proc").filter((pid) => {
    try {
      const words = readFileSync(`/proc/${pid}/cmdline`, "utf8").split("\0");
      const environment = readFileSync(`/proc/${pid}/environ`, "utf8").split("\0");
      return words.includes("lsp") && environment.includes(`HOME=${harness.home}`);
    } catch {
      return false; // not a process, or one that has just ended
    }
  });
  return servers.map(Number);
}

function serverProcess() {
  const servers = processes();
  if (servers.length !== 1) {
    throw new Error(`one server was expected, not ${servers.length}`);
  }
  return servers[0];
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
    seen.hoverOnTopic = await step("hover on the topic", () => workbench.hover("chater", 'to="chater"', "/chatter"));
    await step("picture of the hover", async () => {
      await workbench.page.getByText("Checking for quick fixes").waitFor({ state: "hidden" });
      await picture("2-hover");
    });
    seen.hoverOnNode = await step("hover on the node", () =>
      workbench.hover("node", 'type="listener.py"', "std_msgs/String"),
    );
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
      await until("the fixed file on disk", () => contents(harness.launchFile).includes('to="chatter"'));
    });
    seen.fixed = contents(harness.launchFile);
    await step("picture after the fix", async () => {
      await workbench.parkMouse();
      await picture("5-after");
    });
  },

  // The tree of nodes, and from there into the files; go to include, rename across files, an annotation that is inserted.
  async tree() {
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    const page = workbench.page;
    await step("open the launch file", () => workbench.openFile("robot.launch"));
    await step("show the tree", () => workbench.command("ROS Preflight: Show Node Tree"));
    await step("node in the tree", () => workbench.treeLine("odometry").waitFor());
    await step("findings in the tree", async () => {
      seen.badges = await until("a mark on each monitor", async () => {
        const count = await workbench.badge("monitor").count();
        return count > 1 && count;
      });
    });
    await step("everything is up to date", () => workbench.idle());
    await step("lines of the tree", () =>
      until("the lines of the tree", async () => {
        seen.tree = await workbench.treeLines();
        return seen.tree.join("\n") === harness.tree.join("\n");
      }).catch((error) => {
        throw new Error(`${error.message}: ${seen.tree.join("\n")}`);
      }),
    );
    await step("picture of the tree", async () => {
      await workbench.parkMouse();
      await picture("11-tree");
    });
    await step("to a node that is left out", async () => {
      await workbench.treeLine("simulator").click();
      await workbench.status("Ln 17,").waitFor();
    });
    await step("to a node of an included file", async () => {
      await workbench.treeLine("monitor").first().click();
      await workbench.activeTab("arm.launch").waitFor();
      await workbench.status("Ln 6,").waitFor();
    });
    await step("menu of the status bar", async () => {
      await workbench.status("ROS Preflight").first().click();
      await page.locator(".quick-input-list .monaco-list-row", { hasText: "Doctor" }).waitFor();
      await picture("12-menu");
      await page.keyboard.press("Escape");
    });
    await step("go to the include", async () => {
      await workbench.openFile("robot.launch");
      await workbench.goTo("arm.launch", "arm.launch");
    });
    await step("rename", async () => {
      await workbench.rename('"rate"', "rate", "frequency");
      await page.locator(".view-line", { hasText: "frequency" }).first().waitFor();
      await workbench.command("File: Save All Files");
      const [robot, arm] = ["robot", "arm"].map((name) =>
        path.join(path.dirname(harness.launchFile), `${name}.launch`),
      );
      await until(
        "the renamed argument on disk",
        () => contents(robot).includes('name="frequency" value="20"') && contents(arm).includes('"frequency"'),
      );
    });
    await step("insert an annotation", async () => {
      await workbench.openFile("robot.launch");
      await workbench.putCursorOn("odometry");
      const entry = await workbench.quickFix("with its traced interface");
      await picture("13-annotate");
      await workbench.choose(entry);
      await workbench.line("<topics>").waitFor();
      await page.keyboard.press("Control+s");
      await until("the annotation on disk", () =>
        contents(path.join(path.dirname(harness.launchFile), "robot.launch")).includes('class="pub"'),
      );
    });
  },

  // A robot description starts the server: what is wrong in it as it is typed, and the hover of a link.
  async handedOver() {
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    await step("open the description", () => workbench.openFile("arm.urdf"));
    seen.hover = await step("hover on a link", () =>
      workbench.hover("base_link", 'parent link="base_link"', "Children"),
    );
    await step("edit", async () => {
      await workbench.parkMouse();
      await workbench.putCursorOn('child link="tool"');
      await workbench.page.keyboard.type("x");
    });
    await step("squiggle", () => workbench.page.locator(".squiggly-error").first().waitFor());
    await step("undo", async () => {
      await workbench.page.keyboard.press("Control+z");
      await workbench.page.locator(".squiggly-error").first().waitFor({ state: "detached" });
    });
  },

  // Each format of ROS 2 shows its finding.
  async formats() {
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    seen.problems = {};
    for (const name of ["first.launch.xml", "second.launch.yaml", "third.launch.py"]) {
      await step(`open ${name}`, () => workbench.openFile(name));
      await step(`squiggle in ${name}`, () => workbench.page.locator(".squiggly-error").first().waitFor());
      seen.problems[name] = await step(`problem of ${name}`, async () => {
        const all = await workbench.problems("sped");
        return all.filter((row) => row.includes("sped"));
      });
      await step(`picture of ${name}`, () => picture(`14-${name.split(".")[0]}`));
      await step(`close ${name}`, () => workbench.command("View: Close All Editors"));
    }
  },

  // The first minutes: the welcome view, a launch file from it, the walkthrough, the doctor's buttons, the log.
  async start() {
    workbench.settings = { "files.defaultLanguage": "roslaunch" };
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    const welcome = workbench.page.locator(".welcome-view-content");
    await step("show the view", () => workbench.command("ROS Preflight: Show Node Tree"));
    await step("the welcome view", () => welcome.first().waitFor());
    seen.welcome = await welcome.allInnerTexts();
    await step("picture of the welcome view", () => picture("23-welcome"));
    await step("a launch file from it", async () => {
      await welcome.getByRole("button", { name: "Open Launch File" }).click();
      const row = workbench.page.locator(".quick-input-list .monaco-list-row", { hasText: "talker_listener.launch" });
      await row.click();
      await workbench.activeTab("talker_listener.launch").waitFor();
    });
    await step("a node in the tree", () => workbench.treeLine("talker").first().waitFor());
    await step("a finding in the tree", () => workbench.badge("listener").first().waitFor());
    seen.spoken = await workbench.treeLine("listener").first().getAttribute("aria-label");
    await step("the walkthrough", async () => {
      await workbench.command("ROS Preflight: Get Started");
      await workbench.page.locator(".getting-started-step", { hasText: "Open a launch file" }).waitFor();
      seen.steps = await workbench.page.locator(".getting-started-step .step-title").allInnerTexts();
      await picture("24-walkthrough");
    });
    await step("the doctor's buttons", async () => {
      await workbench.command("ROS Preflight: Doctor");
      await workbench.activeTab("Doctor").waitFor();
      await workbench.page.locator(".codelens-decoration a", { hasText: "Restart server" }).waitFor();
      seen.buttons = await workbench.page.locator(".codelens-decoration a").allInnerTexts();
      await picture("25-doctor-buttons");
    });
    await step("a file that is not saved", async () => {
      await workbench.command("New Untitled Text File");
      await workbench.page.keyboard.type("<launch>");
      const status = workbench.page
        .locator(".statusbar-item", { hasText: "{}" })
        .or(workbench.page.locator("#status\\.languageStatus"));
      await status.first().waitFor();
      await status.first().click();
      await workbench.page.locator(".hover-language-status", { hasText: "not checked" }).first().waitFor();
      seen.unsaved = await workbench.page.locator(".hover-language-status").allInnerTexts();
      await picture("26-unsaved");
    });
  },

  // The nodes of the tree are those of the running robot, and one of them dies.
  async watch() {
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    await step("open the launch file", () => workbench.openFile("talker_listener.launch"));
    await step("squiggle", () => squiggle().waitFor());
    await step("watch", () => workbench.command("ROS Preflight: Watch Running System"));
    const message = workbench.page.locator(".tree-explorer-viewlet-tree-view > .message");
    const healthy = message.filter({ hasText: "as it should be" });
    seen.healthy = await step("the system is as it should be", () => healthy.innerText());
    process.kill(harness.victim, "SIGKILL");
    const broken = message.filter({ hasText: "difference" }).filter({ hasText: "/listener" });
    seen.broken = await step("a node is missed", () => broken.innerText());
    const marked = ".codicon-error, .codicon-debug-disconnect";
    await step("its line", () =>
      workbench
        .treeLine("listener")
        .filter({ has: workbench.page.locator(marked) })
        .waitFor(),
    );
    seen.listed = await step("the list of differences", async () => {
      await workbench.treeLine("Differences on the running robot").waitFor();
      const node = workbench.treeLine("preflight_demo/listener.py");
      await node.locator(".monaco-tl-twistie").click();
      return until("the difference at the node", async () => {
        const lines = (await workbench.treeLines()).filter((line) => line.includes("since "));
        return lines.length > 1 && lines;
      });
    });
    await step("picture of the running system", async () => {
      await workbench.parkMouse();
      await picture("16-watch");
    });
    await step("stop", () => workbench.command("ROS Preflight: Stop Watching Running System"));
    await step("nothing is watched", () => broken.waitFor({ state: "hidden" }));
  },

  // A set-up that is not there is told; one that is there is what the server runs in.
  async setups() {
    workbench.settings = { "rosPreflight.environment.setup": ["/no/such/setup.bash"] };
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    // Messages leave again by themselves: each is waited for from before what brings it about.
    seen.missing = await step("open the launch file, message about the set-up", () =>
      during(workbench.message("/no/such/setup.bash").innerText(), () => workbench.openFile("talker_listener.launch")),
    );
    await step("squiggle without it", () => squiggle().waitFor());
    const before = serverProcess();
    workbench.configure({ "rosPreflight.environment.setup": [harness.setup] });
    await step("another server", () =>
      until("another server", () => processes().length === 1 && processes()[0] !== before),
    );
    await step("the doctor's page", async () => {
      await workbench.idle();
      await workbench.command("ROS Preflight: Doctor");
      await workbench.activeTab("Doctor").waitFor();
      await workbench.line("/opt/of/the/overlay").first().waitFor();
    });
    seen.doctor = (await workbench.page.locator(".view-line").allTextContents()).join("\n").replaceAll("\u00a0", " ");
    await step("picture of the doctor's page", () => picture("17-doctor"));
  },

  // The extension installs the server that it brings along, and uses it the next time.
  async installs() {
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    await step("open the launch file, status of the installation", () =>
      during(workbench.status("installing").waitFor(), () => workbench.openFile("talker_listener.launch")),
    );
    await step("picture of the installation", () => picture("15-installing"));
    await step("squiggle of the installed server", () => squiggle().waitFor({ timeout: INSTALLING }));
    const first = serverProcess();
    await step("Restart Server", () => workbench.command("ROS Preflight: Restart Server"));
    await step("another server", () =>
      until("another server", () => processes().length === 1 && processes()[0] !== first),
    );
    await step("squiggle of the restarted server", () => squiggle().waitFor());
    seen.command = readFileSync(`/proc/${serverProcess()}/cmdline`, "utf8").split("\0").filter(Boolean);
  },

  // The graph view: lines to go to, live, saved, restored.
  async graph() {
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    await step("open the launch file", () => workbench.openFile("talker_listener.launch"));
    await step("squiggle", () => squiggle().waitFor());
    await walkThroughGraph({ workbench, harness, step, picture, seen });
  },

  // Nothing is run and the reason is shown; once trust is granted, nodes are run without a restart.
  async untrusted() {
    await step("open the workspace", () => workbench.open());
    await step("open the launch file", () => workbench.openFile("talker_listener.launch"));
    seen.problems = await step("reason shown", () => workbench.problems("not trusted"));
    await step("picture of the reason", () => picture("6-untrusted"));
    await step("squiggle of what the source tells", () => squiggle().waitFor());
    seen.sandboxStarts = contents(harness.sandboxRecord).length;
    const before = serverProcess();
    await step("trust the workspace", trust);
    await step("badge gone", () => workbench.status("Not trusted").waitFor({ state: "detached" }));
    await step("nodes run", () => until("a node that is run", () => contents(harness.sandboxRecord).length > 0));
    await step("picture after trust", () => picture("7-trusted"));
    seen.sameServer = serverProcess() === before;
  },

  // A server that is not there is asked for; one that dies is started again, but not for ever.
  async restarts() {
    await step("open the workspace", () => workbench.open(["--disable-workspace-trust"]));
    await step("open the launch file", () => workbench.openFile("talker_listener.launch"));
    const missing = workbench.message("installing the server with pip failed");
    seen.missing = await step("message about the missing server", () => missing.innerText({ timeout: INSTALLING }));
    await step("status of the missing server", () => workbench.status("no server").waitFor());
    seen.buttons = await step("its buttons", () => missing.locator(".monaco-button").allInnerTexts());
    await step("picture of the message", () => picture("8-no-server"));
    workbench.configure({ "rosPreflight.server.command": [harness.server] });
    await step("squiggle of the configured server", () => squiggle().waitFor());
    for (let death = 1; death <= 5; death += 1) {
      const told = death === 1 ? workbench.message("stopped unexpectedly").waitFor() : Promise.resolve();
      await step(`death ${death}`, () => during(told, killServer));
      await step(`restart ${death}`, () => squiggle().waitFor());
      if (death === 1) {
        await step("picture of the restarted server", () => picture("9-came-back"));
      }
    }
    seen.told = await step("how often it was told", () => workbench.toldSoFar("stopped unexpectedly"));
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
    await workbench.page
      .screenshot({ path: path.join(harness.screenshots, `failed-${scenario}.png`) })
      .catch(() => undefined);
  }
  process.exitCode = 1;
} finally {
  await workbench.close();
}
