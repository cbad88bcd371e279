// What is said of nodes, channels and lines: in the hint, and at length beside the picture.
/** @import {Edge, GraphNode, Place, Role} from "./data.js" */
import {
  channelKey,
  channelOf,
  edgesOf,
  edgesOfRoute,
  isFrame,
  isNode,
  nodeKey,
  nodeOf,
  TOWARDS,
  worst,
} from "./graph.js";
import { issueShown, liveShown } from "./live.js";
import { details, editor, go, hint, make, state, why } from "./page.js";

/** @type {Record<Role, string>} */
const DOES = {
  publisher: "publishes",
  subscriber: "subscribes",
  service: "serves",
  client: "calls",
  action_server: "serves",
  action_client: "calls",
};

/** @type {[Role, string][]} */
const SECTIONS = [
  ["publisher", "Publishers"],
  ["subscriber", "Subscribers"],
  ["service", "Service servers"],
  ["client", "Service clients"],
  ["action_server", "Action servers"],
  ["action_client", "Action clients"],
];

const ENDPOINTS = {
  topic: ["Publishers", "Subscribers"],
  service: ["Clients", "Servers"],
  action: ["Clients", "Servers"],
};

/** @param {number[]} indices */
const findingsShown = (indices) =>
  indices.map((i) => {
    const { rule, severity, message } = state.graph.findings[i];
    const head = make("b", { className: severity }, `${severity} ${rule}`);
    return make("p", { className: `finding ${severity}` }, head, ` ${message}`);
  });

/** @param {Record<string, unknown>} qos */
const qosShown = (qos) =>
  Object.entries(qos)
    .map(([policy, value]) => `${policy} ${typeof value === "string" ? value : JSON.stringify(value)}`)
    .join(", ");

/** @type {Record<string, string>} */
const KNOWN_BY = { similar: "a similar run", catalogue: "the catalogue" };

/** @param {GraphNode} node */
function nodeShown(node) {
  const what = [node.package, node.executable].filter(Boolean).join("/");
  const how =
    node.source === "none" ? "unknown interface" : `interface from ${KNOWN_BY[node.source] ?? `its ${node.source}`}`;
  return [
    make("p", { className: "dim" }, `${node.kind} ${what}, from ${state.graph.files[node.file].shown}`),
    make("p", { className: "dim" }, `${how}; ${node.outcome}${node.reason ? `: ${node.reason}` : ""}`),
  ];
}

/** @param {Edge} edge */
const edgeShown = (edge) =>
  [
    edge.type ?? "unknown type",
    qosShown(edge.qos),
    edge.from && `remapped from ${edge.from}`,
    edge.uncertain && "uncertain",
  ]
    .filter(Boolean)
    .join(" · ");

/** @param {SVGElement} part */
function said(part) {
  const { graph } = state;
  if (isFrame(part)) {
    const { name, nodes } = graph.frames[Number(part.dataset.frame)];
    const ranks = nodes.map((node) => worst(graph.nodes[node].findings)).filter((rank) => rank > 0);
    const wrong = ranks.length === 0 ? [] : [make("p", {}, `${ranks.length} of them with findings`)];
    const some = nodes.slice(0, 12).map((node) => make("p", { className: "dim" }, graph.nodes[node].name));
    return [make("b", {}, `namespace ${name}`), make("p", {}, `${nodes.length} nodes`), ...wrong, ...some];
  }
  if (isNode(part)) {
    const node = nodeOf(part);
    return [make("b", {}, node.name), ...liveShown(part), ...nodeShown(node), ...findingsShown(node.findings)];
  }
  if (part.dataset.channel !== undefined) {
    const channel = channelOf(part);
    const edges = edgesOf(part);
    const lines = edges.slice(0, 10).map((edge) => {
      const how = make("span", { className: "dim" }, edgeShown(edge));
      return make("p", {}, `${graph.nodes[edge.node].name} ${DOES[edge.role]} `, how);
    });
    const more = edges.length > 10 ? [make("p", { className: "dim" }, `and ${edges.length - 10} more`)] : [];
    const head = make("b", {}, `${channel.kind} ${channel.name}`);
    return [head, ...liveShown(part), ...lines, ...more, ...findingsShown(channel.findings)];
  }
  const edges = edgesOfRoute(part).map((i) => graph.edges[i]);
  const lines = edges
    .slice(0, 10)
    .map((edge) =>
      make(
        "p",
        {},
        make("b", {}, graph.nodes[edge.node].name),
        ` ${DOES[edge.role]} `,
        make("b", {}, graph.channels[edge.channel].name),
        " ",
        make("span", { className: "dim" }, edgeShown(edge)),
      ),
    );
  if (edges.length > 10) {
    lines.push(make("p", { className: "dim" }, `and ${edges.length - 10} more`));
  }
  return [...lines, ...findingsShown([...new Set(edges.flatMap((edge) => edge.findings))])];
}

/**
 * @param {SVGElement} part
 * @param {number} x where the pointer is
 * @param {number} y
 */
