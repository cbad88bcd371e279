// The boxes of namespaces, and what is left of one that is folded.
/** @import {Frame, Point, Route} from "./data.js" */
import { frameKey } from "./graph.js";
import { state } from "./page.js";

/** @param {number | undefined} frame the outermost folded one around it, with itself */
export function foldedAround(frame) {
  const { graph } = state;
  let found;
  for (let at = frame; at !== undefined && at !== null; at = graph.frames[at].parent ?? undefined) {
    found = state.folded.has(frameKey(at)) ? at : found;
  }
  return found;
}

/**
 * @param {number} frame
 * @param {boolean} [isFolded] the other way round, unless it is said
 */
export function fold(frame, isFolded = !state.folded.has(frameKey(frame))) {
  state.folded[isFolded ? "add" : "delete"](frameKey(frame));
}

/** @param {number | undefined} frame unfolds it and all around it; whether there was anything to unfold */
export function unfoldAround(frame) {
  let wasFolded = false;
  for (let at = frame; at !== undefined && at !== null; at = state.graph.frames[at].parent ?? undefined) {
    wasFolded = state.folded.delete(frameKey(at)) || wasFolded;
  }
  return wasFolded;
}

/**
 * A line without its ends in folded boxes: it begins and ends at their borders. Nothing where both are in the same.
 * @param {Route} route
 * @returns {Point[] | undefined}
 */
export function outside(route) {
  const { graph } = state;
  const [from, to] = [route.source, route.target].map((box) => foldedAround(graph.boxes[box].frame));
  if (from !== undefined && from === to) {
    return undefined;
  }
  const points = from === undefined ? route.points : cut([...route.points].reverse(), graph.frames[from]).reverse();
  return to === undefined ? points : cut(points, graph.frames[to]);
}

/**
 * @param {Point[]} points the last of them is in the box
 * @param {Frame} frame
 * @returns {Point[]}
 */
function cut(points, frame) {
  /** @type {(point: Point) => boolean} */
  const isInside = ([x, y]) => x > frame.x && x < frame.x + frame.width && y > frame.y && y < frame.y + frame.height;
  const first = points.findIndex(isInside);
  if (first < 1) {
    return points;
  }
  const [x, y] = points[first - 1];
  // Lines go across or down, so that the nearest point of the border is where they enter.
  /** @type {Point} */
  const border = [
    Math.max(frame.x, Math.min(x, frame.x + frame.width)),
    Math.max(frame.y, Math.min(y, frame.y + frame.height)),
  ];
  return [...points.slice(0, first), border];
}
