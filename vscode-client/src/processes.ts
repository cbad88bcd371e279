import { spawn } from "node:child_process";

/** What a program left behind. */
export interface Ended {
  /** null if it was killed, or could not be started. */
  readonly code: number | null;
  readonly output: Buffer;
  readonly errors: string;
  readonly timedOut: boolean;
}

export interface HowToRun {
  readonly cwd: string;
  readonly environment: NodeJS.ProcessEnv;
  readonly milliseconds: number;
  /** Called with each line of standard error. */
  readonly line?: (text: string) => void;
  /** Called with each line of standard output. */
  readonly outputLine?: (text: string) => void;
  readonly signal?: AbortSignal;
}

/** Runs a program to its end, with everything that it starts; killed when its time is over. Never rejects. */
export function run(program: string, args: readonly string[], how: HowToRun): Promise<Ended> {
  return new Promise((resolve) => {
    let timedOut = false;
    const output: Buffer[] = [];
    let errors = "";
    // A process group of its own: what it started must not outlive it.
    const child = spawn(program, args, {
      cwd: how.cwd,
      env: how.environment,
      stdio: ["ignore", "pipe", "pipe"],
      detached: true,
    });
    const kill = () => {
      try {
        process.kill(-(child.pid ?? NaN), "SIGKILL");
      } catch {
        child.kill("SIGKILL"); // it is gone, or never was there
      }
    };
    const timer = setTimeout(() => {
      timedOut = true;
      kill();
    }, how.milliseconds);
    how.signal?.addEventListener("abort", kill, { once: true });
    if (how.signal?.aborted) {
      kill();
    }
    child.stdout.on("data", (data: Buffer) => {
      output.push(data);
      emit(data, how.outputLine);
    });
    child.stderr.on("data", (data: Buffer) => {
      errors += data.toString();
      emit(data, how.line);
    });
    const end = (code: number | null, more = "") => {
      clearTimeout(timer);
      how.signal?.removeEventListener("abort", kill);
      resolve({ code, output: Buffer.concat(output), errors: errors + more, timedOut });
    };
    child.once("error", (error) => end(null, error.message));
    child.once("close", (code) => end(code));
  });
}

function emit(data: Buffer, line: ((text: string) => void) | undefined): void {
  for (const text of data.toString().split("\n")) {
    if (text.trim() !== "") {
      line?.(text);
    }
  }
}
