import { homedir } from "node:os";
import { type LogOutputChannel, workspace } from "vscode";
import {
  CloseAction,
  ErrorAction,
  LanguageClient,
  NotificationType,
  RevealOutputChannelOn,
} from "vscode-languageclient/node";
import { servedFiles } from "./documents";
import type { ServerCommand } from "./findServer";
import { clientCommands } from "./rootCommands";

/** The environments of folders that have one of their own, by URI; the others have the server's. */
export type Environments = Readonly<Record<string, NodeJS.ProcessEnv>>;

/** Tells a running server that the user has come to trust the workspace. */
export const workspaceTrust = new NotificationType<{ trusted: boolean }>("rosPreflight/workspaceTrust");

const ALLOW_SECRETS = "ROS_PREFLIGHT_ALLOW_SECRETS";

/** The secrets that the user allows: by settings and the own environment, whatever the set-ups of a workspace say. */
function allowedSecrets(): string {
  const named = workspace.getConfiguration("rosPreflight").get<unknown>("allowSecrets");
  const given = Array.isArray(named) ? named.filter((each): each is string => typeof each === "string") : [];
  return [process.env[ALLOW_SECRETS] ?? "", ...given].filter((each) => each !== "").join(":");
}

/** What the server must know before it may run anything. */
function initializationOptions(environments: Environments): Record<string, unknown> {
  const settings = workspace.getConfiguration("rosPreflight");
  return {
    workspaceTrusted: workspace.isTrusted,
    runNodes: settings.get("runNodes"),
    inlayHints: settings.get("inlayHints"),
    packagePath: settings.get("packagePath"),
    clientCommands,
    status: true,
    environments,
  };
}

/**
 * Makes a client for one life of the server, which runs in `environment` and looks at folders in theirs; `closed` is
 * called when its connection ends without having been asked to.
 */
export function createClient(
  server: ServerCommand,
  environment: NodeJS.ProcessEnv,
  environments: Environments,
  log: LogOutputChannel,
  closed: () => void,
): LanguageClient {
  return new LanguageClient(
    "rosPreflight",
    "ROS Preflight",
    {
      command: server.program,
      args: [...server.args],
      // Not the workspace: `python -m` would import from it, trusted or not.
      options: { cwd: homedir(), env: { ...environment, [ALLOW_SECRETS]: allowedSecrets() } },
    },
    {
      documentSelector: [...servedFiles],
      outputChannel: log,
      traceOutputChannel: log,
      revealOutputChannelOn: RevealOutputChannelOn.Never,
      initializationOptions: () => initializationOptions(environments),
      initializationFailedHandler: () => false, // start() rejects with the reason
      errorHandler: {
        error: () => ({ action: ErrorAction.Continue, handled: true }),
        closed: () => {
          closed();
          return { action: CloseAction.DoNotRestart, handled: true, message: "The server's connection ended." };
        },
      },
    },
  );
}
