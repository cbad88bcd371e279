import { accessSync, constants, statSync } from "node:fs";
import { homedir } from "node:os";
import * as path from "node:path";
import { workspace } from "vscode";
import type { Surroundings } from "./findServer";

/** What this machine offers to the search for the server. */
export function surroundings(): Surroundings {
  return { searchPath: process.env["PATH"], home: homedir(), isExecutable };
}

/**
 * The interpreters that a private environment may be made with, the preferred one first: the user's setting, else those
 * on PATH. Not the one that is selected in the editor, which a workspace's settings can make one of its own.
 */
export function pythons(): string[] {
  const chosen = workspace.getConfiguration("rosPreflight").get<string>("server.python")?.trim();
  if (chosen !== undefined && chosen !== "") {
    return [chosen]; // no other one in its stead
  }
  // Relative entries of PATH are left out: they could lead into the workspace.
  const folders = (process.env["PATH"] ?? "").split(path.delimiter).filter((folder) => path.isAbsolute(folder));
  const names = ["python3", ...[14, 13, 12, 11, 10].map((minor) => `python3.${minor}`)];
  const onPath = names.flatMap((name) => folders.map((folder) => path.join(folder, name))).filter(isExecutable);
  return [...new Set(onPath)];
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
