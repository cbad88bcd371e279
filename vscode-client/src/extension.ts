import {
  commands,
  type Disposable,
  type ExtensionContext,
  languages,
  type TextDocument,
  window,
  workspace,
} from "vscode";
import { launchFiles } from "./documents";
import { type Place, selectRoot, showReferences } from "./rootCommands";
import { ServerSession } from "./serverSession";

let session: ServerSession | undefined;

export function activate(context: ExtensionContext): void {
  const log = window.createOutputChannel("ROS Preflight", { log: true });
  const server = new ServerSession(log);
  session = server;
  context.subscriptions.push(
    log,
    commands.registerCommand("rosPreflight.restartServer", () => server.restart()),
    commands.registerCommand("rosPreflight.showOutput", () => log.show()),
    commands.registerCommand("rosPreflight.selectRoot", (uri?: string) => {
      const file = uri ?? window.activeTextEditor?.document.uri.toString();
      return file === undefined ? undefined : server.withClient((client) => selectRoot(client, file));
    }),
    commands.registerCommand("rosPreflight.showReferences", (...place: Place) =>
      server.withClient((client) => showReferences(client, ...place)),
    ),
    onFirstLaunchFile(() => {
      void server.restart();
      context.subscriptions.push(
        workspace.onDidGrantWorkspaceTrust(() => server.trustGranted()),
        workspace.onDidChangeConfiguration((change) => {
          if (change.affectsConfiguration("rosPreflight.server.command")) {
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

/** Calls back once, when a launch file is or comes to be open: an XML file of another kind needs no server. */
function onFirstLaunchFile(callback: () => void): Disposable {
  const isLaunchFile = (document: TextDocument) => languages.match(launchFiles, document) > 0;
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
