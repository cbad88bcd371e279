// Shows what is looked for.
/** @import {Point} from "./data.js" */
import { chosen } from "./filter.js";
import { channelKey, itemOf } from "./graph.js";
import { drawnTogether, outline } from "./outline.js";
import { element, filter, state } from "./page.js";
import { walkable } from "./walk.js";
import { scale } from "./zoom.js";

/** Hides what is not looked for and draws the rest together, each thing on its own side of the others as before. */
export function arrange() {
  const { graph } = state;
  const shown = chosen();
  const boxes = graph.boxes.map((box) =>
    box.node !== undefined
      ? shown.node[box.node]
      : Math.max(...(box.channels ?? []).map((channel) => shown.channel[channel])),
  );
  const routes = graph.routes.map((route) => boxes[route.source] > 0 && boxes[route.target] > 0);
  const isAll = boxes.every((each) => each > 0);
  const drawn = isAll
    ? {
        /** @param {number} value */
        x: (value) => value,
        /** @param {number} value */
        y: (value) => value,
        width: graph.width,
        height: graph.height,
      }
    : drawnTogether(
        graph.boxes.filter((_, i) => boxes[i] > 0),
        graph.routes.filter((_, i) => routes[i]),
      );
  state.drawn = drawn;
  graph.boxParts.forEach((part, i) => {
    const box = graph.boxes[i];
    part.classList.toggle("off", boxes[i] === 0);
    part.classList.toggle("context", box.node !== undefined && boxes[i] === 1);
    part.setAttribute("transform", `translate(${drawn.x(box.x)} ${drawn.y(box.y)})`);
  });
  graph.channels.forEach((_, i) => {
    itemOf(channelKey(i)).classList.toggle("context", shown.channel[i] === 0);
  });
  graph.routeParts.forEach((part, i) => {
    part.classList.toggle("off", !routes[i]);
    if (routes[i]) {
      const [line, arrow] = outline(
        graph.routes[i].points.map(([x, y]) => /** @type {Point} */ ([drawn.x(x), drawn.y(y)])),
      );
      part.querySelector(".line")?.setAttribute("d", line);
      part.querySelector(".wide")?.setAttribute("d", line);
      part.querySelector(".arrow")?.setAttribute("d", arrow);
    }
  });
  state.svg.setAttribute("viewBox", `0 0 ${drawn.width} ${drawn.height}`);
  scale();
  count(shown, shown.all && isAll);
  walkable();
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
  filter.classList.toggle("nothing", nodes + channels === 0 && !shown.all);
  /** @type {(shownOnes: number, all: number, what: string) => string} */
  const of = (shownOnes, all, what) => `${isAll ? "" : `${shownOnes} of `}${all} ${what}`;
  const named = graph.channels.every((channel) => channel.kind === "topic") ? "topics" : "topics, services and actions";
  element("status").textContent =
    `${of(nodes, graph.nodes.length, "nodes")}, ${of(channels, graph.channels.length, named)}`.replace(
      /\b1 (node|topic)s\b/g,
      "1 $1",
    );
}
