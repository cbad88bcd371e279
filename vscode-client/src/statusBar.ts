import { type Disposable, StatusBarAlignment, ThemeColor, window } from "vscode";
import { type Life, type ServerStatus, shown, showsTrustBadge } from "./serverStatus";

/** The extension's two entries in the status bar: what the server does, and that the workspace is not trusted. */
export class StatusBar implements Disposable {
  private readonly main = window.createStatusBarItem("rosPreflight.status", StatusBarAlignment.Left, 1);
  private readonly badge = window.createStatusBarItem("rosPreflight.trust", StatusBarAlignment.Left, 0.9);

  constructor() {
    this.main.name = "ROS Preflight";
    this.main.command = "rosPreflight.showMenu";
    this.badge.name = "ROS Preflight: Workspace Trust";
    this.badge.text = "$(shield) Not trusted: nodes are not run";
    this.badge.tooltip =
      "Launch files are checked. Nothing from this workspace is executed. Click to manage Workspace Trust.";
    this.badge.backgroundColor = new ThemeColor("statusBarItem.warningBackground");
    this.badge.command = "workbench.trust.manage";
  }

  update(life: Life, status: ServerStatus | undefined, last: string): void {
    const { text, tooltip, severity } = shown(life, status, last);
    this.main.text = text;
    this.main.tooltip = tooltip;
    this.main.backgroundColor = severity === "none" ? undefined : new ThemeColor(`statusBarItem.${severity}Background`);
    this.main.show();
    if (showsTrustBadge(life, status)) {
      this.badge.show();
    } else {
      this.badge.hide();
    }
  }

  dispose(): void {
    this.main.dispose();
    this.badge.dispose();
  }
}
