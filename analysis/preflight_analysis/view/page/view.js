// Makes the picture of the graph one to walk in: filter, hover, keyboard, zoom. The same in the page of
// `ros-preflight graph --format html`, which holds its data, and in an editor, which sends it.
/** @import {Editor, GraphData, Kind} from "./data.js" */
import { arrange } from "./arrange.js";
import { fold } from "./folding.js";
import { frameKey, index, keyOf } from "./graph.js";
import { listen } from "./input.js";
import { foldLegend, legend } from "./legend.js";
import { compare } from "./live.js";
import { listenToMap } from "./minimap.js";
import { canvas, editor, element, filter, input, make, remember, saved, state } from "./page.js";
import { save } from "./save.js";
import { mark, searchAnew } from "./search.js";
import { focusOn, nameFocus, select, walkTo } from "./walk.js";
import { listDifferences } from "./words.js";
import { fit, magnification, showFullestPart, zoomTo } from "./zoom.js";

/** @type {Kind[]} */
const KINDS = ["topic", "service", "action"];

/** @type {(selector: string) => SVGElement[]} */
const partsOf = (selector) => [.../** @type {NodeListOf<SVGElement>} */ (state.svg.querySelectorAll(selector))];

/** @param {GraphData} next */
function show(next) {
  const isFirst = !state.isLoaded;
  const focused = document.activeElement?.closest("[data-node],[data-channel],[data-frame]");
  const held = focused instanceof SVGElement && canvas.contains(focused) ? keyOf(focused) : undefined;
  const graph = index(next);
  state.graph = graph;
  state.isLoaded = true;
  const title = element("title");
  title.replaceChildren(make("bdi", {}, graph.title));
  title.title = graph.root;
  document.title = `${graph.title} – ROS graph`;
  const parsed = new DOMParser().parseFromString(graph.svg, "image/svg+xml").documentElement;
  state.svg = /** @type {SVGElement} */ (/** @type {Element} */ (document.importNode(parsed, true)));
  canvas.replaceChildren(state.svg);
  for (const item of partsOf("[data-node],[data-channel],[data-frame]")) {
    item.setAttribute("tabindex", "-1");
    item.setAttribute("role", "button");
    graph.items.set(keyOf(item), item);
  }
  graph.boxParts = partsOf("[data-box]");
  graph.routeParts = partsOf("[data-route]");
  graph.frameParts = partsOf("[data-frame]");
  element("fold").hidden = graph.frames.length === 0;
  if (state.focus !== undefined && !graph.items.has(state.focus)) {
    state.focus = undefined;
  }
  for (const kind of KINDS) {
    labelOf(`show-${kind}`).hidden = !graph.channels.some((channel) => channel.kind === kind);
  }
  legend();
  compare();
  arrange();
  mark();
  nameFocus();
  select(state.selected !== undefined && graph.items.has(state.selected) ? state.selected : undefined, false);
  if (held !== undefined) {
    graph.items.get(held)?.focus({ preventScroll: true });
  }
  if (isFirst) {
    if (saved.left === undefined || saved.top === undefined) {
      showFullestPart();
    } else {
      canvas.scrollTo(saved.left, saved.top);
    }
  }
}

/** @param {string} id */
const labelOf = (id) => /** @type {HTMLElement} */ (element(id).parentElement);

/** The page of the command: it holds its pictures, with and without what every node has by its client library. */
function showOwnData() {
  /** @type {{plain: GraphData, builtin: GraphData | null}} */
  const { plain, builtin } = JSON.parse(element("data").textContent ?? "");
  labelOf("builtin").hidden = builtin === null;
  show(plain);
  element("builtin").addEventListener("change", () => {
    remember();
    show((input("builtin").checked && builtin) || plain);
  });
}

/**
 * The page in an editor: the graph is sent, and sent anew when there is news.
 * @param {Editor} editor
 */
function showWhatIsSent(editor) {
  element("theme").hidden = true;
  const theme = () => {
    const { classList } = document.body;
    const isLight = classList.contains("vscode-light") || classList.contains("vscode-high-contrast-light");
    document.documentElement.dataset.theme = isLight ? "light" : "dark";
  };
  theme();
  new MutationObserver(theme).observe(document.body, { attributes: true, attributeFilter: ["class"] });
  addEventListener("message", ({ data }) => {
    if (data.type === "graph") {
      editor.setState({ ...editor.getState(), uri: data.uri });
      show(data.graph);
    } else if (data.type === "live") {
      state.live = data.states;
      if (state.isLoaded) {
        compare();
      }
    } else if (data.type === "nothing") {
      element("status").textContent = data.reason;
    }
  });
  element("builtin").addEventListener("change", () => {
    remember();
    editor.postMessage({ type: "builtin", shown: input("builtin").checked });
  });
  editor.postMessage({ type: "ready", builtin: input("builtin").checked });
}

function searchIfLoaded() {
  if (state.isLoaded) {
    searchAnew();
  } else {
    remember();
  }
}

/** Folds all namespaces, or unfolds them where all are folded. */
function foldAll() {
  const { graph, folded } = state;
  const isFolded = graph.frames.every((frame, i) => frame.parent !== null || folded.has(frameKey(i)));
  graph.frames.forEach((_, i) => {
    fold(i, !isFolded);
  });
  arrange();
  remember();
}

filter.value = saved.filter ?? "";
for (const [id, checked] of Object.entries(saved.boxes ?? {})) {
  input(id).checked = checked;
}
listen();
filter.addEventListener("input", searchIfLoaded);
for (const id of ["show-topic", "show-service", "show-action", "problems", "only"]) {
  element(id).addEventListener("change", searchIfLoaded);
}
element("zoom-in").addEventListener("click", () => zoomTo(magnification() * 1.25));
element("zoom-out").addEventListener("click", () => zoomTo(magnification() / 1.25));
element("fit").addEventListener("click", fit);
element("fold").addEventListener("click", foldAll);
element("unfocus").addEventListener("click", () => focusOn(undefined));
element("show-legend").addEventListener("click", () => {
  const isOpen = !element("legend").hidden;
  state.legend = !isOpen;
  foldLegend(!isOpen);
  remember();
});
element("differences").addEventListener("click", () =>
  listDifferences({ close: () => select(undefined), jump: (key) => walkTo(state.graph.items.get(key)) }),
);
listenToMap();
addEventListener("resize", () => {
  if (state.isLoaded) {
    arrange();
  }
});
element("save").addEventListener("click", save);
element("theme").addEventListener("click", () => {
  const isDark = getComputedStyle(document.documentElement).getPropertyValue("--paper").trim() !== "#ffffff";
  document.documentElement.dataset.theme = isDark ? "light" : "dark";
});
if (editor === undefined) {
  showOwnData();
} else {
  showWhatIsSent(editor);
}
