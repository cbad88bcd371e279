// The search: what fits is marked, and the picture goes to one after the other.
import { arrange } from "./arrange.js";
import { unfoldAround } from "./folding.js";
import { frameOf } from "./graph.js";
import { canvas, element, filter, input, remember, state } from "./page.js";
import { tabTo } from "./tabs.js";
import { magnification, zoomTo } from "./zoom.js";

/** At which size names can be read. */
const READABLE = 0.8;

/** @type {string | undefined} The key of the match that the picture has gone to. */
let current;

export function searchAnew() {
  arrange();
  const { matches } = state.shown;
  current = current !== undefined && matches.includes(current) ? current : undefined;
  mark();
  if (!input("only").checked && matches.length > 0) {
    goTo(current ?? matches[0]);
  }
  remember();
}

/** Marks what fits, and says how much that is. */
export function mark() {
  const { graph, shown, svg } = state;
  if (shown.matches.length === 0) {
    current = undefined;
  }
  const matches = new Set(shown.matches);
  svg.classList.toggle("searched", matches.size > 0 && !input("only").checked);
  for (const [key, item] of graph.items) {
    item.classList.toggle("match", matches.has(key));
    item.classList.toggle("found", key === current);
  }
  const at = current === undefined ? 0 : shown.matches.indexOf(current) + 1;
  element("found").textContent =
    filter.value.trim() === "" || matches.size === 0
      ? filter.value.trim() === ""
        ? ""
        : "nothing found"
      : at > 0
        ? `${at} of ${matches.size}: ${current?.replace(/#\d+$/, "")}`
        : `${matches.size} found`;
}

/** @param {number} step to the next match, or with -1 to the one before */
export function next(step) {
  const { matches } = state.shown;
  if (matches.length > 0) {
    const at = current === undefined ? (step > 0 ? -1 : 0) : matches.indexOf(current);
    goTo(matches[(at + step + matches.length) % matches.length]);
  }
}

/** The match that the picture has gone to. */
export const found = () => (current === undefined ? undefined : state.graph.items.get(current));

/** @param {string} key */
function goTo(key) {
  const item = state.graph.items.get(key);
  if (item === undefined) {
    return;
  }
  current = key;
  if (unfoldAround(frameOf(item))) {
    arrange();
  }
  mark();
  tabTo(item);
  centre(item);
}

/**
 * Brings a part of the picture into the middle, as large as it can be read.
 * @param {SVGElement} item
 */
export function centre(item) {
  if (magnification() < READABLE) {
    zoomTo(READABLE);
  }
  const [box, view] = [(item.querySelector("rect") ?? item).getBoundingClientRect(), canvas.getBoundingClientRect()];
  canvas.scrollBy(
    box.left + box.width / 2 - view.left - view.width / 2,
    box.top + box.height / 2 - view.top - view.height / 2,
  );
}
