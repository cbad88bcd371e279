// How large the picture is.
import { showWindow } from "./minimap.js";
import { canvas, remember, state } from "./page.js";

export const magnification = () =>
  state.zoom ??
  Math.min(
    1.25,
    Math.max(
      state.least,
      Math.min((canvas.clientWidth - 4) / state.drawn.width, (canvas.clientHeight - 4) / state.drawn.height),
    ),
  );

export function scale() {
  const by = magnification();
  state.svg.setAttribute("width", String(state.drawn.width * by));
  state.svg.setAttribute("height", String(state.drawn.height * by));
  showWindow();
}

export function fit() {
  state.zoom = undefined;
  state.least = 0.08;
  scale();
  remember();
}

const AROUND = 24;

/** Scrolls to the part of the picture with the most boxes: the corner of a large one may be empty. */
export function showFullestPart() {
  const by = magnification();
  const [width, height] = [canvas.clientWidth / by, canvas.clientHeight / by];
  const boxes = state.drawn.boxes.filter((box) => box !== undefined);
  let [most, left, top] = [0, 0, 0];
  for (const { x, y } of boxes) {
    const [fromX, fromY] = [Math.max(0, x - AROUND), Math.max(0, y - AROUND)];
    const seen = boxes.filter(
      (box) =>
        box.x >= fromX && box.y >= fromY && box.x + box.width <= fromX + width && box.y + box.height <= fromY + height,
    ).length;
    if (seen > most) {
      [most, left, top] = [seen, fromX, fromY];
    }
  }
  canvas.scrollTo(left * by, top * by);
}

/**
 * @param {number} next
 * @param {{x: number, y: number}} [at] what stays where it is on the screen; the middle, unless it is said
 */
export function zoomTo(next, at) {
  const box = canvas.getBoundingClientRect();
  const point = at ?? { x: box.left + box.width / 2, y: box.top + box.height / 2 };
  const before = state.svg.getBoundingClientRect();
  const [partX, partY] = [(point.x - before.left) / before.width, (point.y - before.top) / before.height];
  state.zoom = Math.min(3, Math.max(0.08, next));
  scale();
  const after = state.svg.getBoundingClientRect();
  canvas.scrollBy(after.left + partX * after.width - point.x, after.top + partY * after.height - point.y);
  remember();
}
