import { accessSync, constants, statSync } from "node:fs";
import { homedir } from "node:os";
import { extensions, type LogOutputChannel, workspace } from "vscode";
import type { Surroundings } from "./findServer";
import { type PythonApi, selectedInterpreter } from "./pythonInterpreter";

/** What this machine and this editor offer to the search for the server. */
export async function surroundings(log: LogOutputChannel): Promise<Surroundings> {
  return { searchPath: process.env["PATH"], home: homedir(), interpreter: await interpreter(log), isExecutable };
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

function isExecutable(file: string): boolean {
  try {
    accessSync(file, constants.X_OK);
    return statSync(file).isFile();
  } catch {
    return false;
  }
}
