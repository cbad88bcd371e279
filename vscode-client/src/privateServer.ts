import { createHash } from "node:crypto";
import { mkdirSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import * as path from "node:path";
import { type Ended, run } from "./processes";

/** Says, in words for the user, why the server could not be installed. */
export class InstallFailed extends Error {}

/** What an installation works with; given from outside so that tests need no editor. */
export interface Installer {
  /** The folder that is this extension's alone. */
  readonly storage: string;
  /** What came with the extension: the server and all that it needs, pinned with hashes; its wheel lies beside. */
  readonly requirements: string;
  readonly environment: NodeJS.ProcessEnv;
  readonly line: (text: string) => void;
  /** Called with what is being done, for the progress. */
  readonly step: (what: string) => void;
  readonly signal: AbortSignal;
}

/** The minor versions of Python 3 that the requirements have wheels for. */
const OLDEST = 10;
const NEWEST = 14;
const MINUTES = 60_000;
const VERSION = "import sys; print('%d.%d' % sys.version_info[:2])";
const RECORD = "server.json";

/** The command of the private environment if it was made of these very requirements. */
export function installed(
  storage: string,
  requirements: string,
  isExecutable: (file: string) => boolean,
): string[] | undefined {
  try {
    const record = JSON.parse(readFileSync(path.join(storage, RECORD), "utf8")) as Record<string, unknown>;
    if (typeof record["folder"] !== "string" || record["requirements"] !== digestOf(requirements)) {
      return undefined;
    }
    const python = path.join(storage, record["folder"], "bin", "python");
    return isExecutable(python) ? commandOf(python) : undefined;
  } catch {
    return undefined; // never installed, or cut off
  }
}

/**
 * Makes a virtual environment with one of these interpreters, the first that suits, and the server in it.
 *
 * pip takes the files whose hashes the requirements have, from whatever index it is configured for, and builds nothing:
 * what a build runs no hash covers.
 *
 * The folder is a new one each time, and the record of which one counts is replaced at the end: another window may be
 * using the old one, or be installing too.
 *
 * @throws InstallFailed
 */
export async function install(pythons: readonly string[], installer: Installer): Promise<string[]> {
  const { storage, requirements, step } = installer;
  mkdirSync(storage, { recursive: true });
  const digest = digestOf(requirements);
  const python = await chosen(pythons, installer);
  const folder = `server-${digest.slice(0, 8)}-${process.pid}-${Date.now()}`;
  const target = path.join(storage, folder);
  try {
    step("making a virtual environment");
    venvWorked(await execute(installer, python, ["-I", "-m", "venv", target], 3), python);
    step("installing the server and what it needs");
    const inside = path.join(target, "bin", "python");
    const pip = ["-I", "-m", "pip", "install", "--disable-pip-version-check", "--no-input"];
    const pinned = ["--require-hashes", "--only-binary", ":all:", "--find-links", path.dirname(requirements)];
    pipWorked(await execute(installer, inside, [...pip, ...pinned, "--requirement", requirements], 15));
  } catch (error) {
    rmSync(target, { recursive: true, force: true });
    throw error;
  }
  const record = path.join(storage, RECORD);
  writeFileSync(`${record}.${process.pid}`, JSON.stringify({ folder, requirements: digest }));
  renameSync(`${record}.${process.pid}`, record);
  for (const old of readdirSync(storage)) {
    if (old.startsWith("server-") && !old.startsWith(`server-${digest.slice(0, 8)}-`)) {
      rmSync(path.join(storage, old), { recursive: true, force: true });
    }
  }
  return commandOf(path.join(target, "bin", "python"));
}

/** -I: a sourced ROS has a PYTHONPATH, whose modules are those of another Python. The nodes get it all the same. */
function commandOf(python: string): string[] {
  return [python, "-I", "-m", "preflight_server"];
}

async function chosen(pythons: readonly string[], installer: Installer): Promise<string> {
  const looked: string[] = [];
  for (const python of new Set(pythons)) {
    const { code, output } = await execute(installer, python, ["-I", "-c", VERSION], 1, false);
    const version = output.toString().trim();
    const [major, minor] = version.split(".").map(Number);
    if (code === 0 && major === 3 && minor !== undefined && minor >= OLDEST && minor <= NEWEST) {
      return python;
    }
    looked.push(code === 0 ? `${python} is ${version}` : `${python} does not run`);
  }
  const found = looked.length > 0 ? ` (${looked.join(", ")})` : "";
  throw new InstallFailed(`the server needs Python 3.${OLDEST} to 3.${NEWEST}, and none was found${found}.`);
}

function execute(
  installer: Installer,
  program: string,
  args: string[],
  minutes: number,
  logged = true,
): Promise<Ended> {
  const { PYTHONPATH: _path, PYTHONHOME: _home, ...environment } = installer.environment;
  if (logged) {
    installer.line([program, ...args].join(" "));
  }
  const how = { cwd: installer.storage, environment, milliseconds: minutes * MINUTES, signal: installer.signal };
  return run(program, args, logged ? { ...how, line: installer.line, outputLine: installer.line } : how).then(
    (ended) => {
      if (installer.signal.aborted) {
        throw new InstallFailed("the installation of the server was cancelled.");
      }
      return ended;
    },
  );
}

function venvWorked(ended: Ended, python: string): void {
  const said = ended.output.toString() + ended.errors;
  if (ended.code !== 0 && /ensurepip|No module named venv/.test(said)) {
    throw new InstallFailed(
      `${python} cannot make virtual environments: install the package python3-venv, or choose another Python.`,
    );
  }
  worked(ended, "making a virtual environment");
}

function pipWorked(ended: Ended): void {
  worked(ended, "installing the server with pip");
}

function worked(ended: Ended, what: string): void {
  if (ended.code === 0) {
    return;
  }
  if (ended.timedOut) {
    throw new InstallFailed(`${what} took too long and was ended.`);
  }
  const lines = ended.errors.trim().split("\n");
  const reason =
    lines
      .filter((line) => line.startsWith("ERROR:"))
      .at(-1)
      ?.slice("ERROR:".length) ??
    lines.at(-1) ??
    "";
  throw new InstallFailed(`${what} failed: ${reason.trim()}`);
}

function digestOf(file: string): string {
  return createHash("sha256").update(readFileSync(file)).digest("hex");
}
