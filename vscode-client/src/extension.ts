import * as path from "node:path";
import {
  CodeLens,
  commands,
  Disposable,
  EventEmitter,
  type ExtensionContext,
  languages,
  Range,
  type TextDocument,
  type Uri,
  window,
  workspace,
} from "vscode";
import { advice } from "./doctorActions";
import { isBehaviorTree, launchFiles, startingFiles } from "./documents";
import { GraphView } from "./graphView";
import { type Live, UNWATCHED, watched } from "./live";
import { choosePython, clearCache, DOCTOR, nodesOf, setServerPath, trace, watch } from "./maintenance";
import { showMenu, writeIntoTerminal } from "./menu";
import { notice } from "./messages";
import type { NodeItem } from "./nodeItems";
import { NodeTreeView } from "./nodeTree";
import { type Place, selectRoot, showReferences } from "./rootCommands";
import { ServerSession } from "./serverSession";
import { StatusBar } from "./statusBar";
import { registerUnserved } from "./unserved";
import { type Question, why } from "./why";

/** The settings that say which server is started, and with which environment. */
const OF_THE_START = ["server.command", "server.python", "server.install", "environment.setup", "allowSecrets"];

const WALKTHROUGH = "ros-preflight.ros-preflight#rosPreflight.start";
/** Where launch files are, for the list of them; of ROS 2's in Python those that are named as such. */
const LAUNCH_FILES = "**/*{.launch,.launch.xml,.launch.py,.launch.yaml,.launch.yml,_launch.py,_launch.xml}";
const MOST = 2000;

let session: ServerSession | undefined;

export function activate(context: ExtensionContext): void {
  const log = window.createOutputChannel("ROS Preflight", { log: true });
  const tree = new NodeTreeView(isLaunchFile);
  const explain = (question: Question) => server.withClient((client) => why(client, question));
  const graph = new GraphView(context, isLaunchFile, explain);
  let statusBar: StatusBar | undefined;
  let watching: string | undefined;
  let before = UNWATCHED;
  const showLive = (live: Live) => {
    watching = live.event === "state" ? watching : live.to;
    before = watched(live, watching, before);
    tree.showLive(before);
    graph.showLive(live, before.differences);
    void commands.executeCommand("setContext", "rosPreflight.watching", live.event !== "stopped");
  };
  const doctorIsStale = new EventEmitter<Uri>();
  const server = new ServerSession(context, log, {
    changed: (life, status, last) => statusBar?.update(life, status, last),
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
    command("why", (line?: { readonly item: NodeItem }) => {
      const editor = window.activeTextEditor;
      const question =
        line !== undefined && tree.shown !== undefined
          ? { uri: tree.shown, node: line.item.name }
          : editor && nodesOf(editor, false);
      return question && explain(question);
    }),
    command("watch", () => {
      const uri = tree.shown ?? window.activeTextEditor?.document.uri.toString();
      return uri && server.withClient((client) => watch(client, uri, true));
    }),
    command("stopWatching", () => server.withClient((client) => watch(client, tree.shown ?? "", false))),
    command("clearCache", () => server.withClient(clearCache)),
    command("choosePython", choosePython),
    command("setServerPath", setServerPath),
    command("getStarted", () => commands.executeCommand("workbench.action.openWalkthrough", WALKTHROUGH)),
    command("openLaunchFile", openLaunchFile),
    command("writeIntoTerminal", writeIntoTerminal),
    registerUnserved(),
    registerDoctor(server, doctorIsStale, () => begin()),
    followLaunchFiles(),
    onFirstServedFile(() => begin()),
  );
  function begin(): void {
    if (statusBar !== undefined) {
      return;
    }
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
  }
}

export async function deactivate(): Promise<void> {
  await session?.stop();
}

/** Lets the user choose one of the workspace's launch files. */
async function openLaunchFile(): Promise<void> {
  const found = await workspace.findFiles(LAUNCH_FILES, "**/{build,install,devel,.git,node_modules}/**", MOST);
  if (found.length === 0) {
    void window.showInformationMessage(notice("no launch file was found in the open folders."));
    return;
  }
  const items = found
    .map((uri) => ({ uri, label: path.basename(uri.path), description: workspace.asRelativePath(uri) }))
    .sort((a, b) => a.description.localeCompare(b.description));
  const choice = await window.showQuickPick(items, { title: "Open a launch file", matchOnDescription: true });
  if (choice !== undefined) {
    await window.showTextDocument(choice.uri);
  }
}

/**
 * The command that opens the doctor's page, who writes it, anew each time and when `stale` says so, and its buttons.
 * `begin` starts the server where no launch file did.
 */
function registerDoctor(server: ServerSession, stale: EventEmitter<Uri>, begin: () => void): Disposable {
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
  const buttons = languages.registerCodeLensProvider(
    { scheme: DOCTOR.scheme },
    {
      provideCodeLenses: (document) =>
        advice(document.getText(), workspace.isTrusted).map(
          ({ line, ...button }) =>
            new CodeLens(new Range(line, 0, line, 0), { ...button, arguments: [...button.arguments] }),
        ),
    },
  );
  const opened = commands.registerCommand("rosPreflight.doctor", async () => {
    begin();
    stale.fire(DOCTOR);
    await window.showTextDocument(await workspace.openTextDocument(DOCTOR), { preview: true });
  });
  return {
    dispose: () => {
      stale.dispose();
      provided.dispose();
      opened.dispose();
      buttons.dispose();
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

/** Whether a document is a launch file, or one that launch files hand to nodes: XML of another kind needs no server. */
function startsServer(document: TextDocument): boolean {
  const isXml = document.uri.scheme === "file" && document.languageId === "xml";
  return languages.match(startingFiles, document) > 0 || (isXml && isBehaviorTree(document.getText()));
}

/** Calls back once, when a file that the server is for is or comes to be open. */
function onFirstServedFile(callback: () => void): Disposable {
  if (workspace.textDocuments.some(startsServer)) {
    callback();
    return { dispose: () => undefined };
  }
  const subscription = workspace.onDidOpenTextDocument((document) => {
    if (startsServer(document)) {
      subscription.dispose();
      callback();
    }
  });
  return subscription;
}
