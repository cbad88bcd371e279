// What is looked for.
/** @import {Kind, Shown} from "./data.js" */
import { channelKey, nodeKey, worst } from "./graph.js";
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

/**
 * What stays while one thing is looked at: it, what it is connected to, and what is at the other end of that.
 * @param {string} key
 */
function neighbourhood(key) {
  const { graph } = state;
  const node = new Set(graph.nodes.flatMap((_, i) => (nodeKey(i) === key ? [i] : [])));
  const channel = new Set(graph.channels.flatMap((_, i) => (channelKey(i) === key ? [i] : [])));
  for (const i of node) {
    for (const edge of graph.ofNode[i]) {
      channel.add(graph.edges[edge].channel);
    }
  }
  const isNode = node.size > 0;
  for (const i of channel) {
    if (!isNode || graph.ofChannel[i].length <= HUB) {
      for (const edge of graph.ofChannel[i]) {
        node.add(graph.edges[edge].node);
      }
    }
  }
  return { node, channel };
}

/**
 * Which nodes and channels are shown.
 * @returns {Shown}
 */
export function chosen() {
  const { graph } = state;
  const asked = terms(filter.value);
  const wanted = asked.filter((each) => !each.not);
  const unwanted = asked.filter((each) => each.not);
  const problems = input("problems").checked;
  const hides = input("only").checked;
  const near = state.focus === undefined ? undefined : neighbourhood(state.focus);
  /** @param {Kind} kind */
  const isOn = (kind) => input(`show-${kind}`).checked;
  /** @type {(kind: Kind | "node", name: string) => boolean} */
  const isOut = (kind, name) => unwanted.some((each) => each.fits(kind, name));
  /** @type {(kind: Kind | "node", name: string) => boolean} */
  const fits = (kind, name) => wanted.length === 0 || wanted.some((each) => each.fits(kind, name));
  const hidden = {
    node: graph.nodes.map((node, i) => isOut("node", node.name) || near?.node.has(i) === false),
    channel: graph.channels.map(
      (channel, i) => !isOn(channel.kind) || isOut(channel.kind, channel.name) || near?.channel.has(i) === false,
    ),
  };
  /** @param {number[]} findings */
  const isBad = (findings) => !problems || worst(findings) > 0;
  /** @type {number[]} */
  const node = graph.nodes.map((each, i) =>
    !hidden.node[i] && (!hides || fits("node", each.name)) && isBad(each.findings) ? 2 : 0,
  );
  /** @type {number[]} */
  const channel = graph.channels.map((each, i) =>
    !hidden.channel[i] && (!hides || fits(each.kind, each.name)) && isBad(each.findings) ? 2 : 0,
  );
  const matches =
    wanted.length === 0
      ? []
      : [
          ...graph.nodes.flatMap((each, i) => (node[i] === 2 && fits("node", each.name) ? [nodeKey(i)] : [])),
          ...graph.channels.flatMap((each, i) =>
            channel[i] === 2 && fits(each.kind, each.name) ? [channelKey(i)] : [],
          ),
        ];
  if ((wanted.length > 0 && hides) || problems) {
    const found = graph.edges.filter((edge) => !hidden.node[edge.node] && !hidden.channel[edge.channel]);
    const beside = { node: new Set(), channel: new Set() };
    for (const edge of found) {
      if (channel[edge.channel] === 2) {
        beside.node.add(edge.node);
      }
      if (node[edge.node] === 2 && !problems) {
        beside.channel.add(edge.channel);
      }
    }
    for (const edge of found) {
      if (beside.channel.has(edge.channel) && graph.ofChannel[edge.channel].length <= HUB) {
        beside.node.add(edge.node);
      }
    }
    for (const i of beside.node) {
      node[i] ||= 1;
    }
    for (const i of beside.channel) {
      channel[i] ||= 1;
    }
  }
  const all = unwanted.length === 0 && !(wanted.length > 0 && hides) && !problems && near === undefined;
  return { node, channel, all, matches };
}
