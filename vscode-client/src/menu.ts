import { commands, type QuickPickItem, QuickPickItemKind, window, workspace } from "vscode";
import type { ServerStatus } from "./serverStatus";

interface Entry extends QuickPickItem {
  readonly command?: string;
}

const ENTRIES: readonly (readonly [title: string, entries: readonly Entry[]])[] = [
  [
    "Nodes",
    [
      {
        label: "$(play) Trace This Node",
        description: "run the node at the cursor again",
        command: "rosPreflight.traceNode",
      },
      {
        label: "$(run-all) Trace All Nodes",
        description: "run all nodes of the launch again",
        command: "rosPreflight.traceAll",
      },
      {
        label: "$(trash) Clear Cache",
        description: "delete the results of runs",
        command: "rosPreflight.clearCache",
      },
    ],
  ],
  [
    "Launch",
    [
      {
        label: "$(list-selection) Select Root and Arguments",
        description: "choose the launch that the file is analysed in",
        command: "rosPreflight.selectRoot",
      },
      {
        label: "$(list-tree) Show Node Tree",
        description: "list what the launch starts",
        command: "rosPreflight.showNodeTree",
      },
      {
        label: "$(eye) Watch Running System",
        description: "compare it with the launch file",
        command: "rosPreflight.watch",
      },
      {
        label: "$(type-hierarchy) Show Graph",
        description: "topics, services and actions between nodes",
        command: "rosPreflight.showGraph",
      },
    ],
  ],
  [
    "Server",
    [
      {
        label: "$(pulse) Doctor",
        description: "report ROS, the sandbox and what is missing",
        command: "rosPreflight.doctor",
      },
      {
        label: "$(mortar-board) Get Started",
        description: "the first five minutes",
        command: "rosPreflight.getStarted",
      },
      { label: "$(output) Show Log", command: "rosPreflight.showOutput" },
      { label: "$(debug-restart) Restart Server", command: "rosPreflight.restartServer" },
    ],
  ],
];

const TRUST: Entry = {
  label: "$(shield) Manage Workspace Trust",
  description: "nodes run only in a trusted workspace",
  command: "workbench.trust.manage",
};

const INSTALL = "rosPreflight.install";

/** Writes a command and does not enter it: whether it is done is the user's decision. */
export function writeIntoTerminal(command: string): void {
  const terminal = window.createTerminal("ROS Preflight");
  terminal.show();
  terminal.sendText(command, false);
}

/** The menu of the status bar. `missing` is what the server misses on this machine. */
export async function showMenu(missing: ServerStatus["missing"] | undefined): Promise<void> {
  const known = new Set(await commands.getCommands(true));
  const entries = ENTRIES.flatMap(([label, group]): Entry[] => [
    { label, kind: QuickPickItemKind.Separator },
    ...group.filter(({ command }) => known.has(command ?? "")),
  ]);
  if (missing !== undefined && missing.lines.length > 0) {
    entries.push({ label: "Missing on This Machine", kind: QuickPickItemKind.Separator });
    entries.push(...missing.lines.map((label) => ({ label: `$(info) ${label}`, command: "rosPreflight.doctor" })));
    entries.push(...missing.commands.map((detail) => ({ label: "$(terminal) Install", detail, command: INSTALL })));
  }
  const choice = await window.showQuickPick<Entry>(workspace.isTrusted ? entries : [TRUST, ...entries], {
    title: "ROS Preflight",
  });
  if (choice?.command === INSTALL && choice.detail !== undefined) {
    writeIntoTerminal(choice.detail);
  } else if (choice?.command !== undefined) {
    await commands.executeCommand(choice.command);
  }
}
