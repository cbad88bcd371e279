/** A place in a file, line and column counted from 1, the column in code points. */
export interface Place {
  readonly file: string;
  readonly line: number;
  readonly column: number;
}

/** What the page of the graph sends. */
export type PageMessage =
  | { readonly type: "ready"; readonly builtin: boolean }
  | { readonly type: "builtin"; readonly shown: boolean }
  | { readonly type: "save"; readonly svg: string }
  | {
      readonly type: "why";
      readonly node: string;
      /** The topic, service or action over which it is connected, if the question is of one. */
      readonly channel: string | null;
      /** The nodes at its other end. */
      readonly others: readonly string[];
    }
  | ({ readonly type: "open" } & Place);

const LONGEST_PATH = 4096;
const MOST_NAMES = 10_000;
const LARGEST_PICTURE = 64 * 1024 * 1024;
const PICTURE = /^<\?xml version="1\.0" encoding="utf-8"\?>\n<svg [\s\S]*<\/svg>\n$/;

/** The message of the page, with what its kind has and no more; undefined for anything that the page does not send. */
export function pageMessage(data: unknown): PageMessage | undefined {
  const { type, builtin, shown, svg, file, line, column, node, channel, others } = fields(data);
  switch (type) {
    case "ready":
      return typeof builtin === "boolean" ? { type, builtin } : undefined;
    case "builtin":
      return typeof shown === "boolean" ? { type, shown } : undefined;
    case "save":
      return typeof svg === "string" && svg.length <= LARGEST_PICTURE && PICTURE.test(svg) ? { type, svg } : undefined;
    case "why":
      return isPath(node) && (channel === null || isPath(channel)) && isNames(others)
        ? { type, node, channel, others }
        : undefined;
    case "open":
      return isPath(file) && isPosition(line) && isPosition(column) ? { type, file, line, column } : undefined;
    default:
      return undefined;
  }
}

/** The launch file that a page of an earlier session was of, which the page itself has kept. */
export function keptUri(state: unknown): string | undefined {
  const { uri } = fields(state);
  return typeof uri === "string" && uri.startsWith("file:///") && uri.length <= 3 * LONGEST_PATH ? uri : undefined;
}

function fields(data: unknown): Readonly<Record<string, unknown>> {
  return typeof data === "object" && data !== null ? { ...data } : {};
}

function isPath(value: unknown): value is string {
  return typeof value === "string" && value.startsWith("/") && value.length <= LONGEST_PATH && !value.includes("\0");
}

function isNames(value: unknown): value is string[] {
  return Array.isArray(value) && value.length <= MOST_NAMES && value.every(isPath);
}

function isPosition(value: unknown): value is number {
  return Number.isSafeInteger(value) && Number(value) >= 1;
}
