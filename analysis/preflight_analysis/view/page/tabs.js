// Which one thing of the picture is in the order of Tab.
import { things } from "./graph.js";
import { state } from "./page.js";

/** @param {Element} item */
export const isShown = (item) => item.closest(".off") === null;

/** @param {SVGElement} [current] the only one in the order of Tab */
export function tabTo(current) {
  for (const item of state.graph.items.values()) {
    item.setAttribute("tabindex", item === current ? "0" : "-1");
  }
}

/** The one that the tabulator leads to. */
export const tabbed = () =>
  [...state.graph.items.values()].find((item) => item.getAttribute("tabindex") === "0" && isShown(item));

/** One thing of the picture is in the order of Tab; arrows lead on from there. */
export function walkable() {
  tabTo(tabbed() ?? things().find(isShown) ?? [...state.graph.items.values()].find(isShown));
}
