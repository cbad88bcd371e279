import { existsSync } from "node:fs";
import * as path from "node:path";
import {
  commands,
  type ExtensionContext,
  type LogOutputChannel,
  ProgressLocation,
  type WorkspaceFolder,
  window,
  workspace,
} from "vscode";
import { type LanguageClient, NotificationType, State } from "vscode-languageclient/node";
import { Activity } from "./activity";
import { createClient, workspaceTrust } from "./client";
import { findServer, type ServerCommand, ServerNotFound } from "./findServer";
import type { Live } from "./live";
import { notice } from "./messages";
import { InstallFailed, install, installed } from "./privateServer";
import { RestartPolicy } from "./restartPolicy";
import type { Life, ServerStatus } from "./serverStatus";
import { SetupFailed, Setups, setupPaths } from "./setups";
import { isExecutable, pythons, surroundings } from "./surroundings";

// packaging/apply.py writes these lines.
// how to install: begin
const HOW_TO_INSTALL =
  "In a clone of the repository run 'python3 -m venv ~/.ros-preflight && ~/.ros-preflight/bin/python -m pip install . && mkdir -p ~/.local/bin && ln -sf ~/.ros-preflight/bin/ros-preflight ~/.local/bin/'";
// how to install: end

const statusChanged = new NotificationType<ServerStatus>("rosPreflight/status");
const analysed = new NotificationType<object>("rosPreflight/analysed");
const live = new NotificationType<Live>("rosPreflight/live");

/** Who is told what becomes of the server. */
export interface Listener {
  /** The server's life or what it does has changed. */
  changed(life: Life, status: ServerStatus | undefined, last: string): void;
  /** A server runs and can be asked, or there is none any more. */
  connected(client: LanguageClient | undefined): void;
  /** There is something newer to be shown. */
  analysed(): void;
  /** The running system, which is watched, is not what it was. */
  live(live: Live): void;
}

/** Whether the settings name set-ups, for some folder or for the whole window. */
function sourcesSetups(): boolean {
  return [undefined, ...(workspace.workspaceFolders ?? [])].some((folder) => {
    const setting = workspace.getConfiguration("rosPreflight", folder).get<unknown[]>("environment.setup") ?? [];
    return setting.length > 0;
  });
}

type Fact = readonly [what: string, value: string];
type Action = [label: string, perform: () => unknown];

/** The one server of this window: found or installed, started, started again when it dies, stopped. */
export class ServerSession {
  private client: LanguageClient | undefined;
  private policy = new RestartPolicy();
  /** Stops and starts stand in a queue, so that two quick restarts do not leave two servers behind. */
  private queue: Promise<void> = Promise.resolve();
  /** Settles once the last server that was started runs, or is known not to. */
  private started: Promise<void> = Promise.resolve();
  private readonly setups = new Setups();
  private installing: AbortController | undefined;
  private life: Life = { state: "stopped" };
  private status: ServerStatus | undefined;
  private saidThatItDied = false;
  private activity = new Activity();
  /** Where the server was found and what was sourced for it, for the doctor's page. */
  readonly facts: Fact[] = [];

  constructor(
    private readonly context: ExtensionContext,
    private readonly log: LogOutputChannel,
    private readonly listener: Listener,
  ) {}

  /** What the server misses on this machine, once it has looked. */
  get missing(): ServerStatus["missing"] | undefined {
    return this.status?.missing;
  }

  /** Starts the server, stopping one that runs. Never rejects: what goes wrong is shown to the user. */
  restart(): Promise<void> {
    this.policy = new RestartPolicy();
    this.setups.forget();
    this.installing?.abort();
    return this.enqueue(() => this.replaceClient());
  }

  stop(): Promise<void> {
    this.installing?.abort();
    return this.enqueue(() => this.stopClient());
  }

  /** Passes on that the workspace is trusted now; where no server runs, this may be what it takes to find one. */
  async trustGranted(): Promise<void> {
    if (this.client === undefined || this.client.state === State.Stopped || sourcesSetups()) {
      return this.restart();
    }
    try {
      await this.client.sendNotification(workspaceTrust, { trusted: true });
    } catch (error) {
      // The next start passes trust on by itself.
      this.log.debug(`The server was not told of the workspace's trust: ${String(error)}`);
    }
  }

