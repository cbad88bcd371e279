import { commands, type LogOutputChannel, window, workspace } from "vscode";
import { type LanguageClient, State } from "vscode-languageclient/node";
import { createClient, workspaceTrust } from "./client";
import { findServer, ServerNotFound } from "./findServer";
import { RestartPolicy } from "./restartPolicy";
import { surroundings } from "./surroundings";

/** The one server of this window: found, started, started again when it dies, stopped. */
export class ServerSession {
  private client: LanguageClient | undefined;
  private policy = new RestartPolicy();
  /** Stops and starts stand in a queue, so that two quick restarts do not leave two servers behind. */
  private queue: Promise<void> = Promise.resolve();

  constructor(private readonly log: LogOutputChannel) {}

  /** Starts the server, stopping one that runs. Never rejects: what goes wrong is shown to the user. */
  restart(): Promise<void> {
    this.policy = new RestartPolicy();
    return this.enqueue(() => this.replaceClient());
  }

  stop(): Promise<void> {
    return this.enqueue(() => this.stopClient());
  }

  /** Passes on that the workspace is trusted now; where no server runs, this may be what it takes to find one. */
  async trustGranted(): Promise<void> {
    if (this.client === undefined || this.client.state === State.Stopped) {
      return this.restart();
    }
    try {
      await this.client.sendNotification(workspaceTrust, { trusted: true });
    } catch (error) {
      // The next start passes trust on by itself.
      this.log.debug(`The server was not told of the workspace's trust: ${String(error)}`);
    }
  }

  /** Calls `work` with the client of a running server; what goes wrong is shown to the user. */
  async withClient(work: (client: LanguageClient) => Promise<void>): Promise<void> {
    if (this.client?.state !== State.Running) {
      this.report("the server is not running.");
      return;
    }
    try {
      await work(this.client);
    } catch (error) {
      this.report(String(error));
    }
  }

  private enqueue(step: () => Promise<void>): Promise<void> {
    this.queue = this.queue.then(step).catch((error: unknown) => this.report(String(error)));
    return this.queue;
  }

  private async replaceClient(): Promise<void> {
    await this.stopClient();
    let server;
    try {
      const command = workspace.getConfiguration("rosPreflight").get<unknown>("server.command");
      server = findServer(command, await surroundings(this.log));
    } catch (error) {
      if (!(error instanceof ServerNotFound)) {
        throw error;
      }
      this.report(error.message, ["Open Settings", openSettings]);
      return;
    }
    this.log.info(`Starting ${[server.program, ...server.args].join(" ")} (found in ${server.foundIn})`);
    let started = false;
    const client = createClient(server, this.log, () => {
      if (started && client === this.client) {
        this.died();
      }
    });
    this.client = client;
    // Not awaited: a server that never answers must not keep "Restart Server" waiting.
    client.start().then(
      () => {
        started = true;
      },
      (error: unknown) => {
        if (client === this.client) {
          this.report(`the server did not start: ${String(error)}`);
        }
      },
    );
  }

  private died(): void {
    if (this.policy.allowsRestart()) {
      this.log.warn("The server stopped; it is started again.");
      void this.enqueue(() => this.replaceClient());
    } else {
      const minutes = this.policy.windowMilliseconds / 60_000;
      this.report(`the server stopped ${this.policy.limit + 1} times within ${minutes} minutes and is left stopped.`);
    }
  }

  private async stopClient(): Promise<void> {
    const client = this.client;
    this.client = undefined;
    try {
      await client?.dispose();
    } catch (error) {
      // A client that never came up cannot be stopped in good order; its process is ended all the same.
      this.log.debug(String(error));
    }
  }

  private report(reason: string, more: [string, () => unknown] = ["Show Output", () => this.log.show()]): void {
    this.log.error(reason);
    const [label, action] = more;
    const again = "Restart Server";
    void window.showErrorMessage(`ROS Preflight: ${reason}`, again, label).then((choice) => {
      if (choice === again) {
        return this.restart();
      }
      return choice === label ? action() : undefined;
    });
  }
}

function openSettings(): Thenable<unknown> {
  return commands.executeCommand("workbench.action.openSettings", "rosPreflight.server.command");
}
