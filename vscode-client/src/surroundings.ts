import { accessSync, constants, statSync } from "node:fs";
import { homedir } from "node:os";
import * as path from "node:path";
import { extensions, type LogOutputChannel, workspace } from "vscode";
import type { Surroundings } from "./findServer";
import { type PythonApi, selectedInterpreter } from "./pythonInterpreter";

/** What this machine and this editor offer to the search for the server. */
export async function surroundings(log: LogOutputChannel): Promise<Surroundings> {
  return { searchPath: process.env["PATH"], home: homedir(), interpreter: await interpreter(log), isExecutable };
}

/** The interpreters that a private environment may be made with, the preferred one first. */
export async function pythons(log: LogOutputChannel): Promise<string[]> {
  const chosen = workspace.getConfiguration("rosPreflight").get<string>("server.python")?.trim();
  if (chosen !== undefined && chosen !== "") {
    return [chosen]; // no other one in its stead
  }
  const selected = await interpreter(log);
  // Relative entries of PATH are left out: they could lead into the workspace.
  const folders = (process.env["PATH"] ?? "").split(path.delimiter).filter((folder) => path.isAbsolute(folder));
  const names = ["python3", ...[14, 13, 12, 11, 10].map((minor) => `python3.${minor}`)];
  const onPath = names.flatMap((name) => folders.map((folder) => path.join(folder, name))).filter(isExecutable);
  return [...new Set([...(selected === undefined ? [] : [selected]), ...onPath])];
}

async function interpreter(log: LogOutputChannel): Promise<string | undefined> {
  const python = extensions.getExtension<PythonApi>("ms-python.python");
  // A workspace's own settings can select the interpreter, and what stands beside it would be executed.
  if (python === undefined || !workspace.isTrusted) {
    return undefined;
  }
  try {
    return await selectedInterpreter(await python.activate(), workspace.workspaceFolders?.[0]?.uri);
  } catch (error) {
    log.warn(`The Python extension gave no interpreter: ${String(error)}`);
    return undefined;
  }
}

/** Whether a path is a file that may be executed. */
export function isExecutable(file: string): boolean {
  try {
    accessSync(file, constants.X_OK);
    return statSync(file).isFile();
  } catch {
    return false;
  }
}
