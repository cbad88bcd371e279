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
export type Box = Rectangle & { node?: number; channels?: number[] };
export type Point = [x: number, y: number];
export type Route = { source: number; target: number; edges: number[]; points: Point[] };

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
  svg: string;
};

/** With, per node and channel, its edges, and what of the picture shows what. */
export type Graph = GraphData & {
  ofNode: number[][];
  ofChannel: number[][];
  items: Map<string, SVGElement>;
  boxParts: SVGElement[];
  routeParts: SVGElement[];
};

/** The message `live` of the server: how each is on the running robot, by name. Without `nodes` nothing is watched. */
export type Live = {
  nodes?: Record<string, string>;
  topics?: Record<string, string>;
  services?: Record<string, string>;
  actions?: Record<string, string>;
  issues?: { node: string; message: string }[];
};

/** How a coordinate of the layout becomes one of the picture, and how large that is. */
export type Drawing = { x: (value: number) => number; y: (value: number) => number; width: number; height: number };

/** What stays when an editor takes the page away and brings it back. */
export type Saved = {
  uri?: string;
  filter?: string;
  boxes?: Record<string, boolean>;
  zoom?: number;
  selected?: string;
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
