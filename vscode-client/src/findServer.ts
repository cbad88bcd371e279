import * as path from "node:path";

/** A program with its arguments, ready to be started. */
export interface ServerCommand {
  readonly program: string;
  readonly args: readonly string[];
  /** Where it was found, for the log. */
  readonly foundIn: string;
}

/** What the search may look at; given from outside so that tests need neither an editor nor a disk. */
export interface Surroundings {
  /** The value of the PATH environment variable. */
  readonly searchPath: string | undefined;
  readonly home: string;
  isExecutable(file: string): boolean;
}

/** Says, in words for the user, why there is no server to start. */
export class ServerNotFound extends Error {}

const NAME = "ros-preflight";

/**
 * Finds the `ros-preflight` command: the setting, else PATH, else `~/.local/bin`; undefined where it is nowhere.
 *
 * Never beside the interpreter that is selected in the editor: a workspace's settings can select one of its own, and the
 * server runs without a sandbox.
 *
 * A setting that leads nowhere is an error, not a reason to look elsewhere.
 *
 * @throws ServerNotFound
 */
export function findServer(setting: unknown, around: Surroundings): ServerCommand | undefined {
  const configured = readSetting(setting);
  if (configured !== undefined) {
    return fromSetting(configured, around);
  }
  const candidates: [string | undefined, string][] = [
    [onPath(NAME, around), "PATH"],
    [path.join(around.home, ".local", "bin", NAME), "~/.local/bin"],
  ];
  for (const [program, foundIn] of candidates) {
    if (program !== undefined && around.isExecutable(program)) {
      return { program, args: ["lsp"], foundIn };
    }
  }
  return undefined;
}

function readSetting(setting: unknown): [string, ...string[]] | undefined {
  const words: unknown[] = Array.isArray(setting) ? setting : [setting ?? ""];
  if (!words.every((word) => typeof word === "string")) {
    throw new ServerNotFound("the setting rosPreflight.server.command must be a path or a list of strings.");
  }
  const [program, ...args] = words;
  return program === undefined || program.trim() === "" ? undefined : [program.trim(), ...args];
}

function fromSetting([name, ...args]: [string, ...string[]], around: Surroundings): ServerCommand {
  const expanded = name.startsWith("~/") ? path.join(around.home, name.slice(2)) : name;
  // A relative path would mean another file in each workspace.
  const program = expanded.includes("/") ? expanded : onPath(expanded, around);
  if (program === undefined || !path.isAbsolute(program) || !around.isExecutable(program)) {
    throw new ServerNotFound(
      `the setting rosPreflight.server.command names '${name}', which is neither the absolute path of an executable ` +
        "file nor a command on PATH.",
    );
  }
  return { program, args: [...args, "lsp"], foundIn: "the setting rosPreflight.server.command" };
}

function onPath(name: string, around: Surroundings): string | undefined {
  // Relative entries of PATH are left out: they could lead into the workspace.
  return (around.searchPath ?? "")
    .split(path.delimiter)
    .filter((folder) => path.isAbsolute(folder))
    .map((folder) => path.join(folder, name))
    .find((file) => around.isExecutable(file));
}
