import type { ServerStatus } from "./serverStatus";

type Work = Exclude<ServerStatus["state"], "idle">;

const DONE: Readonly<Record<Work, (count: number) => string>> = {
  indexing: (count) => (count > 0 ? `Indexed ${count} launch file${count === 1 ? "" : "s"}` : "Indexed the workspace"),
  tracing: (count) => (count > 0 ? `Ran ${count} node${count === 1 ? "" : "s"} in the sandbox` : "Ran nodes"),
};

/** What the server did and how long it took, from what it tells of itself: lines for the log. */
export class Activity {
  private work: { readonly state: Work; readonly since: number; readonly total: number } | undefined;
  private notRun = "";
  private missing = "";
  /** The last thing that was done. */
  last = "";

  /** What is worth a line after one more status; `now` is in milliseconds. */
  next(status: ServerStatus, now: number): string[] {
    const lines: string[] = [];
    if (this.work !== undefined && this.work.state !== status.state) {
      this.last = `${DONE[this.work.state](this.work.total)} in ${((now - this.work.since) / 1000).toFixed(1)} s`;
      lines.push(`${this.last}.`);
      this.work = undefined;
    }
    if (status.state !== "idle") {
      const { since } = this.work ?? { since: now };
      this.work = { state: status.state, since, total: Math.max(this.work?.total ?? 0, status.total) };
    }
    const notRun = status.notRun?.message ?? "";
    if (notRun !== this.notRun && notRun !== "") {
      lines.push(`Nodes are not run: ${notRun}.`);
    }
    const missing = status.missing.lines.join("; ");
    if (missing !== this.missing && missing !== "") {
      lines.push(`Missing on this machine: ${missing}.`);
    }
    [this.notRun, this.missing] = [notRun, missing];
    return lines;
  }
}
