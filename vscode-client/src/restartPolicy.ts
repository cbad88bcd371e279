/** Allows so many restarts in so long a time, and no more. */
export class RestartPolicy {
  private restarts: number[] = [];

  constructor(
    readonly limit = 5,
    readonly windowMilliseconds = 3 * 60 * 1000,
    private readonly now: () => number = Date.now,
  ) {}

  /** Whether the server that just died may be started again; a yes is counted. */
  allowsRestart(): boolean {
    const now = this.now();
    this.restarts = this.restarts.filter((then) => now - then < this.windowMilliseconds);
    if (this.restarts.length >= this.limit) {
      return false;
    }
    this.restarts.push(now);
    return true;
  }
}
