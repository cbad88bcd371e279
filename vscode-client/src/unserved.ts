import { type Disposable, LanguageStatusSeverity, languages } from "vscode";
import { whyUnserved } from "./unservedReasons";

/** Launch files that the server cannot look at say so, and why, in the status of their language. */
export function registerUnserved(): Disposable {
  const items = Object.entries(whyUnserved).map(([scheme, reason]) => {
    const selector = [
      { scheme, language: "roslaunch" },
      { scheme, pattern: "**/*{.,_}launch.{py,xml,yaml,yml}" },
    ];
    const item = languages.createLanguageStatusItem(`rosPreflight.unserved.${scheme}`, selector);
    item.name = "ROS Preflight";
    item.text = "ROS Preflight: not checked";
    item.detail = reason;
    item.severity = LanguageStatusSeverity.Warning;
    return item;
  });
  return { dispose: () => items.forEach((item) => item.dispose()) };
}
