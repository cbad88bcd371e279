import type { Location } from "vscode-languageserver-types";

/** What is the case with a node of the launch, or with one that the launch file does not start, on the running robot. */
export type LiveState = "present" | "missing" | "extra" | "dead" | "wrong-type" | "differs" | "inactive" | "unsure";

/** The states of what has a name, by that. */
export interface LiveStates {
  readonly nodes?: Readonly<Record<string, LiveState>>;
  readonly topics?: Readonly<Record<string, LiveState>>;
  readonly services?: Readonly<Record<string, LiveState>>;
  readonly actions?: Readonly<Record<string, LiveState>>;
}

/** What `rosPreflight/live` tells of the running system; the server's `protocol.py` has the whole of it. */
export interface Live extends LiveStates {
  readonly event: "waiting" | "attached" | "restarted" | "state" | "stopped";
  /** Why the system cannot be asked, or why nothing is watched any more. */
  readonly reason?: string | null;
  /** What is watched. */
  readonly to?: string;
  readonly same?: boolean;
  readonly issues?: readonly Issue[];
}

/** One thing that is not as expected. `what` is `node` or the role of the endpoint, which is called `name`. */
export interface Issue {
  readonly counts: boolean;
  readonly message: string;
  readonly node: string;
  readonly what?: string;
  readonly name?: string | null;
  readonly expected?: string | null;
  readonly actual?: string | null;
  readonly location?: Location | null;
}

/** An issue and when it was seen first, in milliseconds. */
export interface Difference extends Issue {
  readonly since: number;
}

/** What is shown of the running system. */
export interface Watched {
  readonly states: ReadonlyMap<string, LiveState>;
  /** What is not as expected, by node. */
  readonly issues: ReadonlyMap<string, readonly string[]>;
  /** The same in the order in which it is told, what counts first. */
  readonly differences: readonly Difference[];
  /** One line; undefined while nothing is watched. */
  readonly message: string | undefined;
}

export const UNWATCHED: Watched = { states: new Map(), issues: new Map(), differences: [], message: undefined };

const STATES: Readonly<Record<LiveState, string>> = {
  present: "Runs as expected.",
  missing: "Not running.",
  extra: "Runs, and is not in the launch file.",
  dead: "Registered, and does not answer.",
  "wrong-type": "Runs, with another type than expected.",
  differs: "Runs, with differences.",
  inactive: "Runs; the lifecycle node is not active.",
  unsure: "Not running, which may be right.",
};

/** What is said of a node on the running robot, a line each; nothing while it is not watched. */
export function liveLines(name: string, watched: Watched): string[] {
  const state = watched.states.get(name);
  return state === undefined ? [] : [`On the running robot: ${STATES[state]}`, ...(watched.issues.get(name) ?? [])];
}

/**
 * What is shown after one more event; `to` is what the one before told to be watched, `before` what was shown, `now` the
 * time in milliseconds.
 */
export function watched(live: Live, to: string | undefined, before: Watched = UNWATCHED, now = Date.now()): Watched {
  switch (live.event) {
    case "stopped":
      // Without a reason it was the user who ended it.
      return live.reason ? { ...UNWATCHED, message: `Not watched any more: ${live.reason}` } : UNWATCHED;
    case "waiting":
      return { ...UNWATCHED, message: `Waiting for the running system: ${live.reason ?? ""}` };
    case "attached":
    case "restarted":
      return { ...UNWATCHED, message: `Watching ${live.to ?? "the running system"}` };
    case "state": {
      const differences = (live.issues ?? []).filter(({ counts }) => counts);
      const said =
        differences.length === 0
          ? "as it should be"
          : `${differences.length} difference${differences.length === 1 ? "" : "s"}. ${differences[0]?.message}`;
      return {
        states: new Map(Object.entries(live.nodes ?? {})),
        issues: byNode(live.issues ?? []),
        differences: lasting(live.issues ?? [], before.differences, now),
        message: `Watching ${to ?? "the running system"}: ${said}`,
      };
    }
  }
}

/** What was seen last time, too, has lasted since then. */
function lasting(issues: readonly Issue[], before: readonly Difference[], now: number): Difference[] {
  const since = new Map(before.map((each) => [`${each.node} ${each.message}`, each.since]));
  return issues
    .map((issue) => ({ ...issue, since: since.get(`${issue.node} ${issue.message}`) ?? now }))
    .sort((a, b) => Number(b.counts) - Number(a.counts));
}

/** The time of the day. */
export function clock(milliseconds: number): string {
  return new Date(milliseconds).toTimeString().slice(0, 8);
}

function byNode(issues: NonNullable<Live["issues"]>): ReadonlyMap<string, readonly string[]> {
  const found = new Map<string, string[]>();
  for (const { node, message } of issues) {
    found.set(node, [...(found.get(node) ?? []), message]);
  }
  return found;
}
