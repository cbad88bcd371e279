import type { Location } from "vscode-languageserver-types";
import { clock, type Difference, type LiveState } from "./live";

/** A line of the tree of nodes, in the server's own words (`rosPreflight/tree`). */
export interface NodeItem {
  readonly kind:
    | "namespace"
    | "node"
    | "param"
    | "remap"
    | "section"
    | "include"
    | "not-taken"
    | "frame"
    | "difference";
  readonly label: string;
  readonly detail: string;
  /** The full name of a node or namespace. */
  readonly name: string;
  readonly location: Location | null;
  /** Which of the tree's files it comes from. */
  readonly file: number | null;
  readonly note: string;
  /** The worst of its findings, as LSP counts: 1 is an error, 2 a warning, 3 an information. */
  readonly severity: number | null;
  readonly findings: number;
  readonly children: readonly NodeItem[];
}

/** All of one launch. */
export interface NodeTree {
  readonly root: { readonly uri: string; readonly args: Readonly<Record<string, string>> };
  readonly files: readonly string[];
  readonly nodes: number;
  readonly items: readonly NodeItem[];
}

/** The colours of launch files, by names that every theme has. The root file has the first. */
const COLOURS = [
  "charts.blue",
  "charts.orange",
  "charts.green",
  "charts.purple",
  "charts.yellow",
  "charts.red",
] as const;

/** The colour of what comes from a file; there are more files than colours in a large launch. */
export function colourOf(file: number | null, live?: LiveState): string | undefined {
  if (live === "missing" || live === "dead") {
    return "list.errorForeground";
  }
  if (live === "wrong-type" || live === "differs") {
    return "list.warningForeground";
  }
  return file === null ? undefined : COLOURS[file % COLOURS.length];
}

/** What stands in a line of the tree: of an include the name of its file comes first, as paths are cut off at the end; of
 * several files each has the number that it has in the graph. */
export function written(item: NodeItem, files: number): { label: string; description: string } {
  const numbered = (item.kind === "node" || item.kind === "include") && item.file !== null && files > 1;
  const number = numbered && item.file !== null ? numberOf(item.file) : "";
  if (item.kind !== "include") {
    return { label: item.label, description: [number, item.detail].filter(Boolean).join(" ") };
  }
  const slash = item.label.lastIndexOf("/");
  const folder = item.label.slice(0, Math.max(0, slash));
  return {
    label: item.label.slice(slash + 1),
    description: [number, item.detail, folder && ` ${folder}`].filter(Boolean).join(" "),
  };
}

/** A circled number, counted from 1; there are twenty of them. */
function numberOf(file: number): string {
  return file < 20 ? String.fromCodePoint(0x2460 + file) : `(${file + 1})`;
}

const LIVE_ICONS: Readonly<Record<LiveState, string>> = {
  present: "pass-filled",
  missing: "error",
  dead: "debug-disconnect",
  extra: "add",
  "wrong-type": "warning",
  differs: "warning",
  inactive: "debug-pause",
  unsure: "question",
};

/** The nodes that run and that the launch file does not start, as lines below the others. */
export function extras(live: ReadonlyMap<string, LiveState>): NodeItem[] {
  const plain = { detail: "", location: null, file: null, note: "", severity: null, findings: 0, children: [] };
  const names = [...live].filter(([, state]) => state === "extra").map(([name]) => name);
  const children = names.sort().map((name): NodeItem => ({ ...plain, kind: "node", label: name, name }));
  const section = {
    ...plain,
    kind: "section",
    label: "Running, not launched",
    detail: String(names.length),
    name: "",
    children,
  } as const;
  return names.length > 0 ? [section] : [];
}

/** What is not as expected on the running robot, a line each: at the node, or all of it as a section. */
export function differenceItems(differences: readonly Difference[]): NodeItem[] {
  return differences.map(({ message, node, name, expected, actual, location, since, counts }) => ({
    kind: "difference",
    label: message,
    detail: `since ${clock(since)}`,
    name: `${node} ${name ?? ""}`.trim(),
    location: location ?? null,
    file: null,
    note: [expected ? `expected: ${expected}` : "", actual ? `seen: ${actual}` : ""].filter(Boolean).join("\n"),
    severity: counts ? 2 : 3,
    findings: 0,
    children: [],
  }));
}

