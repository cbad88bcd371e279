import {
  commands,
  Disposable,
  EventEmitter,
  type ExtensionContext,
  languages,
  type TextDocument,
  type Uri,
  window,
  workspace,
} from "vscode";
import { launchFiles } from "./documents";
import { GraphView } from "./graphView";
import { type Live, watched } from "./live";
import { choosePython, clearCache, DOCTOR, nodesOf, setServerPath, trace, watch } from "./maintenance";
import { showMenu } from "./menu";
import type { NodeItem } from "./nodeItems";
import { NodeTreeView } from "./nodeTree";
import { type Place, selectRoot, showReferences } from "./rootCommands";
import { ServerSession } from "./serverSession";
import { StatusBar } from "./statusBar";

/** The settings that say which server is started, and with which environment. */
const OF_THE_START = ["server.command", "server.python", "server.install", "environment.setup"];

let session: ServerSession | undefined;

export function activate(context: ExtensionContext): void {
  const log = window.createOutputChannel("ROS Preflight", { log: true });
  const tree = new NodeTreeView(isLaunchFile);
  const graph = new GraphView(context, isLaunchFile);
  let statusBar: StatusBar | undefined;
  let watching: string | undefined;
  const showLive = (live: Live) => {
    watching = live.event === "state" ? watching : live.to;
    tree.showLive(watched(live, watching));
    graph.showLive(live);
    void commands.executeCommand("setContext", "rosPreflight.watching", live.event !== "stopped");
  };
  const doctorIsStale = new EventEmitter<Uri>();
  const server = new ServerSession(context, log, {
    changed: (life, status) => statusBar?.update(life, status),
    connected: (client) => {
      showLive({ event: "stopped" }); // a new server watches nothing
      tree.connect(client);
      graph.connect(client);
      if (client !== undefined) {
        doctorIsStale.fire(DOCTOR);
      }
    },
    analysed: () => {
      tree.refreshSoon();
      graph.refresh();
    },
    live: showLive,
  });
  session = server;
  const command = (name: string, perform: (...given: never[]) => unknown) =>
    commands.registerCommand(`rosPreflight.${name}`, perform);
  context.subscriptions.push(
    log,
    tree,
    graph,
    command("restartServer", () => server.restart()),
    command("showOutput", () => log.show()),
    command("showMenu", () => showMenu(server.missing)),
    command("showNodeTree", () => commands.executeCommand("rosPreflight.nodes.focus")),
    command("showGraph", () => graph.show()),
    command("selectRoot", (uri?: string) => {
      const file = uri ?? window.activeTextEditor?.document.uri.toString();
      return file === undefined ? undefined : server.withClient((client) => selectRoot(client, file));
    }),
    command("showReferences", (...place: Place) => server.withClient((client) => showReferences(client, ...place))),
    command("traceNode", (line?: { readonly item: NodeItem }) => {
      const editor = window.activeTextEditor;
      const which =
        line !== undefined && tree.shown !== undefined
          ? { uri: tree.shown, node: line.item.name }
          : editor && nodesOf(editor, false);
      return which && server.withClient((client) => trace(client, which));
    }),
    command("traceAll", () => {
      const which = window.activeTextEditor
        ? nodesOf(window.activeTextEditor, true)
        : tree.shown && { uri: tree.shown };
      return which && server.withClient((client) => trace(client, which));
    }),
    command("watch", () => {
      const uri = tree.shown ?? window.activeTextEditor?.document.uri.toString();
      return uri && server.withClient((client) => watch(client, uri, true));
    }),
    command("stopWatching", () => server.withClient((client) => watch(client, tree.shown ?? "", false))),
    command("clearCache", () => server.withClient(clearCache)),
    command("choosePython", choosePython),
    command("setServerPath", setServerPath),
    registerDoctor(server, doctorIsStale),
    followLaunchFiles(),
    onFirstLaunchFile(() => {
      statusBar = new StatusBar();
      void server.restart();
      context.subscriptions.push(
        statusBar,
        workspace.onDidChangeWorkspaceFolders(() => server.foldersChanged()),
        workspace.onDidGrantWorkspaceTrust(() => server.trustGranted()),
        workspace.onDidChangeConfiguration((change) => {
          if (OF_THE_START.some((name) => change.affectsConfiguration(`rosPreflight.${name}`))) {
            void server.restart();
          }
        }),
      );
    }),
  );
}

export async function deactivate(): Promise<void> {
  await session?.stop();
}

/** The command that opens the doctor's page, and who writes it: anew each time, and when `stale` says so. */
function registerDoctor(server: ServerSession, stale: EventEmitter<Uri>): Disposable {
  const provided = workspace.registerTextDocumentContentProvider(DOCTOR.scheme, {
    onDidChange: stale.event,
    provideTextDocumentContent: async () => {
      let text = "";
      await server.withClient(async (client) => {
        ({ text } = await client.sendRequest<{ text: string }>("rosPreflight/doctor", {}));
      });
      // In the columns that the server's lines have.
      const width = /^\S.*?\s{2,}/.exec(text)?.[0].length ?? 10;
      return [...server.facts.map(([what, value]) => what.padEnd(width) + value), text].join("\n");
    },
  });
  const opened = commands.registerCommand("rosPreflight.doctor", async () => {
    stale.fire(DOCTOR);
    await window.showTextDocument(await workspace.openTextDocument(DOCTOR), { preview: true });
  });
  return {
    dispose: () => {
      stale.dispose();
      provided.dispose();
      opened.dispose();
    },
  };
}

function isLaunchFile(document: TextDocument): boolean {
  return languages.match(launchFiles, document) > 0;
}

/** Tells the editor whether the active file is a launch file, of whatever language: buttons and commands go by it. */
function followLaunchFiles(): Disposable {
  const notify = () => {
    const document = window.activeTextEditor?.document;
    const is = document !== undefined && isLaunchFile(document);
    void commands.executeCommand("setContext", "rosPreflight.launchFile", is);
  };
  notify();
  // A file gets another language without another editor being active.
  return Disposable.from(window.onDidChangeActiveTextEditor(notify), workspace.onDidOpenTextDocument(notify));
}

/** Calls back once, when a launch file is or comes to be open: an XML file of another kind needs no server. */
function onFirstLaunchFile(callback: () => void): Disposable {
  if (workspace.textDocuments.some(isLaunchFile)) {
    callback();
    return { dispose: () => undefined };
  }
  const subscription = workspace.onDidOpenTextDocument((document) => {
    if (isLaunchFile(document)) {
      subscription.dispose();
      callback();
    }
  });
  return subscription;
}
