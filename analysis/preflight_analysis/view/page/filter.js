// What is looked for.
/** @import {Kind} from "./data.js" */
import { worst } from "./graph.js";
import { filter, input, state } from "./page.js";

/** Of a topic with more ends, the other ends are no neighbours: /tf would show everything. */
const HUB = 12;

/**
 * A part of a name, or a pattern with `*` and `?`; `ns:`, `node:` and so on before it, `-` for what is left out.
 * @param {string} text
 */
function terms(text) {
  return text.split(/\s+/).filter(Boolean).map(term);
}

/** @param {string} word */
function term(word) {
  const [, not, kind, wanted] = /** @type {string[]} */ (
    /** @type {unknown} */ (/^(-?)(?:(ns|node|topic|service|action):)?(.*)$/.exec(word))
  );
  const low = wanted.toLowerCase();
  const pattern = /[*?]/.test(low)
    ? new RegExp(
        `^${/^[/*]/.test(low) ? "" : "(?:.*/)?"}${low
          .replace(/[.+^${}()|[\]\\]/g, "\\$&")
          .replace(/\*/g, ".*")
          .replace(/\?/g, ".")}$`,
      )
    : undefined;
  const folder = `/${low.replace(/^\/+|\/+$/g, "")}/`.replace(/^\/\/$/, "/");
  return {
    not: not !== "",
    /**
     * @param {Kind | "node"} of
     * @param {string} name
     */
    fits(of, name) {
      const text = name.toLowerCase();
      if (kind === "ns") {
        return pattern ? pattern.test(text.slice(0, text.lastIndexOf("/")) || "/") : text.startsWith(folder);
      }
      return (kind === undefined || kind === of) && (pattern ? pattern.test(text) : text.includes(low));
    },
  };
}

/** Which nodes and channels are shown: 2 for what is looked for, 1 for what it is connected to, 0 for nothing. */
export function chosen() {
  const { graph } = state;
  const asked = terms(filter.value);
  const wanted = asked.filter((each) => !each.not);
  const unwanted = asked.filter((each) => each.not);
  const problems = input("problems").checked;
  /** @param {Kind} kind */
  const isOn = (kind) => input(`show-${kind}`).checked;
  /** @type {(kind: Kind | "node", name: string) => boolean} */
  const isOut = (kind, name) => unwanted.some((each) => each.fits(kind, name));
  /** @type {(kind: Kind | "node", name: string) => boolean} */
  const fits = (kind, name) => wanted.length === 0 || wanted.some((each) => each.fits(kind, name));
  const hidden = {
    node: graph.nodes.map((node) => isOut("node", node.name)),
    channel: graph.channels.map((channel) => !isOn(channel.kind) || isOut(channel.kind, channel.name)),
  };
  /** @param {number[]} findings */
  const isBad = (findings) => !problems || worst(findings) > 0;
  /** @type {number[]} */
  const node = graph.nodes.map((each, i) =>
    !hidden.node[i] && fits("node", each.name) && isBad(each.findings) ? 2 : 0,
  );
  /** @type {number[]} */
  const channel = graph.channels.map((each, i) =>
    !hidden.channel[i] && fits(each.kind, each.name) && isBad(each.findings) ? 2 : 0,
  );
  if (wanted.length > 0 || problems) {
    const found = graph.edges.filter((edge) => !hidden.node[edge.node] && !hidden.channel[edge.channel]);
    const near = { node: new Set(), channel: new Set() };
    for (const edge of found) {
      if (channel[edge.channel] === 2) {
        near.node.add(edge.node);
      }
      if (node[edge.node] === 2 && !problems) {
        near.channel.add(edge.channel);
      }
    }
    for (const edge of found) {
      if (near.channel.has(edge.channel) && graph.ofChannel[edge.channel].length <= HUB) {
        near.node.add(edge.node);
      }
    }
    for (const i of near.node) {
      node[i] ||= 1;
    }
    for (const i of near.channel) {
      channel[i] ||= 1;
    }
  }
  return { node, channel, all: asked.length === 0 && !problems };
}
