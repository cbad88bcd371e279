// The running robot.
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
  element("live").hidden = live.nodes === undefined;
  element("live").textContent = `Running robot: ${words.join(", ") || "all nodes are there"}`;
}

/** @param {SVGElement} part */
export function liveShown(part) {
  const how = liveOf(part);
  const name = isNode(part) ? nodeOf(part).name : undefined;
  const issues = (state.live.issues ?? []).filter((issue) => issue.node === name);
  const lines = how ? [how[1], ...issues.map((issue) => issue.message)] : [];
  return lines.map((line) => make("p", { className: "live" }, line));
}
