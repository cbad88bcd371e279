// The graph that is shown, by what is asked of it: what hangs on what, and which part of the picture is which.
/** @import {Channel, Edge, Finding, Graph, GraphData, GraphNode, Route, Severity} from "./data.js" */
import { state } from "./page.js";

/** @type {Severity[]} */
const RANKS = ["hint", "info", "warning", "error"];

export const TOWARDS = new Set(["publisher", "client", "action_client"]);

/**
 * @param {GraphData} data
 * @returns {Graph}
 */
export function index(data) {
  /** @type {Graph} */
  const found = {
    ...data,
    ofNode: data.nodes.map(() => []),
    ofChannel: data.channels.map(() => []),
    items: new Map(),
    boxParts: [],
    routeParts: [],
    frameParts: [],
  };
  data.edges.forEach((edge, i) => {
    found.ofNode[edge.node].push(i);
    found.ofChannel[edge.channel].push(i);
  });
  return found;
}

/** @param {number} node */
export const nodeKey = (node) => `node ${state.graph.nodes[node].name}#${node}`;

/** @param {number} channel */
export const channelKey = (channel) => `${state.graph.channels[channel].kind} ${state.graph.channels[channel].name}`;

/** @param {number} frame */
export const frameKey = (frame) => `namespace ${state.graph.frames[frame].name}`;

/** @param {SVGElement | HTMLElement} part */
export const isFrame = (part) => part.dataset.frame !== undefined;

/** @param {SVGElement | HTMLElement} part */
export const isNode = (part) => part.dataset.node !== undefined;

/** @param {SVGElement | HTMLElement} part */
export const keyOf = (part) =>
  isFrame(part)
    ? frameKey(Number(part.dataset.frame))
    : isNode(part)
      ? nodeKey(Number(part.dataset.node))
      : channelKey(Number(part.dataset.channel));

/** The nodes and channels, without the boxes of namespaces. */
export const things = () => [...state.graph.items.values()].filter((part) => !isFrame(part));

/**
 * The innermost namespace that a node or channel stands in, by its position.
 * @param {SVGElement} part
 */
export const frameOf = (part) => {
  const box = part.closest("[data-box]");
  return box instanceof SVGElement ? state.graph.boxes[Number(box.dataset.box)].frame : undefined;
};

/**
 * @param {SVGElement} part
 * @returns {GraphNode}
 */
export const nodeOf = (part) => state.graph.nodes[Number(part.dataset.node)];

/**
 * @param {SVGElement} part
 * @returns {Channel}
 */
export const channelOf = (part) => state.graph.channels[Number(part.dataset.channel)];

/**
 * @param {SVGElement} part
 * @returns {Route}
 */
export const routeOf = (part) => state.graph.routes[Number(part.dataset.route)];

/**
 * The positions of the edges that a line stands for: it may be drawn for others, too, that lead to the same folded box.
 * @param {SVGElement} part
 */
export const edgesOfRoute = (part) => state.bundles.get(Number(part.dataset.route)) ?? routeOf(part).edges;

/**
 * The positions of the edges of a node or channel.
 * @param {SVGElement} part
 */
export const edgesAt = (part) =>
  isFrame(part)
    ? state.graph.frames[Number(part.dataset.frame)].nodes.flatMap((node) => state.graph.ofNode[node])
    : isNode(part)
      ? state.graph.ofNode[Number(part.dataset.node)]
      : state.graph.ofChannel[Number(part.dataset.channel)];

/**
 * @param {SVGElement} part
 * @returns {Edge[]}
 */
export const edgesOf = (part) => edgesAt(part).map((i) => state.graph.edges[i]);

/**
 * @param {string} key
 * @returns {SVGElement}
 */
export function itemOf(key) {
  const found = state.graph.items.get(key);
  if (found === undefined) {
    throw new Error(`the picture has no ${key}`);
  }
  return found;
}

/**
 * The rank of the worst finding, -1 where there is none.
 * @param {number[]} findings
 */
export const worst = (findings) =>
  Math.max(-1, ...findings.map((i) => RANKS.indexOf(/** @type {Finding} */ (state.graph.findings[i]).severity)));
