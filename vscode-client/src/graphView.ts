import { randomBytes } from "node:crypto";
import { readFileSync } from "node:fs";
import {
  type Disposable,
  type ExtensionContext,
  Position,
  Range,
  type TextDocument,
  Uri,
  ViewColumn,
  type WebviewPanel,
  window,
  workspace,
} from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { graphPage, utf16Column } from "./graphPage";
import { clock, type Difference, type Live } from "./live";
import { notice } from "./messages";
import { keptUri, type PageMessage, type Place, pageMessage } from "./pageMessages";
import { type Graph, ShownPlaces } from "./shownPlaces";
import type { Question } from "./why";

const VIEW_TYPE = "rosPreflight.graph";

type Answer = { readonly digest: string; readonly graph: Graph | null } | null;

/** The picture of who talks to whom, beside the launch file that was last looked at, and always up to date. */
export class GraphView implements Disposable {
  private panel: WebviewPanel | undefined;
  private client: LanguageClient | undefined;
  private uri: string | undefined;
  private builtin = false;
  private isReady = false;
  private known: string | null = null;
  private places = new ShownPlaces();
  private live: Partial<Live> = {};
  private differences: readonly Difference[] = [];
  private asking = false;
  private again = false;
  private readonly subscriptions: Disposable[];

  constructor(
    private readonly context: ExtensionContext,
    private readonly isLaunchFile: (document: TextDocument) => boolean,
    private readonly explain: (question: Question) => unknown,
  ) {
    this.subscriptions = [
      window.onDidChangeActiveTextEditor((editor) => {
        if (this.panel !== undefined && editor !== undefined && isLaunchFile(editor.document)) {
          this.look(editor.document.uri.toString());
        }
      }),
      window.registerWebviewPanelSerializer(VIEW_TYPE, {
        deserializeWebviewPanel: async (panel, state: unknown) => {
          this.uri ??= keptUri(state);
          this.adopt(panel);
        },
      }),
    ];
  }

  dispose(): void {
    this.panel?.dispose();
    this.subscriptions.forEach((each) => each.dispose());
  }

  /** A server runs and can be asked, or there is none any more. */
  connect(client: LanguageClient | undefined): void {
    this.client = client;
    this.refresh();
  }

  /** Marks what of the graph is not there on the running robot, or is of another type. */
  showLive(live: Live, differences: readonly Difference[]): void {
    this.differences = differences;
    if (live.event === "attached" || live.event === "restarted") {
      return;
    }
    this.live = live.event === "state" ? live : {};
    this.postLive();
  }

  /** Shows the graph of the launch file in the active editor, or the one that was shown last. */
  show(): void {
    const document = window.activeTextEditor?.document;
    if (document !== undefined && this.isLaunchFile(document)) {
      this.uri = document.uri.toString();
    }
    if (this.uri === undefined) {
      void window.showInformationMessage(notice("open a launch file to see its graph."));
      return;
    }
    if (this.panel === undefined) {
      const where = { viewColumn: ViewColumn.Beside, preserveFocus: false };
      this.adopt(window.createWebviewPanel(VIEW_TYPE, "ROS Graph", where, {}));
    } else {
      this.panel.reveal();
      this.refresh();
    }
  }

  /** Asks for the graph, if it is seen; what did not change is not sent. */
  refresh(): void {
    if (this.panel?.visible && this.isReady) {
      this.again = true;
      void this.ask();
    }
  }

  private postLive(): void {
    const { nodes, topics, services, actions } = this.live;
    const issues = this.differences.map(({ since, ...issue }) => ({ ...issue, since: clock(since) }));
    void this.panel?.webview.postMessage({ type: "live", states: { nodes, topics, services, actions, issues } });
  }

  private look(uri: string): void {
    this.uri = uri;
    this.refresh();
  }

