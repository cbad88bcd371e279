import { ConfigurationTarget, commands, type Position, type TextEditor, Uri, window, workspace } from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { notice } from "./messages";
import { pythons } from "./surroundings";

/** The answer to `rosPreflight/trace`; `message` says why nothing is run. */
interface Traced {
  readonly nodes: readonly string[];
  readonly message: string | null;
}

/** Which nodes to run anew: one by its name, the one at a position, or all of the launch. */
export interface Which {
  readonly uri: string;
  readonly node?: string;
  readonly position?: Position;
}

/** The node at the cursor, or all nodes. */
export function nodesOf(editor: TextEditor, all: boolean): Which {
  const uri = editor.document.uri.toString();
  return all ? { uri } : { uri, position: editor.selection.active };
}

/** Has nodes run anew, whatever is known of them. */
export async function trace(client: LanguageClient, { uri, node, position }: Which): Promise<void> {
  const where = position === undefined ? {} : { position: client.code2ProtocolConverter.asPosition(position) };
  const answer = await client.sendRequest<Traced>("rosPreflight/trace", {
    uri,
    ...(node === undefined ? {} : { node }),
    ...where,
  });
  if (answer.message !== null) {
    void window.showWarningMessage(notice(answer.message));
  }
}

/** Starts or ends the comparison of the running system with what a file's launch starts. */
export async function watch(client: LanguageClient, uri: string, on: boolean): Promise<void> {
  const answer = await client.sendRequest<{ message: string | null }>("rosPreflight/watch", { uri, watch: on });
  if (answer.message !== null) {
    void window.showWarningMessage(notice(answer.message));
  } else if (on) {
    await commands.executeCommand("rosPreflight.nodes.focus");
  }
}

/** Forgets what runs of nodes told. */
export async function clearCache(client: LanguageClient): Promise<void> {
  const { entries, bytes } = await client.sendRequest<{ entries: number; bytes: number }>(
    "rosPreflight/clearCache",
    {},
  );
  const size = bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
  void window.showInformationMessage(
    notice(
      `${entries} kept result${entries === 1 ? "" : "s"} of runs (${size}) ${entries === 1 ? "was" : "were"} removed; nodes run again.`,
    ),
  );
}

/** Lets the user choose the interpreter that the extension's own environment is made with. */
export async function choosePython(): Promise<void> {
  const browse = "Browse…";
  const found = pythons().map((label) => ({ label }));
  const choice = await window.showQuickPick([...found, { label: browse }], {
    title: "Python for the server's own environment (3.10 to 3.14)",
  });
  if (choice !== undefined) {
    await set("server.python", choice.label === browse ? await browsed("Use This Python") : choice.label);
  }
}

/** Lets the user name the server's command. */
export async function setServerPath(): Promise<void> {
  await set("server.command", await browsed("Use This Command"));
}

async function browsed(openLabel: string): Promise<string | undefined> {
  const found = await window.showOpenDialog({ openLabel, canSelectMany: false });
  return found?.[0]?.fsPath;
}

async function set(name: string, value: string | undefined): Promise<void> {
  if (value === undefined) {
    return;
  }
  const settings = workspace.getConfiguration("rosPreflight");
  if (settings.get(name) === value) {
    await commands.executeCommand("rosPreflight.restartServer"); // no change that would do it
  } else {
    await settings.update(name, value, ConfigurationTarget.Global);
  }
}

/** Where the page of the doctor is found; what stands there is made when it is asked for. */
export const DOCTOR = Uri.parse("ros-preflight:Doctor.txt");
