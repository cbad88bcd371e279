// What the page is given: schema `ros-preflight/view/1`, written by view_json.py. A number refers to the position in the
// list of that name.

export type Place = { file: string; shown: string; line: number; column: number };
export type Role = "publisher" | "subscriber" | "service" | "client" | "action_server" | "action_client";
export type Kind = "topic" | "service" | "action";
export type Severity = "hint" | "info" | "warning" | "error";
export type State = "normal" | "missing" | "extra" | "wrong";

export type GraphNode = {
  name: string;
  package: string | null;
  executable: string | null;
  kind: string;
  file: number;
  places: Place[];
  source: string;
  outcome: string;
  reason: string | null;
  findings: number[];
  state: State;
};
export type Channel = {
  kind: Kind;
  name: string;
  types: string[];
  builtin: boolean;
  external: boolean;
  findings: number[];
  notes: string[];
  state: State;
};
export type Edge = {
  node: number;
  channel: number;
  role: Role;
  type: string | null;
  qos: Record<string, unknown>;
  from: string | null;
  places: Place[];
  builtin: boolean;
  uncertain: boolean;
  findings: number[];
};
export type Finding = { rule: string; severity: Severity; message: string; place: Place };
export type Rectangle = { x: number; y: number; width: number; height: number };
/** Stands for one node, or for channels. */
export type Box = Rectangle & { island: number; frame?: number; node?: number; channels?: number[] };
/** The box around a namespace; `parent` is the one around it. */
export type Frame = Rectangle & { name: string; island: number; parent: number | null; nodes: number[] };
export type Point = [x: number, y: number];
export type Route = { source: number; target: number; island: number; edges: number[]; points: Point[] };

export type GraphData = {
  root: string;
  title: string;
  files: { path: string; shown: string }[];
  nodes: GraphNode[];
  channels: Channel[];
  edges: Edge[];
  findings: Finding[];
  width: number;
  height: number;
  boxes: Box[];
  routes: Route[];
  frames: Frame[];
  islands: number;
  svg: string;
};

/** With, per node and channel, its edges, and what of the picture shows what. */
export type Graph = GraphData & {
  ofNode: number[][];
  ofChannel: number[][];
  items: Map<string, SVGElement>;
  boxParts: SVGElement[];
  routeParts: SVGElement[];
  frameParts: SVGElement[];
};

/** How much of each node and channel is shown: 2 is looked for, 1 is beside it, 0 is hidden. `matches` are keys. */
export type Shown = { node: number[]; channel: number[]; all: boolean; matches: string[] };

/** What is not as expected: of a node, or of its endpoint `name` with the role `what`; `since` is a time of the day. */
export type Issue = { node: string; message: string; what?: string; name?: string | null; since?: string };

/** The message `live` of the server: how each is on the running robot, by name. Without `nodes` nothing is watched. */
export type Live = {
  nodes?: Record<string, string>;
  topics?: Record<string, string>;
  services?: Record<string, string>;
  actions?: Record<string, string>;
  issues?: Issue[];
};

/** How a place in a part of the layout becomes one of the picture, how large that is, and where each box is in it. */
export type Drawing = {
  at: (island: number, place: Point) => Point;
  boxes: (Rectangle | undefined)[];
  frames: Rectangle[];
  width: number;
  height: number;
};

/** What stays when an editor takes the page away and brings it back. */
export type Saved = {
  uri?: string;
  filter?: string;
  boxes?: Record<string, boolean>;
  zoom?: number;
  selected?: string;
  folded?: string[];
  focus?: string;
  legend?: boolean;
  left?: number;
  top?: number;
};

export type Editor = {
  getState(): Saved | undefined;
  setState(state: Saved): void;
  postMessage(message: object): void;
};

declare global {
  /** VS Code's, in a webview alone. */
  const acquireVsCodeApi: undefined | (() => Editor);
}
