// What the signs and colours of the picture mean.
/** @import {Kind, Severity} from "./data.js" */
import { element, make, state } from "./page.js";

/** @type {Record<Kind, string>} */
const ICONS = {
  topic: '<circle class="icon" cx="14" cy="10" r="4"/>',
  service: '<path class="icon" d="M14 5l5 5-5 5-5-5z"/>',
  action: '<path class="icon" d="M10 5l9 5-9 5z"/>',
};

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
  const made = make("span", {}, document.importNode(picture.documentElement, true), text);
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
      rows.push(row(`<rect class="accent f${i % 6}" x="6" y="4" width="12" height="12" rx="3"/>`, file.shown));
    }
  });
  element("legend").replaceChildren(...rows);
}
