// All of a large graph in a corner, with what of it is seen. Without a stop for the keyboard, which has the search.
import { worst } from "./graph.js";
import { canvas, element, state } from "./page.js";

/** With how many boxes there is none yet. */
const MANY = 60;
const WIDTH = 190;
const HEIGHT = 130;
const SVG = "http://www.w3.org/2000/svg";

const map = element("map");

/** @type {(name: string, attributes: Record<string, string | number>) => SVGElement} */
function part(name, attributes) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, String(value));
  }
  return /** @type {SVGElement} */ (made);
}

const factor = () => Math.min(WIDTH / state.drawn.width, HEIGHT / state.drawn.height);

/** Draws it anew: the picture has changed. */
export function drawMap() {
  const { graph, drawn } = state;
  if (graph.boxes.length <= MANY) {
    map.hidden = true;
    return;
  }
  const by = factor();
  const [width, height] = [drawn.width * by, drawn.height * by];
  const svg = part("svg", { width, height, viewBox: `0 0 ${drawn.width} ${drawn.height}` });
  for (const frame of drawn.frames) {
    svg.append(part("rect", { class: "space", ...frame }));
  }
  drawn.boxes.forEach((box, i) => {
    if (box !== undefined) {
      const { node, channels = [] } = graph.boxes[i];
      const rank =
        node === undefined
          ? worst(channels.flatMap((at) => graph.channels[at].findings))
          : worst(graph.nodes[node].findings);
      const kind = node === undefined ? "channels" : "node";
      const class_ = `${kind} ${["", "info", "warning", "error"][Math.max(0, rank)]}`;
      svg.append(part("rect", { class: class_, x: box.x, y: box.y, width: box.width, height: box.height }));
    }
  });
  svg.append(part("rect", { id: "window", class: "window" }));
  map.replaceChildren(svg);
  showWindow();
}

/** Shows what of the picture is seen; nothing where that is all of it. */
export function showWindow() {
  const shown = map.querySelector("#window");
  if (shown === null) {
    return;
  }
  map.hidden = canvas.scrollWidth <= canvas.clientWidth + 1 && canvas.scrollHeight <= canvas.clientHeight + 1;
  const by = Number(state.svg.getAttribute("width")) / state.drawn.width || 1;
  for (const [name, value] of Object.entries({
    x: canvas.scrollLeft / by,
    y: canvas.scrollTop / by,
    width: Math.min(state.drawn.width, canvas.clientWidth / by),
    height: Math.min(state.drawn.height, canvas.clientHeight / by),
  })) {
    shown.setAttribute(name, String(value));
  }
}

/** @param {PointerEvent} event */
function lookAt(event) {
  const box = map.getBoundingClientRect();
  const by = Number(state.svg.getAttribute("width")) / state.drawn.width / factor();
  const [x, y] = [event.clientX - box.left, event.clientY - box.top];
  canvas.scrollTo(x * by - canvas.clientWidth / 2, y * by - canvas.clientHeight / 2);
}

export function listenToMap() {
  map.addEventListener("pointerdown", (event) => {
    map.setPointerCapture(event.pointerId);
    lookAt(event);
  });
  map.addEventListener("pointermove", (event) => {
    if (event.buttons > 0) {
      lookAt(event);
    }
  });
  canvas.addEventListener("scroll", showWindow);
}
