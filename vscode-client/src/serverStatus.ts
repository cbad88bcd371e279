/** What the server tells of itself with `rosPreflight/status`, in its own words. */
export interface ServerStatus {
  readonly state: "idle" | "indexing" | "tracing";
  readonly done: number;
  /** 0 while it is not known how much there is to do. */
  readonly total: number;
  /** What keeps nodes from being run. */
  readonly notRun: NotRun | null;
  /** The files, as URIs, with a syntax error that open files are launched with. */
  readonly broken: readonly string[];
  /** What this machine does not have of all that open files need: a line for each kind, and how to install it. */
  readonly missing: { readonly lines: readonly string[]; readonly commands: readonly string[] };
}

export interface NotRun {
  readonly kind: "off" | "untrusted" | "cancelled" | "sandbox";
  readonly message: string;
}

/** What this extension knows of the server's life. `reason` is a sentence for the user. */
export type Life =
  | { readonly state: "starting" | "running" | "stopped" }
  | { readonly state: "installing"; readonly reason: string }
  | { readonly state: "missing"; readonly reason: string };

/** What the status bar shows. */
export interface Shown {
  readonly text: string;
  readonly tooltip: string;
  readonly severity: "none" | "warning" | "error";
}

const NAME = "ROS Preflight";

/** The entry of the status bar that opens the menu. */
export function shown(life: Life, status: ServerStatus | undefined, last = ""): Shown {
  switch (life.state) {
    case "missing":
      return { text: `$(error) ${NAME}: no server`, tooltip: life.reason, severity: "error" };
    case "installing":
      return { text: `$(sync~spin) ${NAME}: installing`, tooltip: life.reason, severity: "none" };
    case "starting":
      return { text: `$(sync~spin) ${NAME}`, tooltip: "The server is starting.", severity: "none" };
    case "stopped":
      return { text: `$(debug-disconnect) ${NAME}: stopped`, tooltip: "The server is not running.", severity: "error" };
    case "running": // Of what it finds nothing is known before its first word.
      return status === undefined
        ? { text: `$(sync~spin) ${NAME}`, tooltip: "The server has started.", severity: "none" }
        : running(status, last);
  }
}

function running(status: ServerStatus, last: string): Shown {
  if (status.state !== "idle") {
    const share = status.total > 0 ? ` ${status.done} of ${status.total}` : "";
    const what =
      status.state === "tracing" ? "Running nodes in the sandbox." : "Indexing the launch files of the workspace.";
    return { text: `$(sync~spin) ${NAME}: ${status.state}${share}`, tooltip: what, severity: "none" };
  }
  const notRun = status.notRun;
  switch (notRun?.kind) {
    case "sandbox":
      return {
        text: `$(warning) ${NAME}: no sandbox`,
        tooltip: `Nodes are not run: ${notRun.message}`,
        severity: "warning",
      };
    case "off":
    case "cancelled":
      return { text: `$(circle-slash) ${NAME}`, tooltip: `Nodes are not run: ${notRun.message}`, severity: "none" };
    default: // A workspace that is not trusted has a badge of its own.
      return status.broken.length === 0
        ? { text: `$(check) ${NAME}`, tooltip: upToDate(status.missing.lines, last), severity: "none" }
        : broken(status.broken);
  }
}

/** What is missing on this machine is no fault of the launch files: the check mark stays. */
function upToDate(missing: readonly string[], last: string): string {
  const lines = missing.length > 0 ? ["Missing on this machine:", ...missing] : [];
  return ["Everything is up to date.", ...(last === "" ? [] : [`${last}.`]), ...lines].join("\n");
}

function broken(files: readonly string[]): Shown {
  const names = files.map((uri) => decodeURIComponent(uri.slice(uri.lastIndexOf("/") + 1)));
  const more = names.length > 1 ? ` and ${names.length - 1} more` : "";
  return {
    text: `$(warning) ${NAME}: syntax error in ${names[0]}${more}`,
    tooltip: `Syntax error in ${names.join(", ")}: nodes that it affects are not run.`,
    severity: "warning",
  };
}

/** Whether the badge is shown that leads to the editor of Workspace Trust. */
export function showsTrustBadge(life: Life, status: ServerStatus | undefined): boolean {
  return life.state === "running" && status?.notRun?.kind === "untrusted";
}
