// The graph view in VS Code, as a user walks through it.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { contents, until } from "./workbench.mjs";

/** @param the means of drive.mjs: the workbench, its harness, what names a step and takes pictures, what is told. */
export async function walkThroughGraph({ workbench, harness, step, picture, seen }) {
  const graph = () => workbench.page.frameLocator("iframe.webview.ready").frameLocator("iframe#active-frame");
  const item = (label) => graph().locator(`[aria-label^="${label}"]`).first();
  const labels = () =>
    graph()
      .locator("[data-node], [data-channel]")
      .evaluateAll((all) => all.map((each) => each.getAttribute("aria-label")).sort());
  const cursor = (text) => workbench.page.locator(".statusbar-item", { hasText: text }).first().waitFor();

  await step("shown", async () => {
    await workbench.command("Show Graph");
    await item("topic /chater, warning").waitFor();
    seen.shown = await labels();
  });
  await picture("20-graph");
  await step("hover", async () => {
    await item("topic /chater").hover();
    await graph().locator("#hint", { hasText: "std_msgs/String" }).waitFor();
    await picture("21-graph-hover");
    seen.hover = await graph().locator("#hint").innerText();
  });
  await step("click on a node", async () => {
    await item("node /listener").click();
    await cursor(/Ln 6, Col 3/);
    await picture("22-graph-click");
  });
  await step("click on a topic", async () => {
    // To the line of the source that publishes it.
    await item("topic /chatter").click();
    await workbench.page.locator(".tab.active", { hasText: "talker.py" }).waitFor();
    await workbench.openFile("talker_listener.launch");
  });
  await step("Enter on a node", async () => {
    await item("node /talker").focus();
    await item("node /talker").press("Enter");
    await cursor(/Ln 3, Col 3/);
  });
  await step("why", async () => {
    await item("topic /chatter").click();
    await graph().locator("#details button", { hasText: "Explain" }).first().click();
    const rows = workbench.page.locator(".quick-input-list .monaco-list-row");
    await rows.filter({ hasText: "Why is /talker started?" }).waitFor();
    await rows.filter({ hasText: "/listener" }).first().click();
    await rows.filter({ hasText: "are different topic names" }).last().waitFor();
    await picture("22-graph-why");
    seen.why = await rows.allInnerTexts();
    await rows.filter({ hasText: "are different topic names" }).last().click();
    await cursor(/Ln 7, Col/);
    await workbench.openFile("talker_listener.launch");
  });
  await step("followed", async () => {
    writeFileSync(harness.launchFile, contents(harness.launchFile).replace('to="chater"', 'to="chatter"'));
    await item("topic /chater").waitFor({ state: "detached" });
    seen.followed = await labels();
  });
  await step("saved", async () => {
    await graph().locator("#save").click();
    // The box proposes a name, once it has looked at the folder.
    const box = workbench.page.locator(".quick-input-widget input[type=text]");
    const target = path.join(harness.workspace, "graph.svg");
    await until("the name to be taken", async () => {
      if (/graph\.svg$/.test(await box.inputValue())) {
        await box.press("Enter");
        // Not pressed again while it closes: that would be typed into the launch file.
        return box.waitFor({ state: "hidden", timeout: 10_000 }).then(
          () => true,
          () => false,
        );
      }
      return false;
    });
    await until(
      "the picture on the disk",
      () => existsSync(target) && readFileSync(target, "utf8").endsWith("</svg>\n"),
    );
    seen.saved = readFileSync(target, "utf8");
  });
  await step("restored", async () => {
    await graph().locator("#filter").fill("listener");
    await item("node /listener").click();
    await cursor(/Ln 6, Col 3/);
    // Another tab in its place ends the page; it comes back as it was, for the file that is looked at by then.
    const tab = workbench.page.locator(".tab", { hasText: "Graph:" });
    await tab.click();
    await workbench.openFile("fixed.launch");
    await workbench.page.locator("iframe.webview.ready").waitFor({ state: "hidden" });
    await tab.click();
    await item("node /listener").waitFor();
    await tab.filter({ hasText: "fixed.launch" }).waitFor();
    await picture("23-graph-restored");
    seen.restored = await until("the filter as it was", () => graph().locator("#filter").inputValue());
  });
}
