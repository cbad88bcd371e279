// What the signs and colours of the picture mean.
/** @import {Kind, Severity} from "./data.js" */
import { element, make, state } from "./page.js";

/** @type {Record<Kind, string>} */
const ICONS = {
  topic: '<circle class="icon" cx="14" cy="10" r="4"/>',
  service: '<path class="icon" d="M14 5l5 5-5 5-5-5z"/>',
  action: '<path class="icon" d="M10 5l9 5-9 5z"/>',
};

/** With more rows it is folded at first, to leave the room to the picture. */
const FEW = 12;

/** @type {Severity[]} */
const SEVERITIES = ["error", "warning", "info"];

/**
 * @param {string} inside
 * @param {string} text
 */
function row(inside, text) {
  const picture = new DOMParser().parseFromString(
    `<svg xmlns="http://www.w3.org/2000/svg" class="graph" width="22" height="20" aria-hidden="true">${inside}</svg>`,
    "image/svg+xml",
  );
  const made = make(
    "span",
    {},
    document.importNode(picture.documentElement, true),
    make("bdi", { title: text }, make("bdi", { dir: "ltr" }, text)),
  );
  made.setAttribute("role", "listitem");
  return made;
}

export function legend() {
  const { graph, svg } = state;
  const rows = [];
  for (const [kind, icon] of Object.entries(ICONS)) {
    if (graph.channels.some((channel) => channel.kind === kind)) {
      rows.push(row(`<g class="channel ${kind}">${icon}</g>`, kind));
    }
  }
  if (svg.querySelector(".dangling")) {
    rows.push(row(`<g class="channel topic dangling">${ICONS.topic}</g>`, "one side only"));
  }
  for (const severity of SEVERITIES) {
    if (graph.findings.some((finding) => finding.severity === severity)) {
      rows.push(row(`<g class="route ${severity}"><path class="line" d="M2 10h18"/></g>`, severity));
    }
  }
  if (graph.edges.some((edge) => edge.uncertain)) {
    rows.push(row('<g class="route topic uncertain"><path class="line" d="M2 10h18"/></g>', "not sure"));
  }
  const starting = new Set(graph.nodes.map((node) => node.file));
  graph.files.forEach((file, i) => {
    if (starting.has(i)) {
      const number = `<text class="file" x="12" y="14" text-anchor="middle">${i + 1}</text>`;
      rows.push(row(`<rect class="accent f${i % 6}" x="4" y="2" width="16" height="16" rx="3"/>${number}`, file.shown));
    }
  });
  if (graph.nodes.some((node) => node.source === "none")) {
    rows.push(
      row('<g class="node unknown"><rect class="box" x="2" y="3" width="18" height="14" rx="3"/></g>', "nothing known"),
    );
  }
  element("legend").replaceChildren(...rows);
  foldLegend(state.legend ?? rows.length <= FEW);
}

/** @param {boolean} isOpen */
export function foldLegend(isOpen) {
  element("legend").hidden = !isOpen;
  element("show-legend").setAttribute("aria-expanded", String(isOpen));
}
