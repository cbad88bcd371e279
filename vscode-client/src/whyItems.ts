import type { Location } from "vscode-languageserver-types";
import { plain } from "./messages";

/** One condition of a connection, in the server's own words (`rosPreflight/why`). */
export interface Link {
  readonly state: "ok" | "broken" | "unknown";
  readonly text: string;
  readonly location: Location | null;
  /** The titles of the quick fixes for it. */
  readonly fixes: readonly string[];
}

/** From the one node to the other over one topic, service or action, or from the launch file to one node. */
export interface Chain {
  readonly title: string;
  readonly links: readonly Link[];
}

/** The answer: the nodes that may be asked for, the one at the cursor, and what was asked. */
export interface Reasons {
  readonly all: readonly string[];
  readonly at: string | null;
  readonly chains: readonly Chain[];
  readonly message: string | null;
}

/** A line to choose from; one without a link is the title of one of several chains. */
export interface ReasonItem {
  readonly label: string;
  readonly description?: string;
  readonly detail?: string;
  readonly link?: Link;
}

const ICONS = { ok: "$(pass)", broken: "$(error)", unknown: "$(question)" } as const;

/** The lines of chains: of several the title of each, then its links in their order. */
export function reasonItems(chains: readonly Chain[], shown: (location: Location) => string): ReasonItem[] {
  return chains.flatMap((chain) => [
    ...(chains.length > 1 ? [{ label: literal(chain.title) }] : []),
    ...chain.links.map((link) => ({
      label: `${ICONS[link.state]} ${literal(link.text)}`,
      ...(link.location === null ? {} : { description: shown(link.location) }),
      ...(link.fixes.length === 0 ? {} : { detail: literal(`Quick fix: ${link.fixes.join("; ")}`) }),
      link,
    })),
  ]);
}

/** Text in which `$(name)` is no icon. */
function literal(text: string): string {
  return plain(text).replaceAll(/\$\([\w-]+(~[\w-]+)?\)/g, "\\$&");
}

/** The nodes that the second one may be: those at the other end of a channel first, never the first one itself. */
export function partners(all: readonly string[], first: string, others: readonly string[]): string[] {
  const near = new Set(others);
  const rest = all.filter((name) => name !== first && !near.has(name));
  return [...others.filter((name) => name !== first && all.includes(name)), ...rest];
}
