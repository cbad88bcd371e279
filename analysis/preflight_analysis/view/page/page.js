// The parts of the page, the editor around it if there is one, and what is remembered for it.
/** @import {Drawing, Editor, Graph, Live, Place, Saved, Shown} from "./data.js" */

/** @param {string} id */
export function element(id) {
  const found = document.getElementById(id);
  if (found === null) {
    throw new Error(`the page has no ${id}`);
  }
  return found;
}

/** @param {string} id */
export const input = (id) => /** @type {HTMLInputElement} */ (element(id));

export const canvas = element("canvas");
export const hint = element("hint");
export const details = element("details");
export const filter = input("filter");

/** @type {Editor | undefined} */
export const editor = typeof acquireVsCodeApi === "function" ? acquireVsCodeApi() : undefined;
/** @type {Saved} */
export const saved = editor?.getState() ?? {};

/** @type {Graph} */
const NOTHING = {
  root: "",
  title: "",
  files: [],
  nodes: [],
  channels: [],
  edges: [],
  findings: [],
  width: 0,
  height: 0,
  boxes: [],
  routes: [],
  frames: [],
  islands: 0,
  svg: "",
  ofNode: [],
  ofChannel: [],
  items: new Map(),
  boxParts: [],
  routeParts: [],
  frameParts: [],
};

export const state = {
  /** Whether there is a graph yet. */
  isLoaded: false,
  graph: NOTHING,
  svg: /** @type {SVGElement} */ (document.createElementNS("http://www.w3.org/2000/svg", "svg")),
  /** @type {number | undefined} As the user set it; else all of it is shown, down to what can be read. */
  zoom: saved.zoom,
  least: 0.55,
  /** @type {string | undefined} */
  selected: saved.selected,
  /** @type {Live} What is the case on the running robot, while it is watched. */
  live: {},
  /** @type {Drawing} */
  drawn: { at: (_, place) => place, boxes: [], frames: [], width: 0, height: 0 },
  /** @type {Map<number, number[]>} The edges of the lines that are drawn for others, too. */
  bundles: new Map(),
  shown: /** @type {Shown} */ ({ node: [], channel: [], all: true, matches: [] }),
  /** The keys of the namespaces that are folded. */
  folded: new Set(saved.folded ?? []),
  /** @type {string | undefined} The key of what alone is shown, with its neighbours. */
  focus: saved.focus,
  /** @type {boolean | undefined} Whether the legend is seen, once the user said so. */
  legend: saved.legend,
};

export function remember() {
  const boxes = Object.fromEntries(
    ["show-topic", "show-service", "show-action", "problems", "builtin", "only"].map((id) => [id, input(id).checked]),
  );
  const { zoom, selected, focus, legend } = state;
  const folded = [...state.folded];
  const { scrollLeft: left, scrollTop: top } = canvas;
  editor?.setState({
    ...editor.getState(),
    filter: filter.value,
    boxes,
    zoom,
    selected,
    folded,
    focus,
    legend,
    left,
    top,
  });
}

/**
 * @template {keyof HTMLElementTagNameMap} Name
 * @param {Name} name
 * @param {Partial<HTMLElementTagNameMap[Name]>} attributes
 * @param {(Node | string)[]} children
 */
export function make(name, attributes, ...children) {
  const made = document.createElement(name);
  Object.assign(made, attributes);
  made.append(...children);
  return made;
}

/**
 * Opens the line of a place in the editor.
 * @param {Place} place
 */
export function go(place) {
  editor?.postMessage({ type: "open", file: place.file, line: place.line, column: place.column });
}

/**
 * Has the editor explain the connection of a node with another one.
 * @param {string} node
 * @param {string | null} channel over which
 * @param {string[]} others the nodes at its other end
 */
export function why(node, channel, others) {
  // The name of one of several channels of a name ends with its domain.
  editor?.postMessage({ type: "why", node, channel: channel?.replace(/ \(.*\)$/, "") ?? null, others });
}
