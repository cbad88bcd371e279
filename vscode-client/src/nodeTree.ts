import * as path from "node:path";
import {
  type CancellationToken,
  type Disposable,
  EventEmitter,
  type FileDecoration,
  type FileDecorationProvider,
  MarkdownString,
  Range,
  type TextDocument,
  ThemeColor,
  ThemeIcon,
  type TreeDataProvider,
  TreeItem,
  TreeItemCollapsibleState,
  type TreeView,
  Uri,
  window,
  workspace,
} from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { liveLines, UNWATCHED, type Watched } from "./live";
import {
  colourOf,
  decorationOf,
  differenceItems,
  differenceSection,
  extras,
  iconOf,
  identified,
  type NodeItem,
  type NodeTree,
  spoken,
  written,
} from "./nodeItems";

const SCHEME = "ros-preflight-node";
/** Milliseconds between news and the question for a newer tree. */
const PAUSE = 200;

interface Line {
  readonly id: string;
  readonly item: NodeItem;
}

/** The view of what the launch file in the editor starts; newer trees replace older ones while the user types. */
export class NodeTreeView implements TreeDataProvider<Line>, FileDecorationProvider, Disposable {
  private readonly changed = new EventEmitter<undefined>();
  readonly onDidChangeTreeData = this.changed.event;
  private readonly view: TreeView<Line>;
  private readonly subscriptions: Disposable[];
  private client: LanguageClient | undefined;
  private uri: string | undefined;
  private tree: NodeTree | undefined;
  private live = UNWATCHED;
  private asking = false;
  private askAgain = false;
  private soon: NodeJS.Timeout | undefined;

  /** `isLaunchFile` tells the documents that have a tree. */
  constructor(private readonly isLaunchFile: (document: TextDocument) => boolean) {
    this.view = window.createTreeView("rosPreflight.nodes", { treeDataProvider: this, showCollapseAll: true });
    this.subscriptions = [
      this.changed,
      this.view,
      window.registerFileDecorationProvider(this),
      window.onDidChangeActiveTextEditor(() => this.follow()),
      this.view.onDidChangeVisibility(() => this.refresh()),
    ];
  }

  /** From now on this server is asked; undefined when there is none. */
  connect(client: LanguageClient | undefined): void {
    this.client = client;
    if (client === undefined) {
      this.show(undefined);
    } else {
      this.follow();
    }
  }

  /** The launch file whose tree it is. */
  get shown(): string | undefined {
    return this.uri;
  }

  /** Shows what nodes do on the running robot. */
  showLive(live: Watched): void {
    this.live = live;
    this.view.message = live.message ?? "";
    this.changed.fire(undefined);
  }

  /** There may be a newer tree. Asked for once at a time, and again when news came meanwhile. */
  refresh(): void {
    if (this.client === undefined || this.uri === undefined || !this.view.visible) {
      return;
    }
    if (this.asking) {
      this.askAgain = true;
      return;
    }
    this.asking = true;
    const uri = this.uri;
    this.client
      .sendRequest<NodeTree | null>("rosPreflight/tree", { uri })
      .then(
        (tree) => {
          // A parameter file, say, leaves what the launch file before it starts.
          if (tree !== null && uri === this.uri) {
            this.show(tree);
          }
        },
        () => undefined, // the server has stopped, and its end is told elsewhere
      )
      .finally(() => {
        this.asking = false;
        if (this.askAgain) {
          this.askAgain = false;
          this.refresh();
        }
      });
  }

  /** As `refresh`, once for all news of a moment: somebody may be typing. */
  refreshSoon(): void {
    this.soon ??= setTimeout(() => {
      this.soon = undefined;
      this.refresh();
    }, PAUSE);
  }

  getChildren(line?: Line): Line[] {
    if (line !== undefined) {
      return identified([...this.differencesAt(line.item), ...line.item.children], line.id);
    }
    return this.tree === undefined
      ? []
      : identified([...differenceSection(this.live.differences), ...this.tree.items, ...extras(this.live.states)]);
  }