/** The list of all differences, above the tree. */
export function differenceSection(differences: readonly Difference[]): NodeItem[] {
  const children = differenceItems(differences);
  const plain = { name: "", location: null, file: null, note: "", severity: null, findings: 0 };
  const label = "Differences on the running robot";
  return children.length > 0 ? [{ ...plain, kind: "section", label, detail: String(children.length), children }] : [];
}

/** The icon of a line, by its name in the product's icon font. */
export function iconOf(item: NodeItem, live: LiveState | undefined): string {
  switch (item.kind) {
    case "namespace":
      return "symbol-namespace";
    case "node":
      return live === undefined ? "circle-large-filled" : LIVE_ICONS[live];
    case "param":
      return "symbol-parameter";
    case "remap":
      return "arrow-swap";
    case "include":
      return "file-code";
    case "frame":
      return "type-hierarchy-sub";
    case "difference":
      return item.severity === 3 ? "info" : "warning";
    case "not-taken":
      return "circle-slash";
    case "section":
      return (
        { Includes: "files", "Not started": "debug-pause", Frames: "type-hierarchy" }[item.label] ?? "list-unordered"
      );
  }
}

/** What is decorated about a line, spelled as the query of a URI: that is how the editor asks for decorations. */
export function decorationOf(item: NodeItem): string | undefined {
  if (item.kind === "difference") {
    return undefined;
  }
  if (item.kind === "not-taken") {
    return "left-out";
  }
  const marks = marksOf(item);
  return marks.findings > 0
    ? `${marks.severity === 1 ? "error" : marks.severity === 2 ? "warning" : "info"}=${marks.findings}`
    : undefined;
}

/** What a screen reader says of a line: what it is, what is wrong with it, where it comes from, and what it does now. */
export function spoken(item: NodeItem, files: readonly string[], live: LiveState | undefined): string {
  const { severity, findings } = marksOf(item);
  const worst = severity === 1 ? "error" : severity === 2 ? "warning" : "information";
  const file = item.file === null ? undefined : files[item.file];
  return [
    item.kind === "not-taken"
      ? `not started: ${item.label}`
      : item.kind === "section"
        ? item.label
        : `${NAMES[item.kind]} ${item.label}`,
    item.detail,
    findings === 0 ? "" : findings === 1 ? `1 finding, ${worst}` : `${findings} findings, the worst: ${worst}`,
    live === undefined ? "" : `on the running robot: ${SPOKEN[live]}`,
    item.kind === "node" && file !== undefined ? `from ${file}` : "",
  ]
    .filter((words) => words !== "")
    .join(", ");
}

const NAMES: Readonly<Record<Exclude<NodeItem["kind"], "section" | "not-taken">, string>> = {
  namespace: "namespace",
  node: "node",
  param: "parameter",
  remap: "remap",
  include: "include",
  difference: "difference",
  frame: "frame",
};

const SPOKEN: Readonly<Record<LiveState, string>> = {
  present: "runs",
  missing: "not running",
  dead: "does not answer",
  extra: "not in the launch file",
  "wrong-type": "another type",
  differs: "runs with differences",
  inactive: "not active",
  unsure: "not running, which may be right",
};

/** The findings of a node, or of all nodes in a namespace: those are seen while it is folded. */
function marksOf(item: NodeItem): { severity: number; findings: number } {
  const own = { severity: item.severity ?? 4, findings: item.findings };
  return item.kind !== "namespace"
    ? own
    : item.children.map(marksOf).reduce(
        (all, one) => ({
          severity: one.findings > 0 ? Math.min(all.severity, one.severity) : all.severity,
          findings: all.findings + one.findings,
        }),
        own,
      );
}

/** Names for lines that stay the same when the tree is made anew, so that what is unfolded stays so. */
export function identified(items: readonly NodeItem[], parent = ""): { id: string; item: NodeItem }[] {
  const seen = new Map<string, number>();
  return items.map((item) => {
    const plain = `${parent}/${item.kind}:${item.name || item.label}`;
    const count = seen.get(plain) ?? 0;
    seen.set(plain, count + 1);
    return { id: count === 0 ? plain : `${plain}#${count}`, item };
  });
}
