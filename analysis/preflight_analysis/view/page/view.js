// Makes the picture of the graph one to walk in: filter, hover, keyboard, zoom. The same in the page of
// `ros-preflight graph --format html`, which holds its data, and in an editor, which sends it.

(() => {
  /** Of a topic with more ends, the other ends are no neighbours: /tf would show everything. */
  const HUB = 12;
  const CORNER = 6;
  const ARROW = 7;
  const AIR = { box: 14, line: 5 };
  const RANKS = ["hint", "info", "warning", "error"];
  const TOWARDS = new Set(["publisher", "client", "action_client"]);
  const DOES = {
    publisher: "publishes",
    subscriber: "subscribes",
    service: "serves",
    client: "calls",
    action_server: "serves",
    action_client: "calls",
  };
  const element = (id) => document.getElementById(id);
  const canvas = element("canvas");
  const hint = element("hint");
  const details = element("details");
  const filter = element("filter");
  const editor = typeof acquireVsCodeApi === "function" ? acquireVsCodeApi() : undefined;
  const saved = editor?.getState() ?? {};

  /** What is shown: the server's data, and per position what hangs on what. */
  let graph;
  let svg;
  let pictures = {};
  /** As the user set it; else all of it is shown, down to what can be read. */
  let zoom = saved.zoom;
  let least = 0.55;
  let selected = saved.selected;
  /** What is the case on the running robot, by kind and name, while it is watched. */
  let live = {};
  /** Maps a coordinate of the layout to where it is drawn. */
  let drawn = { x: (value) => value, y: (value) => value, width: 0, height: 0 };

  // What is shown

  function show(next) {
    const first = graph === undefined;
    const focused = document.activeElement?.closest?.("[data-node],[data-channel]");
    const held = focused && canvas.contains(focused) ? keyOf(focused) : undefined;
    graph = index(next);
    const title = element("title");
    title.replaceChildren(make("bdi", {}, graph.title));
    title.title = graph.root;
    document.title = `${graph.title} – ROS graph`;
    const parsed = new DOMParser().parseFromString(graph.svg, "image/svg+xml").documentElement;
    svg = document.importNode(parsed, true);
    canvas.replaceChildren(svg);
    graph.items = new Map();
    for (const item of svg.querySelectorAll("[data-node],[data-channel]")) {
      item.setAttribute("tabindex", "-1");
      item.setAttribute("role", "button");
      graph.items.set(keyOf(item), item);
    }
    graph.boxParts = [...svg.querySelectorAll("[data-box]")];
    graph.routeParts = [...svg.querySelectorAll("[data-route]")];
    for (const kind of ["topic", "service", "action"]) {
      element(`show-${kind}`).parentElement.hidden = !graph.channels.some((channel) => channel.kind === kind);
    }
    legend();
    compare();
    arrange();
    select(graph.items.has(selected) ? selected : undefined, false);
    graph.items.get(held)?.focus({ preventScroll: true });
    if (first) {
      // At the left, where messages come from; above it there may be nothing.
      const begin = graph.boxes.reduce((a, b) => (b.x < a.x ? b : a), graph.boxes[0]);
      canvas.scrollTo(saved.left ?? 0, saved.top ?? (begin ? begin.y * magnification() - canvas.clientHeight / 2 : 0));
    }
  }

  function index(data) {
    const found = { ...data, ofNode: data.nodes.map(() => []), ofChannel: data.channels.map(() => []) };
    data.edges.forEach((edge, i) => {
      found.ofNode[edge.node].push(i);
      found.ofChannel[edge.channel].push(i);
    });
    found.boxOfNode = new Map();
    found.boxOfChannel = new Map();
    data.boxes.forEach((box, i) => {
      if (box.node !== undefined) {
        found.boxOfNode.set(box.node, i);
      }
      box.channels?.forEach((channel) => found.boxOfChannel.set(channel, i));
    });
    return found;
  }

  const keyOf = (item) =>
    item.dataset.node !== undefined
      ? `node ${graph.nodes[item.dataset.node].name}#${item.dataset.node}`
      : channelKey(Number(item.dataset.channel));
  const nodeKey = (node) => `node ${graph.nodes[node].name}#${node}`;
  const channelKey = (channel) => `${graph.channels[channel].kind} ${graph.channels[channel].name}`;
  const worst = (findings) => Math.max(-1, ...findings.map((i) => RANKS.indexOf(graph.findings[i].severity)));

  // Filter

  /** A part of a name, or a pattern with `*` and `?`; `ns:`, `node:` and so on before it, `-` for what is left out. */
  function terms(text) {
    return text
      .split(/\s+/)
      .filter(Boolean)
      .map((word) => {
        const [, not, kind, wanted] = /^(-?)(?:(ns|node|topic|service|action):)?(.*)$/.exec(word);
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
          fits(of, name) {
            const text = name.toLowerCase();
            if (kind === "ns") {
              return pattern ? pattern.test(text.slice(0, text.lastIndexOf("/")) || "/") : text.startsWith(folder);
            }
            return (kind === undefined || kind === of) && (pattern ? pattern.test(text) : text.includes(low));
          },
        };
      });
  }

  /** Which nodes and channels are shown: 2 for what is looked for, 1 for what it is connected to, 0 for nothing. */
  function chosen() {
    const asked = terms(filter.value);
    const wanted = asked.filter((term) => !term.not);
    const unwanted = asked.filter((term) => term.not);
    const open = (kind) => element(`show-${kind}`).checked;
    const problems = element("problems").checked;
    const out = (kind, name) => unwanted.some((term) => term.fits(kind, name));
    const fits = (kind, name) => wanted.length === 0 || wanted.some((term) => term.fits(kind, name));
    const hidden = {
      node: graph.nodes.map((node) => out("node", node.name)),
      channel: graph.channels.map((channel) => !open(channel.kind) || out(channel.kind, channel.name)),
    };
    const bad = (findings) => !problems || worst(findings) > 0;
    const node = graph.nodes.map((each, i) =>
      !hidden.node[i] && fits("node", each.name) && bad(each.findings) ? 2 : 0,
    );
    const channel = graph.channels.map((each, i) =>
      !hidden.channel[i] && fits(each.kind, each.name) && bad(each.findings) ? 2 : 0,
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
      near.node.forEach((i) => (node[i] ||= 1));
      near.channel.forEach((i) => (channel[i] ||= 1));
    }
    return { node, channel, all: asked.length === 0 && !problems };
  }

  /** Hides what is not looked for and draws the rest together, each thing on its own side of the others as before. */
  function arrange() {
    const shown = chosen();
    const boxes = graph.boxes.map((box) =>
      box.node !== undefined
        ? shown.node[box.node]
        : Math.max(...box.channels.map((channel) => shown.channel[channel])),
    );
    const routes = graph.routes.map((route) => boxes[route.source] > 0 && boxes[route.target] > 0);
    const isAll = boxes.every((each) => each > 0);
    drawn = isAll
      ? { x: (value) => value, y: (value) => value, width: graph.width, height: graph.height }
      : drawnTogether(boxes, routes);
    graph.boxParts.forEach((part, i) => {
      const box = graph.boxes[i];
      part.classList.toggle("off", boxes[i] === 0);
      part.classList.toggle("context", box.node !== undefined && boxes[i] === 1);
      part.setAttribute("transform", `translate(${drawn.x(box.x)} ${drawn.y(box.y)})`);
    });
    graph.channels.forEach((_, i) => {
      graph.items.get(channelKey(i)).classList.toggle("context", shown.channel[i] === 0);
    });
    graph.routeParts.forEach((part, i) => {
      part.classList.toggle("off", !routes[i]);
      if (routes[i]) {
        const [line, arrow] = outline(graph.routes[i].points.map(([x, y]) => [drawn.x(x), drawn.y(y)]));
        part.querySelector(".line").setAttribute("d", line);
        part.querySelector(".wide").setAttribute("d", line);
        part.querySelector(".arrow").setAttribute("d", arrow);
      }
    });
    svg.setAttribute("viewBox", `0 0 ${drawn.width} ${drawn.height}`);
    graph.shown = { boxes, routes };
    scale();
    const count = (list) => list.filter((each) => each === 2).length;
    const nodes = count(shown.node);
    const channels = count(shown.channel);
    filter.classList.toggle("nothing", nodes + channels === 0 && !shown.all);
    const of = (shownOnes, all, what) => `${shown.all && isAll ? "" : `${shownOnes} of `}${all} ${what}`;
    const named = graph.channels.every((channel) => channel.kind === "topic")
      ? "topics"
      : "topics, services and actions";
    element("status").textContent =
      `${of(nodes, graph.nodes.length, "nodes")}, ${of(channels, graph.channels.length, named)}`.replace(
        /\b1 (node|topic)s\b/g,
        "1 $1",
      );
    walkable();
  }

  /** Takes the room out of the picture that nothing shown stands in, without changing any order. */
  function drawnTogether(boxes, routes) {
    const taken = { x: [], y: [] };
    graph.boxes.forEach((box, i) => {
      if (boxes[i] > 0) {
        taken.x.push([box.x - AIR.box, box.x + box.width + AIR.box]);
        taken.y.push([box.y - AIR.box, box.y + box.height + AIR.box]);
      }
    });
    graph.routes.forEach((route, i) => {
      if (routes[i]) {
        for (const [x, y] of route.points) {
          taken.x.push([x - AIR.line, x + AIR.line]);
          taken.y.push([y - AIR.line, y + AIR.line]);
        }
      }
    });
    const [x, width] = closedUp(taken.x);
    const [y, height] = closedUp(taken.y);
    return { x, y, width, height };
  }

  function closedUp(intervals) {
    const merged = [];
    for (const [from, to] of intervals.sort((a, b) => a[0] - b[0])) {
      const last = merged.at(-1);
      if (last && from <= last.to) {
        last.to = Math.max(last.to, to);
      } else {
        merged.push({ from, to });
      }
    }
    let end = 10;
    for (const each of merged) {
      each.at = end;
      end += each.to - each.from;
    }
    return [
      (value) => {
        const inside = merged.find((each) => value <= each.to);
        return inside === undefined ? end : Math.round((inside.at + Math.max(0, value - inside.from)) * 10) / 10;
      },
      end + 10,
    ];
  }

  /** The paths of a line with rounded corners and of its arrow, as `outline` in svg.py. */
  function outline(points) {
    const tip = points.at(-1);
    const [x, y] = points.at(-2);
    const length = Math.hypot(tip[0] - x, tip[1] - y) || 1;
    const [dx, dy] = [(tip[0] - x) / length, (tip[1] - y) / length];
    const neck = [tip[0] - dx * Math.min(ARROW, length), tip[1] - dy * Math.min(ARROW, length)];
    const towards = ([fromX, fromY], [toX, toY]) => {
      const far = Math.hypot(toX - fromX, toY - fromY) || 1;
      const part = Math.min(CORNER, far / 2) / far;
      return [fromX + (toX - fromX) * part, fromY + (toY - fromY) * part];
    };
    const at = ([pointX, pointY]) => `${Math.round(pointX * 10) / 10} ${Math.round(pointY * 10) / 10}`;
    let line = `M${at(points[0])}`;
    for (let i = 1; i < points.length - 1; i += 1) {
      const after = i + 2 < points.length ? points[i + 1] : neck;
      line += `L${at(towards(points[i], points[i - 1]))}Q${at(points[i])} ${at(towards(points[i], after))}`;
    }
    const half = ARROW / 2;
    const sides = [
      [neck[0] - dy * half, neck[1] + dx * half],
      [neck[0] + dy * half, neck[1] - dx * half],
    ];
    return [`${line}L${at(neck)}`, `M${at(tip)}L${at(sides[0])}L${at(sides[1])}z`];
  }

  // Zoom

  const magnification = () =>
    zoom ??
    Math.min(
      1.25,
      Math.max(least, Math.min((canvas.clientWidth - 4) / drawn.width, (canvas.clientHeight - 4) / drawn.height)),
    );

  function scale() {
    const by = magnification();
    svg.setAttribute("width", drawn.width * by);
    svg.setAttribute("height", drawn.height * by);
  }

  function fit() {
    zoom = undefined;
    least = 0.08;
    scale();
    remember();
  }

  function zoomTo(next, at) {
    const box = canvas.getBoundingClientRect();
    const point = at ?? { x: box.left + box.width / 2, y: box.top + box.height / 2 };
    const before = svg.getBoundingClientRect();
    const [partX, partY] = [(point.x - before.left) / before.width, (point.y - before.top) / before.height];
    zoom = Math.min(3, Math.max(0.08, next));
    scale();
    const after = svg.getBoundingClientRect();
    canvas.scrollBy(after.left + partX * after.width - point.x, after.top + partY * after.height - point.y);
    remember();
  }

  // The running robot

  const LIVE = {
    missing: ["missing", "not there on the running robot"],
    dead: ["missing", "does not answer on the running robot"],
    extra: ["extra", "there on the running robot, though the launch file does not say so"],
    "wrong-type": ["wrong", "of another type on the running robot"],
    differs: ["wrong", "not as expected on the running robot"],
    inactive: ["normal", "a lifecycle node that is not active on the running robot"],
  };

  const liveOf = (part) =>
    part.dataset.node !== undefined
      ? live.nodes?.[graph.nodes[part.dataset.node].name]
      : live[`${graph.channels[part.dataset.channel].kind}s`]?.[graph.channels[part.dataset.channel].name];

  /** Marks what is not as launched. What runs and is not in the picture at all is told in words. */
  function compare() {
    for (const part of graph.items.values()) {
      const own =
        part.dataset.node !== undefined
          ? graph.nodes[part.dataset.node].state
          : graph.channels[part.dataset.channel].state;
      part.classList.remove("state-normal", "state-missing", "state-extra", "state-wrong");
      part.classList.add(`state-${LIVE[liveOf(part)]?.[0] ?? own}`);
    }
    const drawnNodes = new Set(graph.nodes.map((node) => node.name));
    const extra = Object.entries(live.nodes ?? {}).filter(
      ([name, state]) => state === "extra" && !drawnNodes.has(name),
    );
    const states = Object.values(live.nodes ?? {});
    const gone = states.filter((state) => state === "missing" || state === "dead").length;
    element("live").hidden = live.nodes === undefined;
    element("live").textContent =
      `Running robot: ${gone === 0 && extra.length === 0 ? "all nodes are there" : ""}${gone > 0 ? `${gone} of ${states.length - extra.length} nodes not there` : ""}${gone > 0 && extra.length > 0 ? ", " : ""}${
        extra.length > 0
          ? `also there: ${extra
              .map(([name]) => name)
              .slice(0, 5)
              .join(", ")}${extra.length > 5 ? ", …" : ""}`
          : ""
      }`;
  }

  function liveShown(part) {
    const state = LIVE[liveOf(part)];
    const name = part.dataset.node !== undefined ? graph.nodes[part.dataset.node].name : undefined;
    const issues = (live.issues ?? []).filter((issue) => issue.node === name);
    const lines = state ? [state[1], ...issues.map((issue) => issue.message)] : [];
    return lines.map((line) => make("p", { className: "live" }, line));
  }

  // What hangs on what, for hover and details

  function neighbours(item) {
    const near = { boxes: new Set([item]), routes: new Set() };
    const of =
      item.dataset.node !== undefined ? graph.ofNode[item.dataset.node] : graph.ofChannel[item.dataset.channel];
    const edges = new Set(of);
    graph.routes.forEach((route, i) => {
      if (route.edges.some((edge) => edges.has(edge))) {
        near.routes.add(graph.routeParts[i]);
      }
    });
    for (const edge of of) {
      near.boxes.add(graph.items.get(nodeKey(graph.edges[edge].node)));
      near.boxes.add(graph.items.get(channelKey(graph.edges[edge].channel)));
    }
    return near;
  }

  function light(item) {
    svg.querySelectorAll(".near").forEach((part) => part.classList.remove("near"));
    svg.classList.toggle("lit", item !== undefined);
    if (item?.dataset.route !== undefined) {
      const route = graph.routes[item.dataset.route];
      item.classList.add("near");
      for (const edge of route.edges) {
        graph.items.get(nodeKey(graph.edges[edge].node)).classList.add("near");
        graph.items.get(channelKey(graph.edges[edge].channel)).classList.add("near");
      }
    } else if (item !== undefined) {
      const near = neighbours(item);
      near.boxes.forEach((part) => part.classList.add("near"));
      near.routes.forEach((part) => part.classList.add("near"));
    }
  }

  function make(name, attributes, ...children) {
    const made = document.createElement(name);
    Object.assign(made, attributes);
    made.append(...children);
    return made;
  }

  const findingsShown = (indices) =>
    indices.map((i) => {
      const { rule, severity, message } = graph.findings[i];
      return make(
        "p",
        { className: `finding ${severity}` },
        make("b", { className: severity }, `${severity} ${rule}`),
        ` ${message}`,
      );
    });

  const qosShown = (qos) =>
    Object.entries(qos)
      .map(([policy, value]) => `${policy} ${typeof value === "string" ? value : JSON.stringify(value)}`)
      .join(", ");

  function nodeShown(node) {
    const what = [node.package, node.executable].filter(Boolean).join("/");
    const how =
      node.source === "none"
        ? "what it does is not known"
        : `known by ${node.source === "similar" ? "a similar run" : `its ${node.source}`}`;
    return [
      make("p", { className: "dim" }, `${node.kind} ${what}, from ${graph.files[node.file].shown}`),
      make("p", { className: "dim" }, `${how}; ${node.outcome}${node.reason ? `: ${node.reason}` : ""}`),
    ];
  }

  const edgeShown = (edge) =>
    [
      edge.type ?? "type not known",
      qosShown(edge.qos),
      edge.from && `remapped from ${edge.from}`,
      edge.uncertain && "not sure",
    ]
      .filter(Boolean)
      .join(" · ");

  function said(item) {
    if (item.dataset.node !== undefined) {
      const node = graph.nodes[item.dataset.node];
      return [make("b", {}, node.name), ...liveShown(item), ...nodeShown(node), ...findingsShown(node.findings)];
    }
    if (item.dataset.channel !== undefined) {
      const channel = graph.channels[item.dataset.channel];
      const ends = graph.ofChannel[item.dataset.channel].map((i) => graph.edges[i]);
      const lines = ends
        .slice(0, 10)
        .map((edge) =>
          make(
            "p",
            {},
            `${graph.nodes[edge.node].name} ${DOES[edge.role]} `,
            make("span", { className: "dim" }, edgeShown(edge)),
          ),
        );
      const more = ends.length > 10 ? [make("p", { className: "dim" }, `and ${ends.length - 10} more`)] : [];
      return [
        make("b", {}, `${channel.kind} ${channel.name}`),
        ...liveShown(item),
        ...lines,
        ...more,
        ...findingsShown(channel.findings),
      ];
    }
    const edges = graph.routes[item.dataset.route].edges.map((i) => graph.edges[i]);
    const lines = edges.map((edge) =>
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
    return [...lines, ...findingsShown([...new Set(edges.flatMap((edge) => edge.findings))])];
  }

  function explain(item, x, y) {
    hint.replaceChildren(...said(item));
    hint.hidden = false;
    const box = hint.getBoundingClientRect();
    hint.style.left = `${Math.max(4, Math.min(x + 14, innerWidth - box.width - 6))}px`;
    hint.style.top = `${y + 18 + box.height > innerHeight ? Math.max(4, y - box.height - 10) : y + 18}px`;
  }

  const places = (list) =>
    list.map((place) => {
      const text = `${place.shown}:${place.line}`;
      return editor === undefined
        ? make("p", { className: "dim" }, text)
        : make("p", {}, make("button", { type: "button", className: "place", onclick: () => go(place) }, text));
    });

  function detail(item) {
    const list = (title, edges, other) => {
      const rows = edges.map((edge) => {
        const key = other === "node" ? nodeKey(edge.node) : channelKey(edge.channel);
        const name = other === "node" ? graph.nodes[edge.node].name : graph.channels[edge.channel].name;
        const jump = make(
          "button",
          { type: "button", className: "item", onclick: () => walkTo(graph.items.get(key)) },
          name,
        );
        return make(
          "li",
          {},
          jump,
          make("p", { className: "dim" }, edgeShown(edge)),
          ...places(edge.places),
          ...findingsShown(edge.findings),
        );
      });
      return rows.length === 0 ? [] : [make("h3", {}, `${title} (${rows.length})`), make("ul", {}, ...rows)];
    };
    const close = make("button", { type: "button", className: "close", onclick: () => select(undefined) }, "✕");
    close.setAttribute("aria-label", "Close the details");
    const parts = [close];
    if (item.dataset.node !== undefined) {
      const node = graph.nodes[item.dataset.node];
      const edges = graph.ofNode[item.dataset.node].map((i) => graph.edges[i]);
      parts.push(make("h2", {}, node.name), ...nodeShown(node), ...findingsShown(node.findings));
      parts.push(make("h3", {}, "Launched at"), ...places(node.places));
      for (const [role, title] of Object.entries({
        publisher: "Publishes",
        subscriber: "Subscribes to",
        service: "Services",
        client: "Calls",
        action_server: "Actions",
        action_client: "Client of actions",
      })) {
        parts.push(
          ...list(
            title,
            edges.filter((edge) => edge.role === role),
            "channel",
          ),
        );
      }
    } else {
      const channel = graph.channels[item.dataset.channel];
      const edges = graph.ofChannel[item.dataset.channel].map((i) => graph.edges[i]);
      const towards = (edge) => TOWARDS.has(edge.role);
      const [first, second] = {
        topic: ["Publishers", "Subscribers"],
        service: ["Clients", "Servers"],
        action: ["Clients", "Servers"],
      }[channel.kind];
      parts.push(
        make("h2", {}, channel.name),
        make(
          "p",
          { className: "dim" },
          `${channel.kind}${channel.external ? ", used from outside of the launch" : ""}`,
        ),
      );
      parts.push(...channel.types.map((type) => make("p", {}, type)), ...findingsShown(channel.findings));
      parts.push(
        ...list(first, edges.filter(towards), "node"),
        ...list(
          second,
          edges.filter((edge) => !towards(edge)),
          "node",
        ),
      );
    }
    details.replaceChildren(...parts);
  }

  function select(key, showsDetails = true) {
    svg.querySelectorAll(".selected").forEach((part) => part.classList.remove("selected"));
    selected = key;
    const item = graph.items.get(key);
    item?.classList.add("selected");
    if (item === undefined || showsDetails || !details.hidden) {
      details.hidden = item === undefined;
      if (item !== undefined) {
        detail(item);
      }
    }
    remember();
  }

  // Where the click and Enter lead: to the line that makes it

  function go(place) {
    editor?.postMessage({ type: "open", file: place.file, line: place.line, column: place.column });
  }

  function open(item) {
    if (item.dataset.route !== undefined) {
      const edge = graph.edges[graph.routes[item.dataset.route].edges[0]];
      select(channelKey(edge.channel));
      go(edge.places[0]);
      return;
    }
    select(keyOf(item));
    if (item.dataset.node !== undefined) {
      go(graph.nodes[item.dataset.node].places[0]);
      return;
    }
    const ends = graph.ofChannel[item.dataset.channel].map((i) => graph.edges[i]);
    const offers = ["publisher", "service", "action_server"];
    go((ends.find((edge) => offers.includes(edge.role)) ?? ends[0]).places[0]);
  }

  // Keyboard

  const isShown = (item) => item !== undefined && item.closest(".off") === null;

  /** One thing of the picture is in the order of Tab; arrows lead on from there. */
  function walkable() {
    const items = [...graph.items.values()];
    const current = items.find((item) => item.getAttribute("tabindex") === "0" && isShown(item)) ?? items.find(isShown);
    items.forEach((item) => item.setAttribute("tabindex", item === current ? "0" : "-1"));
  }

  function walkTo(item) {
    if (!isShown(item)) {
      return;
    }
    graph.items.forEach((each) => each.setAttribute("tabindex", each === item ? "0" : "-1"));
    item.focus({ preventScroll: true });
    item.scrollIntoView({ block: "nearest", inline: "nearest" });
    light(item);
    if (!details.hidden) {
      select(keyOf(item));
    }
  }

  function step(item, key) {
    const box = (of) => of.querySelector("rect").getBoundingClientRect();
    const here = box(item);
    const middle = (rect) => [rect.left + rect.width / 2, rect.top + rect.height / 2];
    const [x, y] = middle(here);
    if (key === "ArrowLeft" || key === "ArrowRight") {
      // Along the edges, with the messages or against them.
      const isNode = item.dataset.node !== undefined;
      const of = isNode ? graph.ofNode[item.dataset.node] : graph.ofChannel[item.dataset.channel];
      return of
        .map((i) => graph.edges[i])
        .filter((edge) => (TOWARDS.has(edge.role) === isNode) === (key === "ArrowRight"))
        .map((edge) => graph.items.get(isNode ? channelKey(edge.channel) : nodeKey(edge.node)))
        .filter(isShown)
        .map((to) => [Math.abs(middle(box(to))[1] - y), to])
        .sort((a, b) => a[0] - b[0])[0]?.[1];
    }
    const sign = key === "ArrowDown" ? 1 : -1;
    const others = [...graph.items.values()].filter((to) => to !== item && isShown(to));
    const ahead = others.map((to) => [middle(box(to)), to]).filter(([[, toY]]) => (toY - y) * sign > 1);
    // The nearest ahead; what stands aside counts as farther away.
    return ahead
      .map(([[toX, toY], to]) => [Math.abs(toY - y) + 3 * Math.abs(toX - x), to])
      .sort((a, b) => a[0] - b[0])[0]?.[1];
  }

  document.addEventListener("keydown", (event) => {
    const typing = event.target.matches?.("input[type=search]");
    const item = event.target.closest?.("[data-node],[data-channel]");
    if (event.key === "Escape") {
      hint.hidden = true;
      if (!details.hidden) {
        const back = graph?.items.get(selected);
        select(undefined);
        back?.focus({ preventScroll: true });
      } else if (filter.value !== "") {
        filter.value = "";
        arrange();
        remember();
      } else if (typing) {
        walkTo([...graph.items.values()].find((each) => each.getAttribute("tabindex") === "0"));
      }
      light(undefined);
    } else if (typing) {
      if (event.key === "Enter" || event.key === "ArrowDown") {
        walkTo([...graph.items.values()].find((each) => isShown(each) && !each.closest(".context")));
        event.preventDefault();
      }
      return;
    } else if (event.ctrlKey || event.metaKey || event.altKey || graph === undefined) {
      return;
    } else if (event.key === "/") {
      filter.focus();
      filter.select();
    } else if (event.key === "+" || event.key === "=") {
      zoomTo(magnification() * 1.25);
    } else if (event.key === "-") {
      zoomTo(magnification() / 1.25);
    } else if (event.key === "0") {
      fit();
    } else if (item && event.key.startsWith("Arrow")) {
      walkTo(step(item, event.key));
    } else if (item && event.key === "Enter") {
      open(item);
    } else if (item && event.key === " ") {
      select(keyOf(item));
    } else {
      return;
    }
    event.preventDefault();
  });

  // Mouse

  const partAt = (event) => event.target.closest?.("[data-node],[data-channel],[data-route]");
  let drag;
  canvas.addEventListener("pointerdown", (event) => {
    drag =
      event.button === 0
        ? { x: event.clientX, y: event.clientY, left: canvas.scrollLeft, top: canvas.scrollTop, far: false }
        : undefined;
  });
  addEventListener("pointermove", (event) => {
    if (drag === undefined || event.buttons === 0) {
      drag = event.buttons === 0 ? undefined : drag;
      return;
    }
    const [x, y] = [event.clientX - drag.x, event.clientY - drag.y];
    drag.far ||= Math.hypot(x, y) > 5;
    if (drag.far) {
      canvas.classList.add("dragged");
      hint.hidden = true;
      canvas.scrollTo(drag.left - x, drag.top - y);
    }
  });
  addEventListener("pointerup", () => canvas.classList.remove("dragged"));
  canvas.addEventListener("click", (event) => {
    const part = partAt(event);
    if (drag?.far) {
      drag = undefined;
    } else if (part) {
      graph.items.forEach((each) => each.setAttribute("tabindex", each === part ? "0" : "-1"));
      walkable();
      open(part);
    } else {
      select(undefined);
    }
  });
  canvas.addEventListener("pointerover", (event) => {
    const part = drag?.far ? undefined : partAt(event);
    if (part) {
      light(part);
      explain(part, event.clientX, event.clientY);
    }
  });
  canvas.addEventListener("pointerout", (event) => {
    if (partAt(event)) {
      hint.hidden = true;
      light(undefined);
    }
  });
  canvas.addEventListener("focusin", (event) => {
    if (event.target.matches(":focus-visible") && event.target.closest("[data-node],[data-channel]")) {
      light(event.target);
    }
  });
  canvas.addEventListener("focusout", () => light(undefined));
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (event.ctrlKey || event.metaKey) {
        event.preventDefault();
        zoomTo(magnification() * Math.exp(-event.deltaY / 400), { x: event.clientX, y: event.clientY });
      }
    },
    { passive: false },
  );
  canvas.addEventListener("scrollend", () => remember());

  // The rest of the page

  function legend() {
    const picture = (inside) => {
      const parsed = new DOMParser().parseFromString(
        `<svg xmlns="http://www.w3.org/2000/svg" class="graph" width="22" height="20" aria-hidden="true">${inside}</svg>`,
        "image/svg+xml",
      );
      return document.importNode(parsed.documentElement, true);
    };
    const rows = [];
    const row = (inside, ...text) => {
      const made = make("span", {}, picture(inside), ...text);
      made.setAttribute("role", "listitem");
      rows.push(made);
    };
    const icons = {
      topic: '<circle class="icon" cx="14" cy="10" r="4"/>',
      service: '<path class="icon" d="M14 5l5 5-5 5-5-5z"/>',
      action: '<path class="icon" d="M10 5l9 5-9 5z"/>',
    };
    for (const kind of Object.keys(icons).filter((each) => graph.channels.some((channel) => channel.kind === each))) {
      row(`<g class="channel ${kind}">${icons[kind]}</g>`, kind);
    }
    if (svg.querySelector(".dangling")) {
      row(`<g class="channel topic dangling">${icons.topic}</g>`, "one side only");
    }
    for (const severity of ["error", "warning", "info"].filter((each) =>
      graph.findings.some((finding) => finding.severity === each),
    )) {
      row(`<g class="route ${severity}"><path class="line" d="M2 10h18"/></g>`, severity);
    }
    if (graph.edges.some((edge) => edge.uncertain)) {
      row('<g class="route topic uncertain"><path class="line" d="M2 10h18"/></g>', "not sure");
    }
    const starting = new Set(graph.nodes.map((node) => node.file));
    graph.files.forEach((file, i) => {
      if (starting.has(i)) {
        row(`<rect class="accent f${i % 6}" x="6" y="4" width="12" height="12" rx="3"/>`, file.shown);
      }
    });
    element("legend").replaceChildren(...rows);
  }

  function save() {
    const copy = svg.cloneNode(true);
    copy.querySelectorAll(".off").forEach((part) => part.remove());
    copy.setAttribute("width", drawn.width);
    copy.setAttribute("height", drawn.height);
    copy.classList.remove("lit");
    const style = document.createElementNS("http://www.w3.org/2000/svg", "style");
    // A file has no editor around it: the colours of this moment.
    const colours = getComputedStyle(document.documentElement);
    const names = [...new Set(element("drawing").textContent.match(/--[a-z0-9]+(?=:)/g))].filter(
      (name) => name !== "--line",
    );
    const rules = element("drawing").textContent.replace(
      /^:root \{[^}]*\}|^@media[\s\S]*?\n\}\n|^:root\[[^}]*\}/gm,
      "",
    );
    style.textContent = `:root { ${names.map((name) => `${name}: ${colours.getPropertyValue(name).trim()};`).join(" ")} }\n${rules}`;
    copy.prepend(style);
    const text = `<?xml version="1.0" encoding="utf-8"?>\n${new XMLSerializer().serializeToString(copy)}\n`;
    if (editor !== undefined) {
      editor.postMessage({ type: "save", svg: text });
      return;
    }
    const link = make("a", {
      href: URL.createObjectURL(new Blob([text], { type: "image/svg+xml" })),
      download: "graph.svg",
    });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }

  function remember() {
    const boxes = Object.fromEntries(
      ["show-topic", "show-service", "show-action", "problems", "builtin"].map((id) => [id, element(id).checked]),
    );
    editor?.setState({
      ...editor.getState(),
      filter: filter.value,
      boxes,
      zoom,
      selected,
      left: canvas.scrollLeft,
      top: canvas.scrollTop,
    });
  }

  filter.addEventListener("input", () => {
    arrange();
    remember();
  });
  for (const id of ["show-topic", "show-service", "show-action", "problems"]) {
    element(id).addEventListener("change", () => {
      arrange();
      remember();
    });
  }
  element("builtin").addEventListener("change", () => {
    remember();
    if (editor === undefined) {
      show(element("builtin").checked ? pictures.builtin : pictures.plain);
    } else {
      editor.postMessage({ type: "builtin", shown: element("builtin").checked });
    }
  });
  element("zoom-in").addEventListener("click", () => zoomTo(magnification() * 1.25));
  element("zoom-out").addEventListener("click", () => zoomTo(magnification() / 1.25));
  element("fit").addEventListener("click", fit);
  addEventListener("resize", () => svg && scale());
  element("save").addEventListener("click", save);
  element("theme").addEventListener("click", () => {
    const isDark = getComputedStyle(document.documentElement).getPropertyValue("--paper").trim() !== "#ffffff";
    document.documentElement.dataset.theme = isDark ? "light" : "dark";
  });

  filter.value = saved.filter ?? "";
  Object.entries(saved.boxes ?? {}).forEach(([id, checked]) => (element(id).checked = checked));
  if (editor === undefined) {
    pictures = JSON.parse(element("data").textContent);
    element("builtin").parentElement.hidden = pictures.builtin === null;
    show(pictures.plain);
  } else {
    element("theme").hidden = true;
    const theme = () => {
      const isLight =
        document.body.classList.contains("vscode-light") ||
        document.body.classList.contains("vscode-high-contrast-light");
      document.documentElement.dataset.theme = isLight ? "light" : "dark";
    };
    theme();
    new MutationObserver(theme).observe(document.body, { attributes: true, attributeFilter: ["class"] });
    addEventListener("message", ({ data }) => {
      if (data.type === "graph") {
        editor.setState({ ...editor.getState(), uri: data.uri });
        show(data.graph);
      } else if (data.type === "live") {
        live = data.states;
        if (graph !== undefined) {
          compare();
        }
      } else if (data.type === "nothing") {
        element("status").textContent = data.reason;
      }
    });
    editor.postMessage({ type: "ready", builtin: element("builtin").checked });
  }
})();