export function explain(part, x, y) {
  hint.replaceChildren(...said(part));
  hint.hidden = false;
  const box = hint.getBoundingClientRect();
  hint.style.left = `${Math.max(4, Math.min(x + 14, innerWidth - box.width - 6))}px`;
  hint.style.top = `${y + 18 + box.height > innerHeight ? Math.max(4, y - box.height - 10) : y + 18}px`;
}

/** @param {Place[]} list */
const places = (list) =>
  list.map((place) => {
    const text = `${place.shown}:${place.line}`;
    return editor === undefined
      ? make("p", { className: "dim" }, text)
      : make("p", {}, make("button", { type: "button", className: "place", onclick: () => go(place) }, text));
  });

/**
 * In an editor a button that explains why a node is connected, or not, over a channel.
 * @param {Edge} edge
 */
function whyShown(edge) {
  if (editor === undefined) {
    return [];
  }
  const { nodes, channels, edges, ofChannel } = state.graph;
  const ends = ofChannel[edge.channel].map((i) => edges[i]);
  const others = ends
    .filter((end) => TOWARDS.has(end.role) !== TOWARDS.has(edge.role))
    .map((end) => nodes[end.node].name);
  const { name } = nodes[edge.node];
  const ask = () => why(name, channels[edge.channel].name, [...new Set(others)]);
  const button = make("button", { type: "button", className: "place", onclick: ask }, "Explain");
  button.setAttribute("aria-label", `Explain the connection of ${name} over ${channels[edge.channel].name}`);
  return [make("p", {}, button)];
}

/**
 * @param {string} title
 * @param {Edge[]} edges
 * @param {"node" | "channel"} other which end of them is named
 * @param {(key: string) => void} onJump
 */
function section(title, edges, other, onJump) {
  const rows = edges.map((edge) => {
    const key = other === "node" ? nodeKey(edge.node) : channelKey(edge.channel);
    const { name } = other === "node" ? state.graph.nodes[edge.node] : state.graph.channels[edge.channel];
    const jump = make("button", { type: "button", className: "item", onclick: () => onJump(key) }, name);
    const how = make("p", { className: "dim" }, edgeShown(edge));
    return make("li", {}, jump, how, ...places(edge.places), ...whyShown(edge), ...findingsShown(edge.findings));
  });
  return rows.length === 0 ? [] : [make("h3", {}, `${title} (${rows.length})`), make("ul", {}, ...rows)];
}

/**
 * Lists beside the picture what is not as expected on the running robot.
 * @param {{close: () => void, jump: (key: string) => void}} on
 */
export function listDifferences(on) {
  const { graph, live } = state;
  const close = make("button", { type: "button", className: "close", onclick: on.close }, "✕");
  close.setAttribute("aria-label", "Close the list");
  const rows = (live.issues ?? []).map((issue) => {
    const at = graph.nodes.findIndex((node) => node.name === issue.node);
    const text = issueShown(issue);
    return at < 0
      ? make("li", {}, text)
      : make(
          "li",
          {},
          make("button", { type: "button", className: "item", onclick: () => on.jump(nodeKey(at)) }, issue.node),
          ` ${text}`,
        );
  });
  details.replaceChildren(close, make("h2", {}, "Differences on the running robot"), make("ul", {}, ...rows));
  details.hidden = false;
}

/**
 * Fills the details beside the picture.
 * @param {SVGElement} item
 * @param {{close: () => void, jump: (key: string) => void, focus: () => void}} on
 */
export function detail(item, on) {
  const close = make("button", { type: "button", className: "close", onclick: on.close }, "✕");
  close.setAttribute("aria-label", "Close the details");
  /** @type {HTMLElement[]} */
  const parts = [close];
  const alone = make(
    "button",
    { type: "button", className: "alone", onclick: on.focus },
    "Only this and its neighbours (f)",
  );
  const edges = edgesOf(item);
  if (isNode(item)) {
    const node = nodeOf(item);
    const ask = () => why(node.name, null, []);
    const asks = make("button", { type: "button", className: "alone", onclick: ask }, "Explain a connection");
    const buttons = editor === undefined ? [alone] : [alone, " ", asks];
    parts.push(make("h2", {}, node.name), ...nodeShown(node), make("p", {}, ...buttons));
    parts.push(...findingsShown(node.findings));
    parts.push(make("h3", {}, "Launched at"), ...places(node.places));
    for (const [role, title] of SECTIONS) {
      const own = edges.filter((edge) => edge.role === role);
      parts.push(...section(title, own, "channel", on.jump));
    }
  } else {
    const channel = channelOf(item);
    const [first, second] = ENDPOINTS[channel.kind];
    const from = channel.external ? ", used outside of the launch" : "";
    parts.push(make("h2", {}, channel.name), make("p", { className: "dim" }, `${channel.kind}${from}`), alone);
    parts.push(...[...channel.types, ...channel.notes].map((text) => make("p", {}, text)));
    parts.push(...findingsShown(channel.findings));
    for (const [title, isFirst] of /** @type {[string, boolean][]} */ ([
      [first, true],
      [second, false],
    ])) {
      const own = edges.filter((edge) => TOWARDS.has(edge.role) === isFirst);
      parts.push(...section(title, own, "node", on.jump));
    }
  }
  details.replaceChildren(...parts);
}