  getTreeItem({ id, item }: Line): TreeItem {
    const { label, description } = written(item, this.tree?.files.length ?? 0);
    const made = new TreeItem(label, fold(item, this.differencesAt(item).length > 0));
    made.id = id;
    made.description = description;
    made.contextValue = item.kind;
    const files = (this.tree?.files ?? []).map((uri) => path.basename(Uri.parse(uri).path));
    made.accessibilityInformation = { label: spoken(item, files, this.live.states.get(item.name)) };
    const live = this.live.states.get(item.name);
    const colour = colourOf(item.file, live);
    made.iconPath = new ThemeIcon(
      iconOf(item, live),
      item.kind === "not-taken"
        ? new ThemeColor("disabledForeground")
        : colour === undefined || item.kind === "param" || item.kind === "remap"
          ? undefined
          : new ThemeColor(colour),
    );
    const decoration = decorationOf(item);
    if (decoration !== undefined) {
      made.resourceUri = Uri.from({ scheme: SCHEME, path: id, query: decoration });
    }
    if (item.location !== null && this.client !== undefined) {
      const { uri, range } = this.client.protocol2CodeConverter.asLocation(item.location);
      const selection = new Range(range.start, range.start);
      made.command = { command: "vscode.open", title: "Open", arguments: [uri, { selection, preview: true }] };
    }
    return made;
  }

  /** What is not as expected at a node, one line for each endpoint. */
  private differencesAt(item: NodeItem): NodeItem[] {
    return item.kind === "node" ? differenceItems(this.live.differences.filter(({ node }) => node === item.name)) : [];
  }

  async resolveTreeItem(made: TreeItem, { item }: Line, token: CancellationToken): Promise<TreeItem> {
    if (item.kind === "difference") {
      const said = [item.label, item.note, `${item.detail} (${item.name})`, this.place(item)];
      made.tooltip = new MarkdownString().appendText(said.filter((line) => line !== "").join("\n"));
      return made;
    }
    const live = item.kind === "node" ? liveLines(item.name, this.live) : [];
    const lines = [`${item.name || item.label} ${item.detail}`, ...live, item.note, this.place(item)];
    // Names come from files: nothing in them is Markdown, or they could have an image fetched.
    made.tooltip = new MarkdownString().appendText(lines.filter((line) => line !== "").join("\n"));
    if (item.kind === "node" && item.location !== null && this.client !== undefined) {
      // What hover says of the node, where its file is open.
      const params = { textDocument: { uri: item.location.uri }, position: item.location.range.start };
      const hover = await this.client
        .sendRequest<{ contents: { value?: string } } | null>("textDocument/hover", params, token)
        .catch(() => null);
      if (hover?.contents.value !== undefined) {
        made.tooltip = new MarkdownString().appendText(live.map((line) => `${line}\n`).join(""));
        made.tooltip.appendMarkdown(live.length > 0 ? "\n\n---\n\n" : "").appendMarkdown(hover.contents.value);
      }
    }
    return made;
  }

  provideFileDecoration(uri: Uri): FileDecoration | undefined {
    if (uri.scheme !== SCHEME) {
      return undefined;
    }
    if (uri.query === "left-out") {
      return { color: new ThemeColor("disabledForeground"), tooltip: "not started" };
    }
    const [severity = "", count = ""] = uri.query.split("=");
    const colour = { error: "list.errorForeground", warning: "list.warningForeground" }[severity];
    return {
      badge: count.length > 1 ? "9+" : count,
      tooltip: `${count} problem${count === "1" ? "" : "s"}`,
      ...(colour === undefined ? {} : { color: new ThemeColor(colour) }),
    };
  }

  dispose(): void {
    clearTimeout(this.soon);
    for (const subscription of this.subscriptions) {
      subscription.dispose();
    }
  }

  private follow(): void {
    const document = window.activeTextEditor?.document;
    if (document !== undefined && this.isLaunchFile(document)) {
      this.uri = document.uri.toString();
    }
    this.refresh();
  }

  private show(tree: NodeTree | undefined): void {
    this.tree = tree;
    this.view.description = tree === undefined ? "" : described(tree);
    this.changed.fire(undefined);
  }

  private place(item: NodeItem): string {
    if (item.location === null) {
      return "";
    }
    const file = workspace.asRelativePath(Uri.parse(item.location.uri));
    return `${file}:${item.location.range.start.line + 1}`;
  }
}

function fold(item: NodeItem, differs: boolean): TreeItemCollapsibleState {
  if (differs) {
    return TreeItemCollapsibleState.Expanded;
  }
  if (item.children.length === 0) {
    return TreeItemCollapsibleState.None;
  }
  const unfolded =
    item.kind === "namespace" ||
    item.kind === "not-taken" ||
    item.kind === "include" ||
    (item.kind === "section" && item.label !== "Shared parameters" && !item.label.startsWith("Frames"));
  return unfolded ? TreeItemCollapsibleState.Expanded : TreeItemCollapsibleState.Collapsed;
}

function described(tree: NodeTree): string {
  const args = Object.entries(tree.root.args).map(([name, value]) => `${name}:=${value}`);
  return [path.basename(Uri.parse(tree.root.uri).path), ...args].join(" ");
}
