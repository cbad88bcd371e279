/** What the doctor's page advises in one line: a title for a button, and what that does. */
export interface Advice {
  readonly line: number;
  readonly title: string;
  readonly command: string;
  readonly arguments: readonly unknown[];
}

const TERMINAL = "rosPreflight.writeIntoTerminal";

/** How to install the program that the sandbox is made with, on systems with apt. */
const SANDBOX = "sudo apt install bubblewrap";

/** The buttons of the page, by the lines that they stand above. */
export function advice(text: string, isTrusted: boolean): Advice[] {
  return text.split("\n").flatMap((row, line): Advice[] => {
    const [, what = "", value = ""] = /^(\S.*?)\s{2,}(.*)$/.exec(row) ?? [];
    const write = (command: string) => ({
      line,
      title: "Write into a terminal",
      command: TERMINAL,
      arguments: [command],
    });
    if (what === "install with" && value !== "") {
      return [write(value)];
    }
    if (what === "sandbox" && value.startsWith("does not work")) {
      return /bwrap|bubblewrap/.test(value) ? [{ ...write(SANDBOX), title: `Write '${SANDBOX}' into a terminal` }] : [];
    }
    if (what === "set-ups") {
      const open = { line, title: "Open settings", command: "workbench.action.openSettings" };
      return isTrusted
        ? [{ ...open, arguments: ["rosPreflight.environment.setup"] }]
        : [{ line, title: "Manage Workspace Trust", command: "workbench.trust.manage", arguments: [] }];
    }
    if (what === "distribution" && /none found$/.test(value)) {
      return [
        {
          line,
          title: "Name a set-up",
          command: "workbench.action.openSettings",
          arguments: ["rosPreflight.environment.setup"],
        },
      ];
    }
    if (what === "server") {
      return [{ line, title: "Restart server", command: "rosPreflight.restartServer", arguments: [] }];
    }
    if (what === "traces") {
      return [{ line, title: "Clear cache", command: "rosPreflight.clearCache", arguments: [] }];
    }
    return [];
  });
}
