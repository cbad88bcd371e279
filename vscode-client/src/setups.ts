import { statSync } from "node:fs";
import { homedir } from "node:os";
import * as path from "node:path";
import { run } from "./processes";

/** Says, in words for the user, why a set-up could not be sourced. */
export class SetupFailed extends Error {}

/** Sources each file in turn; what they print goes to standard error, the environment that they leave to descriptor 3. */
const SCRIPT = 'exec 3>&1 1>&2; for setup; do . "$setup"; done; env -0 >&3';
const MILLISECONDS = 30_000;

/**
 * The paths of the set-ups that the setting names: `~` and `${workspaceFolder}` are replaced.
 *
 * @throws SetupFailed for one that is no absolute path
 */
export function setupPaths(setting: unknown, folder: string | undefined): string[] {
  const named: unknown[] = Array.isArray(setting) ? setting : [];
  return named.map((each) => {
    const expanded = String(each)
      .trim()
      .replace(/^~(?=\/)/, homedir())
      .replaceAll("${workspaceFolder}", folder ?? "${workspaceFolder}");
    if (!path.isAbsolute(expanded)) {
      throw new SetupFailed(
        `the setting rosPreflight.environment.setup names '${String(each)}', which is no absolute path. ` +
          "${workspaceFolder} stands for the folder that is open.",
      );
    }
    return path.normalize(expanded);
  });
}

/** The environments that set-ups lead to, remembered while their files are unchanged. */
export class Setups {
  private readonly known = new Map<string, NodeJS.ProcessEnv>();

  constructor(private readonly milliseconds = MILLISECONDS) {}

  /**
   * The environment after sourcing these files with bash, which runs what is in them.
   *
   * @throws SetupFailed
   */
  async environment(
    files: readonly string[],
    base: NodeJS.ProcessEnv,
    line: (text: string) => void,
  ): Promise<NodeJS.ProcessEnv> {
    if (files.length === 0) {
      return base;
    }
    const key = JSON.stringify([files.map((file) => [file, stampOf(file)]), base]);
    const known = this.known.get(key);
    if (known !== undefined) {
      return known;
    }
    const args = ["--noprofile", "--norc", "-c", SCRIPT, "bash", ...files];
    // The environment itself, which may hold secrets, is not logged: only what is printed on the way.
    const how = { cwd: homedir(), environment: base, milliseconds: this.milliseconds, line };
    const ended = await run("bash", args, how);
    const which = files.join(", ");
    if (ended.timedOut) {
      throw new SetupFailed(`sourcing ${which} did not end within ${this.milliseconds / 1000} seconds.`);
    }
    if (ended.code !== 0) {
      const last = ended.errors.trimEnd().split("\n").at(-1) ?? "";
      throw new SetupFailed(`sourcing ${which} failed${last === "" ? "" : `: ${last}`}`);
    }
    const environment = parseEnvironment(ended.output.toString());
    this.known.set(key, environment);
    return environment;
  }

  /** Source everything anew the next time: files that a set-up reads may have changed. */
  forget(): void {
    this.known.clear();
  }
}

/** What `env -0` prints. */
export function parseEnvironment(text: string): NodeJS.ProcessEnv {
  const entries = text.split("\0").filter((entry) => entry.includes("="));
  const environment = Object.fromEntries(
    entries.map((entry) => [entry.slice(0, entry.indexOf("=")), entry.slice(entry.indexOf("=") + 1)]),
  );
  delete environment["_"]; // bash's own, the program that printed it
  return environment;
}

function stampOf(file: string): string {
  try {
    const { mtimeMs, size } = statSync(file);
    return `${mtimeMs}:${size}`;
  } catch {
    throw new SetupFailed(`the set-up ${file} of the setting rosPreflight.environment.setup does not exist.`);
  }
}
