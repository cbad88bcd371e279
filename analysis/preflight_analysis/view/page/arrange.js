// Shows what is looked for.
/** @import {Drawing, Frame, Point, Rectangle} from "./data.js" */
import { chosen } from "./filter.js";
import { foldedAround, outside } from "./folding.js";
import { channelKey, frameKey, itemOf, worst } from "./graph.js";
import { drawMap } from "./minimap.js";
import { drawnTogether, outline } from "./outline.js";
import { pack } from "./packing.js";
import { canvas, element, filter, state } from "./page.js";
import { walkable } from "./tabs.js";
import { scale } from "./zoom.js";

const GAP = 24;
const MARGIN = 14;
/** Between a frame and what is in it. */
const BORDER = 19;
/** Of a folded one. */
const FOLDED_HEIGHT = 38;
const COLUMN = 7.4;

/** Hides what is not looked for and draws the rest together, each thing on its own side of the others as before. */
export function arrange() {
  const { graph } = state;
  const shown = chosen();
  state.shown = shown;
  const wanted = graph.boxes.map((box) =>
    box.node !== undefined
      ? shown.node[box.node]
      : Math.max(...(box.channels ?? []).map((channel) => shown.channel[channel])),
  );
  const around = graph.boxes.map((box) => foldedAround(box.frame));
  const boxes = wanted.map((each, i) => (around[i] === undefined ? each : 0));
  const frames = graph.frames.map(() => false);
  graph.boxes.forEach((box, i) => {
    for (
      let at = around[i] ?? box.frame;
      wanted[i] > 0 && at !== undefined;
      at = graph.frames[at].parent ?? undefined
    ) {
      frames[at] = true;
    }
  });
  const lines = graph.routes.map((route) =>
    wanted[route.source] > 0 && wanted[route.target] > 0 ? outside(route) : undefined,
  );
  bundle(lines);
  const drawn = placed(boxes, lines, frames);
  state.drawn = drawn;
  graph.boxParts.forEach((part, i) => {
    const box = graph.boxes[i];
    const [x, y] = drawn.at(box.island, [box.x, box.y]);
    drawn.boxes[i] = boxes[i] > 0 ? { x, y, width: box.width, height: box.height } : undefined;
    part.classList.toggle("off", boxes[i] === 0);
    part.classList.toggle("context", box.node !== undefined && boxes[i] === 1);
    part.setAttribute("transform", `translate(${x} ${y})`);
  });
  graph.channels.forEach((_, i) => {
    itemOf(channelKey(i)).classList.toggle("context", shown.channel[i] === 0);
  });
  graph.frameParts.forEach((part, i) => {
    part.classList.toggle("off", !frames[i]);
    if (frames[i]) {
      drawFrame(part, graph.frames[i], state.folded.has(frameKey(i)), drawn);
    }
  });
  graph.routeParts.forEach((part, i) => {
    const points = lines[i];
    part.classList.toggle("off", points === undefined);
    if (points !== undefined) {
      const [line, arrow] = outline(points.map((point) => drawn.at(graph.routes[i].island, point)));
      part.querySelector(".line")?.setAttribute("d", line);
      part.querySelector(".wide")?.setAttribute("d", line);
      part.querySelector(".arrow")?.setAttribute("d", arrow);
    }
  });
  state.svg.setAttribute("viewBox", `0 0 ${drawn.width} ${drawn.height}`);
  scale();
  drawMap();
  count(shown, shown.all);
  walkable();
}

/**
 * Of several lines between the same two, of which one is folded, draws the one of which the worst is said, for all.
 * @param {(Point[] | undefined)[]} lines
 */
function bundle(lines) {
  const { graph } = state;
  /** @type {Map<string, number[]>} */
  const alike = new Map();
  graph.routes.forEach((route, i) => {
    const [from, to] = [route.source, route.target].map((box) => foldedAround(graph.boxes[box].frame));
    if (lines[i] !== undefined && (from !== undefined || to !== undefined)) {
      const key = `${from ?? ""} ${from === undefined ? route.source : ""} ${to ?? ""} ${to === undefined ? route.target : ""}`;
      alike.set(key, [...(alike.get(key) ?? []), i]);
    }
  });
  state.bundles.clear();
  for (const group of alike.values()) {
    const rank = (/** @type {number} */ i) =>
      worst(graph.routes[i].edges.flatMap((edge) => graph.edges[edge].findings));
    const [drawn, ...others] = group.sort((a, b) => rank(b) - rank(a) || a - b);
    state.bundles.set(
      drawn,
      group.flatMap((i) => graph.routes[i].edges),
    );
    for (const i of others) {
      lines[i] = undefined;
    }
  }
}

/**
 * Where everything that is shown stands: the room that nothing is in is taken out of each part that nothing connects to
 * the others, and those stand side by side as it suits the window.
 * @param {number[]} boxes
 * @param {(Point[] | undefined)[]} lines
 * @param {boolean[]} frames
 * @returns {Drawing}
 */
