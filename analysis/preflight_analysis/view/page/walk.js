// What is selected and lit, and walking from one thing to the next.
import { arrange } from "./arrange.js";
import { fold } from "./folding.js";
import {
  channelKey,
  edgesAt,
  edgesOf,
  edgesOfRoute,
  isFrame,
  isNode,
  itemOf,
  keyOf,
  nodeKey,
  nodeOf,
  TOWARDS,
} from "./graph.js";
import { canvas, details, element, go, remember, state } from "./page.js";
import { isShown, tabTo } from "./tabs.js";
import { detail } from "./words.js";

/**
 * Lights a part of the picture and what hangs on it; without one, nothing.
 * @param {SVGElement} [part]
 */
export function light(part) {
  const { graph, svg } = state;
  for (const each of svg.querySelectorAll(".near")) {
    each.classList.remove("near");
  }
  svg.classList.toggle("lit", part !== undefined);
  if (part === undefined) {
    return;
  }
  part.classList.add("near");
  const isRoute = part.dataset.route !== undefined;
  const edges = new Set(isRoute ? edgesOfRoute(part) : edgesAt(part));
  for (const edge of edges) {
    itemOf(nodeKey(graph.edges[edge].node)).classList.add("near");
    itemOf(channelKey(graph.edges[edge].channel)).classList.add("near");
  }
  if (!isRoute) {
    graph.routes.forEach((route, i) => {
      if (route.edges.some((edge) => edges.has(edge))) {
        graph.routeParts[i].classList.add("near");
      }
    });
  }
}

/**
 * @param {string | undefined} key
 * @param {boolean} showsDetails whether those are opened where they are not open
 */
export function select(key, showsDetails = true) {
  for (const part of state.svg.querySelectorAll(".selected")) {
    part.classList.remove("selected");
  }
  state.selected = key;
  const item = key === undefined ? undefined : state.graph.items.get(key);
  item?.classList.add("selected");
  if (item === undefined || showsDetails || !details.hidden) {
    details.hidden = item === undefined;
    if (item !== undefined) {
      detail(item, {
        close: () => select(undefined),
        jump: (to) => walkTo(state.graph.items.get(to)),
        focus: () => focusOn(key),
      });
    }
  }
  remember();
}

/**
 * Where the click and Enter lead: to the line that makes it.
 * @param {SVGElement} part
 */
export function follow(part) {
  const { graph } = state;
  if (isFrame(part)) {
    toggle(part);
    return;
  }
  if (part.dataset.route !== undefined) {
    const edge = graph.edges[edgesOfRoute(part)[0]];
    select(channelKey(edge.channel));
    go(edge.places[0]);
    return;
  }
  select(keyOf(part));
  if (isNode(part)) {
    go(nodeOf(part).places[0]);
    return;
  }
  const edges = edgesOf(part);
  const providers = ["publisher", "service", "action_server"];
  go((edges.find((edge) => providers.includes(edge.role)) ?? edges[0]).places[0]);
}

/**
 * Folds a namespace or unfolds it, and leaves its name where it is on the screen.
 * @param {SVGElement} part
 */
export function toggle(part) {
  const before = part.getBoundingClientRect();
  fold(Number(part.dataset.frame));
  arrange();
  const after = part.getBoundingClientRect();
  canvas.scrollBy(after.left - before.left, after.top - before.top);
  remember();
}

/** Shows the neighbourhood of what is looked at alone; all again, where it is shown alone already.
 * @param {string | undefined} key
 */
export function focusOn(key) {
  state.focus = key === state.focus ? undefined : key;
  arrange();
  nameFocus();
  remember();
}

/** Says what alone is shown, on the button that shows all again. */
export function nameFocus() {
  const button = element("unfocus");
  button.hidden = state.focus === undefined;
  button.textContent = `Only around ${(state.focus ?? "").replace(/#\d+$/, "")} ✕`;
}

/** @param {SVGElement | undefined} item */
export function walkTo(item) {
  if (item === undefined || !isShown(item)) {
    return;
  }
  tabTo(item);
  item.focus({ preventScroll: true });
  item.scrollIntoView({ block: "nearest", inline: "nearest" });
  light(item);
  if (!details.hidden && !isFrame(item)) {
    select(keyOf(item));
  }
}

/** @param {Element} item */
function middle(item) {
  const box = (
    item.querySelector(isFrame(/** @type {SVGElement} */ (item)) ? ".name" : "rect") ?? item
  ).getBoundingClientRect();
  return { x: box.left + box.width / 2, y: box.top + box.height / 2 };
}

/**
 * What an arrow key leads to.
 * @param {SVGElement} item
 * @param {string} key
 */
export function step(item, key) {
  const here = middle(item);
  /** @type {[distance: number, to: SVGElement][]} */
  let ahead;
  if ((key === "ArrowLeft" || key === "ArrowRight") && !isFrame(item)) {
    // Along the edges, with the messages or against them.
    ahead = edgesOf(item)
      .filter((edge) => (TOWARDS.has(edge.role) === isNode(item)) === (key === "ArrowRight"))
      .map((edge) => itemOf(isNode(item) ? channelKey(edge.channel) : nodeKey(edge.node)))
      .filter(isShown)
      .map((to) => [Math.abs(middle(to).y - here.y), to]);
  } else if (key === "ArrowLeft" || key === "ArrowRight") {
    return undefined;
  } else {
    const sign = key === "ArrowDown" ? 1 : -1;
    // The nearest ahead; what stands aside counts as farther away.
    ahead = [...state.graph.items.values()]
      .filter((to) => to !== item && isShown(to) && (middle(to).y - here.y) * sign > 1)
      .map((to) => [Math.abs(middle(to).y - here.y) + 3 * Math.abs(middle(to).x - here.x), to]);
  }
  return ahead.sort((a, b) => a[0] - b[0])[0]?.[1];
}