  private adopt(panel: WebviewPanel): void {
    this.panel = panel;
    this.isReady = false;
    panel.webview.options = { enableScripts: true, localResourceRoots: [] };
    panel.webview.onDidReceiveMessage((data: unknown) => {
      const message = pageMessage(data);
      return message && this.received(message);
    });
    panel.onDidChangeViewState(() => this.refresh());
    panel.onDidDispose(() => {
      if (this.panel === panel) {
        this.panel = undefined;
        this.isReady = false;
      }
    });
    const read = (file: string) =>
      readFileSync(Uri.joinPath(this.context.extensionUri, "dist", "view", file).fsPath, "utf8");
    panel.webview.html = graphPage(read, randomBytes(16).toString("base64"));
  }

  // One request at a time: while somebody types, only the newest answer is of interest.
  private async ask(): Promise<void> {
    if (this.asking) {
      return;
    }
    this.asking = true;
    try {
      while (this.again && this.client !== undefined && this.uri !== undefined) {
        this.again = false;
        const { uri, builtin, known } = this;
        const answer = await this.client.sendRequest<Answer>("rosPreflight/graph", { uri, builtin, known });
        if (uri === this.uri && builtin === this.builtin && known === this.known) {
          this.answered(answer);
        } else {
          this.again = true;
        }
      }
    } catch {
      // The server went away or is busy with what it says itself; the next analysis asks again.
    } finally {
      this.asking = false;
    }
  }

  private answered(answer: Answer): void {
    if (this.panel === undefined) {
      return;
    }
    if (answer === null && this.known === null) {
      const reason = "Open the launch file to see its graph.";
      void this.panel.webview.postMessage({ type: "nothing", reason });
    }
    if (answer === null || answer.graph === null) {
      return;
    }
    this.known = answer.digest;
    this.places = new ShownPlaces(answer.graph);
    this.panel.title = `Graph: ${answer.graph.title.split("/").at(-1) ?? answer.graph.title}`;
    void this.panel.webview.postMessage({ type: "graph", graph: answer.graph, uri: this.uri });
  }

  private async received(message: PageMessage): Promise<void> {
    switch (message.type) {
      case "ready":
        this.isReady = true;
        this.known = null;
        this.builtin = message.builtin;
        this.postLive();
        this.refresh();
        break;
      case "builtin":
        this.builtin = message.shown;
        this.refresh();
        break;
      case "save":
        await save(message.svg);
        break;
      case "why":
        if (this.uri !== undefined) {
          const { node, channel, others } = message;
          this.explain({ uri: this.uri, node, others, ...(channel === null ? {} : { channel }) });
        }
        break;
      case "open":
        if (this.places.has(message)) {
          await this.open(message);
        }
        break;
    }
  }

  private async open(place: Place): Promise<void> {
    const folders = workspace.workspaceFolders?.map((folder) => folder.uri.fsPath) ?? [];
    const belongs = this.places.belongs(place.file, folders);
    if (belongs === "nowhere") {
      void window.showWarningMessage(notice(`${place.file} does not exist.`));
    } else if (belongs === "workspace" || (await isWanted(place.file))) {
      await open(place);
    }
  }
}

/** Whether the user opens a file that is not the workspace's. */
async function isWanted(file: string): Promise<boolean> {
  const yes = "Open";
  return (await window.showWarningMessage(notice(`${file} is not a file of the workspace.`), yes)) === yes;
}

async function open(place: Place): Promise<void> {
  try {
    const document = await workspace.openTextDocument(Uri.file(place.file));
    const line = Math.min(document.lineCount, place.line) - 1;
    const at = new Position(line, utf16Column(document.lineAt(line).text, place.column));
    await window.showTextDocument(document, { viewColumn: ViewColumn.One, selection: new Range(at, at) });
  } catch (error) {
    void window.showWarningMessage(notice(`${place.file} cannot be shown: ${String(error)}`));
  }
}

async function save(svg: string): Promise<void> {
  const folder = workspace.workspaceFolders?.[0]?.uri;
  const target = await window.showSaveDialog({
    filters: { "SVG picture": ["svg"] },
    ...(folder === undefined ? {} : { defaultUri: Uri.joinPath(folder, "graph.svg") }),
  });
  if (target !== undefined) {
    await workspace.fs.writeFile(target, Buffer.from(svg, "utf8"));
  }
}