function placed(boxes, lines, frames) {
  const { graph } = state;
  /** @type {{taken: Rectangle[], points: Point[]}[]} */
  const islands = Array.from({ length: graph.islands }, () => ({ taken: [], points: [] }));
  graph.boxes.forEach((box, i) => {
    if (boxes[i] > 0) {
      islands[box.island].taken.push(box);
    }
  });
  graph.frames.forEach((frame, i) => {
    if (frames[i] && foldedAround(frame.parent ?? undefined) === undefined) {
      islands[frame.island].taken.push(...bordersOf(frame, state.folded.has(frameKey(i))));
    }
  });
  graph.routes.forEach((route, i) => {
    islands[route.island].points.push(...(lines[i] ?? []));
  });
  const isWhole = islands.map(() => true);
  graph.boxes.forEach((box, i) => {
    isWhole[box.island] &&= boxes[i] > 0;
  });
  const drawings = islands.map(({ taken, points }, i) =>
    taken.length === 0 ? undefined : isWhole[i] ? asLaidOut(i) : drawnTogether(taken, points),
  );
  const seen = drawings.flatMap((drawing, i) => (drawing === undefined ? [] : [{ drawing, i }]));
  const room = canvas.clientWidth / Math.max(1, canvas.clientHeight);
  const aspect = Math.min(3, Math.max(0.4, room || 1.6));
  const sizes = seen.map(({ drawing }) => /** @type {Point} */ ([drawing.width, drawing.height]));
  const { corners, width, height } = pack(sizes, aspect, GAP);
  /** @type {Map<number, Point>} */
  const moved = new Map(seen.map(({ i }, at) => [i, corners[at]]));
  return {
    at: (island, [x, y]) => {
      const [drawing, [left, top]] = [drawings[island], moved.get(island) ?? [0, 0]];
      return drawing === undefined ? [x, y] : [MARGIN + left + drawing.x(x), MARGIN + top + drawing.y(y)];
    },
    boxes: [],
    frames: [],
    width: width + 2 * MARGIN,
    height: height + 2 * MARGIN,
  };
}

/** @param {number} island all of it, in the room that it was given */
function asLaidOut(island) {
  const { graph } = state;
  const own = [...graph.boxes, ...graph.frames].filter((each) => each.island === island);
  const points = graph.routes.filter((route) => route.island === island).flatMap((route) => route.points);
  const xs = [...own.flatMap((each) => [each.x, each.x + each.width]), ...points.map(([x]) => x)];
  const ys = [...own.flatMap((each) => [each.y, each.y + each.height]), ...points.map(([, y]) => y)];
  const [left, top] = [Math.min(...xs), Math.min(...ys)];
  return {
    x: (/** @type {number} */ value) => Math.round((value - left) * 10) / 10,
    y: (/** @type {number} */ value) => Math.round((value - top) * 10) / 10,
    width: Math.max(...xs) - left,
    height: Math.max(...ys) - top,
  };
}

/** @type {(frame: Frame) => number} */
const foldedWidth = (frame) => Math.max(110, [...frame.name].length * COLUMN + 40);

/**
 * What a frame takes of the room itself: its borders and its name, which a folded one is all of.
 * @type {(frame: Frame, isFolded: boolean) => Rectangle[]}
 */
function bordersOf(frame, isFolded) {
  const { x, y, width, height } = frame;
  if (isFolded) {
    return [{ x, y, width: Math.min(width, foldedWidth(frame)), height: Math.min(height, FOLDED_HEIGHT) }];
  }
  return [
    { x, y, width: Math.min(width, foldedWidth(frame)), height: BORDER },
    { x: x + width - BORDER, y: y + height - BORDER, width: BORDER, height: BORDER },
  ];
}

/** @type {(part: SVGElement, frame: Frame, isFolded: boolean, drawn: Drawing) => void} */
function drawFrame(part, frame, isFolded, drawn) {
  const [left, top] = drawn.at(frame.island, [frame.x, frame.y]);
  const [right, bottom] = drawn.at(frame.island, [frame.x + frame.width, frame.y + frame.height]);
  part.classList.toggle("folded", isFolded);
  part.setAttribute("aria-expanded", String(!isFolded));
  part.setAttribute("transform", `translate(${left} ${top})`);
  const paper = part.querySelector(".frame");
  const width = Math.max(right - left, isFolded ? foldedWidth(frame) : 0);
  const height = Math.max(bottom - top, isFolded ? FOLDED_HEIGHT : 0);
  paper?.setAttribute("width", String(width));
  paper?.setAttribute("height", String(height));
  drawn.frames.push({ x: left, y: top, width, height });
}

/**
 * Says how much of it is shown.
 * @param {ReturnType<typeof chosen>} shown
 * @param {boolean} isAll
 */
function count(shown, isAll) {
  const { graph } = state;
  /** @param {number[]} list */
  const wanted = (list) => list.filter((each) => each === 2).length;
  const nodes = wanted(shown.node);
  const channels = wanted(shown.channel);
  filter.classList.toggle("nothing", filter.value.trim() !== "" && shown.matches.length === 0);
  /** @type {(shownOnes: number, all: number, what: string) => string} */
  const of = (shownOnes, all, what) => `${isAll ? "" : `${shownOnes} of `}${all} ${what}`;
  const named = graph.channels.every((channel) => channel.kind === "topic") ? "topics" : "topics, services and actions";
  element("status").textContent =
    `${of(nodes, graph.nodes.length, "nodes")}, ${of(channels, graph.channels.length, named)}`.replace(
      /\b1 (node|topic)s\b/g,
      "1 $1",
    );
}