  /** The client tells the server which folders came or went; what to source for them only a new server is told. */
  async foldersChanged(): Promise<void> {
    if (sourcesSetups()) {
      await this.restart();
    }
  }

  /**
   * Calls `work` with the client of a running server; what goes wrong is shown to the user. A server that is being
   * started is waited for, as after a setting was changed; one that is being installed takes too long for that.
   */
  async withClient(work: (client: LanguageClient) => Promise<void>): Promise<void> {
    if (this.life.state === "installing") {
      this.report(this.life.reason);
      return;
    }
    await this.queue;
    await this.started;
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
    this.queue = this.queue.then(step).catch((error: unknown) => this.fail(String(error)));
    return this.queue;
  }

  private async replaceClient(): Promise<void> {
    await this.stopClient();
    this.facts.length = 0;
    this.notify({ state: "starting" });
    const server = await this.server();
    if (server === undefined) {
      return;
    }
    const [first, ...others] = workspace.workspaceFolders ?? [];
    const environment = await this.environment(first);
    const environments: Record<string, NodeJS.ProcessEnv> = {};
    for (const folder of others) {
      const own = await this.environment(folder);
      if (own !== environment) {
        environments[folder.uri.toString()] = own;
      }
    }
    this.log.info(`Starting ${[server.program, ...server.args].join(" ")} (found in ${server.foundIn})`);
    this.facts.push(["server", `${[server.program, ...server.args].join(" ")} (found in ${server.foundIn})`]);
    this.activity = new Activity();
    const begun = Date.now();
    let started = false;
    const client = createClient(server, environment, environments, this.log, () => {
      if (started && client === this.client) {
        this.died();
      }
    });
    this.client = client;
    client.onNotification(statusChanged, (status) => {
      if (client === this.client) {
        this.status = status;
        for (const line of this.activity.next(status, Date.now())) {
          this.log.info(line);
        }
        this.notify({ state: "running" });
      }
    });
    client.onNotification(analysed, () => this.listener.analysed());
    client.onNotification(live, (state) => this.listener.live(state));
    // Not awaited: a server that never answers must not keep "Restart Server" waiting.
    this.started = client.start().then(
      () => {
        if (client === this.client) {
          started = true;
          this.log.info(`The server answered after ${((Date.now() - begun) / 1000).toFixed(1)} s.`);
          this.notify({ state: "running" });
          this.listener.connected(client);
        }
      },
      (error: unknown) => {
        if (client === this.client) {
          this.fail(`the server did not start: ${String(error)}`);
        }
      },
    );
  }

  /** The server to start: found, or installed. Where there is none, the user is told. */
  private async server(): Promise<ServerCommand | undefined> {
    const settings = workspace.getConfiguration("rosPreflight");
    try {
      const found = findServer(settings.get<unknown>("server.command"), surroundings());
      return found ?? (await this.privateServer(settings.get<boolean>("server.install") !== false));
    } catch (error) {
      if (error instanceof ServerNotFound) {
        this.fail(error.message, ["Open Settings", () => openSettings("rosPreflight.server.command")]);
      } else if (error instanceof InstallFailed) {
        this.fail(
          error.message,
          ["Show Log", () => this.log.show()],
          ["Choose Python", () => commands.executeCommand("rosPreflight.choosePython")],
          ["Set Path", () => commands.executeCommand("rosPreflight.setServerPath")],
        );
      } else {
        throw error;
      }
      return undefined;
    }
  }

  private async privateServer(mayInstall: boolean): Promise<ServerCommand> {
    const storage = this.context.globalStorageUri.fsPath;
    const requirements = bundledRequirements(this.context.extensionPath);
    const known = requirements === undefined ? undefined : installed(storage, requirements, isExecutable);
    const nowhere = "the command ros-preflight was not found on PATH or in ~/.local/bin";
    if (known === undefined && (requirements === undefined || !mayInstall)) {
      throw new InstallFailed(`${nowhere}. ${HOW_TO_INSTALL}, or name it in the settings.`);
    }
    const [program = "", ...args] = known ?? (await this.install(storage, requirements ?? ""));
    return { program, args: [...args, "lsp"], foundIn: "the extension's own virtual environment" };
  }

