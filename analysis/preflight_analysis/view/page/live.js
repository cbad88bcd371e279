// The running robot.
/** @import {Issue} from "./data.js" */
import { channelOf, isNode, nodeOf, things } from "./graph.js";
import { element, make, state } from "./page.js";

/** @type {Record<string, [state: string, words: string]>} */
const LIVE = {
  missing: ["missing", "not there on the running robot"],
  dead: ["missing", "does not answer on the running robot"],
  extra: ["extra", "there on the running robot, though the launch file does not say so"],
  "wrong-type": ["wrong", "of another type on the running robot"],
  differs: ["wrong", "not as expected on the running robot"],
  inactive: ["normal", "a lifecycle node that is not active on the running robot"],
};

/** @param {SVGElement} part */
function liveOf(part) {
  if (isNode(part)) {
    return LIVE[state.live.nodes?.[nodeOf(part).name] ?? ""];
  }
  if (part.dataset.channel === undefined) {
    return undefined;
  }
  const { kind, name } = channelOf(part);
  return LIVE[state.live[/** @type {const} */ (`${kind}s`)]?.[name] ?? ""];
}

/** Marks what is not as launched. What runs and is not in the picture at all is told in words. */
export function compare() {
  const { graph, live } = state;
  for (const part of things()) {
    const own = isNode(part) ? nodeOf(part).state : channelOf(part).state;
    part.classList.remove("state-normal", "state-missing", "state-extra", "state-wrong");
    part.classList.add(`state-${liveOf(part)?.[0] ?? own}`);
  }
  const differing = new Set((live.issues ?? []).map(({ node, name, what }) => `${node} ${what} ${name}`));
  graph.routes.forEach((route, i) => {
    const isMarked = route.edges.some((edge) => {
      const { node, channel, role } = graph.edges[edge];
      return differing.has(`${graph.nodes[node].name} ${role} ${graph.channels[channel].name}`);
    });
    graph.routeParts[i].classList.toggle("differs", isMarked);
  });
  const drawnNodes = new Set(graph.nodes.map((node) => node.name));
  const nodes = Object.entries(live.nodes ?? {});
  const extra = nodes.filter(([name, how]) => how === "extra" && !drawnNodes.has(name)).map(([name]) => name);
  const gone = nodes.filter(([, how]) => how === "missing" || how === "dead").length;
  const words = [];
  if (gone > 0) {
    words.push(`${gone} of ${nodes.length - extra.length} nodes not there`);
  }
  if (extra.length > 0) {
    words.push(`also there: ${extra.slice(0, 5).join(", ")}${extra.length > 5 ? ", …" : ""}`);
  }
  const count = live.issues?.length ?? 0;
  element("differences").hidden = count === 0;
  element("differences").textContent = `${count} difference${count === 1 ? "" : "s"}`;
  element("live").hidden = live.nodes === undefined;
  element("live").textContent = `Running robot: ${words.join(", ") || "all nodes are there"}`;
}

/** @param {Issue} issue */
export const issueShown = ({ message, since }) => (since ? `${message} (since ${since})` : message);

/** @param {SVGElement} part */
export function liveShown(part) {
  const how = liveOf(part);
  const name = isNode(part) ? nodeOf(part).name : undefined;
  const channel = name === undefined && part.dataset.channel !== undefined ? channelOf(part).name : undefined;
  const issues = (state.live.issues ?? []).filter((issue) =>
    name !== undefined ? issue.node === name : channel !== undefined && issue.name === channel,
  );
  const lines = [...(how ? [how[1]] : []), ...issues.map(issueShown)];
  return lines.map((line) => make("p", { className: "live" }, line));
}