  private async install(storage: string, requirements: string): Promise<string[]> {
    const candidates = pythons();
    const abort = new AbortController();
    this.installing = abort;
    this.notify({ state: "installing", reason: "Installing the server in its own environment." });
    const options = { location: ProgressLocation.Notification, title: "ROS Preflight", cancellable: true };
    return window.withProgress(options, (progress, token) => {
      token.onCancellationRequested(() => abort.abort());
      return install(candidates, {
        storage,
        requirements,
        environment: process.env,
        line: (text) => this.log.info(text),
        step: (what) => progress.report({ message: what }),
        signal: abort.signal,
      });
    });
  }

  /** What a folder is looked at in: this process's environment, with what the user's set-ups make of it. */
  private async environment(folder: WorkspaceFolder | undefined): Promise<NodeJS.ProcessEnv> {
    const setting = workspace.getConfiguration("rosPreflight", folder).get<unknown>("environment.setup");
    try {
      const files = setupPaths(setting, folder?.uri.fsPath);
      // Sourcing a file is running it, and what it sources in turn may be the workspace's.
      if (files.length > 0 && !workspace.isTrusted) {
        this.log.info("The set-ups of the settings are sourced once the workspace is trusted.");
        this.facts.push(["set-ups", "not sourced: the workspace is not trusted"]);
        return process.env;
      }
      const environment = await this.setups.environment(files, process.env, (line) => this.log.info(line));
      this.facts.push(...files.map((file): Fact => ["set-up", `${file}, sourced`]));
      return environment;
    } catch (error) {
      if (!(error instanceof SetupFailed)) {
        throw error;
      }
      this.facts.push(["set-ups", `not sourced: ${error.message}`]);
      this.report(
        error.message,
        ["Show Log", () => this.log.show()],
        ["Open Settings", () => openSettings("rosPreflight.environment.setup")],
      );
      return process.env;
    }
  }

  private died(): void {
    this.listener.connected(undefined);
    if (this.policy.allowsRestart()) {
      this.log.warn("The server stopped; it is started again.");
      if (!this.saidThatItDied) {
        this.saidThatItDied = true;
        const show = "Show Log";
        void window
          .showWarningMessage(notice("the server stopped unexpectedly and restarts."), show)
          .then((choice) => (choice === show ? this.log.show() : undefined));
      }
      void this.enqueue(() => this.replaceClient());
    } else {
      const minutes = this.policy.windowMilliseconds / 60_000;
      this.fail(`the server stopped ${this.policy.limit + 1} times within ${minutes} minutes and is left stopped.`);
    }
  }

  private async stopClient(): Promise<void> {
    const client = this.client;
    this.client = undefined;
    this.status = undefined;
    if (client !== undefined) {
      this.listener.connected(undefined);
      this.notify({ state: "stopped" });
    }
    try {
      await client?.dispose();
    } catch (error) {
      // A client that never came up cannot be stopped in good order; its process is ended all the same.
      this.log.debug(String(error));
    }
  }

  private notify(life: Life): void {
    this.life = life;
    this.listener.changed(this.life, this.status, this.activity.last);
  }

  /** There is no server, and the user is told why. */
  private fail(reason: string, ...actions: Action[]): void {
    this.notify({ state: "missing", reason });
    this.report(reason, ...(actions.length > 0 ? actions : [["Show Log", () => this.log.show()] as Action]));
  }

  private report(reason: string, ...actions: Action[]): void {
    this.log.error(reason);
    const offered: Action[] = [["Restart Server", () => this.restart()], ...actions];
    const labels = offered.map(([label]) => label);
    void window
      .showErrorMessage(notice(reason), ...labels)
      .then((choice) => offered.find(([label]) => label === choice)?.[1]());
  }
}

/** What the server is installed with, which `make vsix` put into the extension. */
function bundledRequirements(extension: string): string | undefined {
  const file = path.join(extension, "server", "requirements.txt");
  return existsSync(file) ? file : undefined;
}

function openSettings(name: string): Thenable<unknown> {
  return commands.executeCommand("workbench.action.openSettings", name);
}
