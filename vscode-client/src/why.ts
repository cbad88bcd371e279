import { commands, type Position, Range, Uri, window, workspace } from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import type { Location } from "vscode-languageserver-types";
import { notice, plain } from "./messages";
import { partners, type Reasons, reasonItems } from "./whyItems";

/** Which connection to explain; what is left out is the user's choice. */
export interface Question {
  readonly uri: string;
  readonly node?: string;
  readonly position?: Position;
  readonly channel?: string;
  /** The nodes at the other end of the channel. */
  readonly others?: readonly string[];
}

/** Explains, link by link, why two nodes are connected or not, or why one is started. */
export async function why(client: LanguageClient, question: Question): Promise<void> {
  const known = await ask(client, question, []);
  if (known === null || known.all.length === 0) {
    void window.showWarningMessage(notice("no node is known of this file's launch."));
    return;
  }
  const first = question.node ?? known.at ?? (await pick(known.all, "Explain the connection of which node?"));
  if (first === undefined) {
    return;
  }
  const second = await secondNode(known, first, question.others ?? []);
  if (second === undefined) {
    return;
  }
  const answer = await ask(client, question, second === first ? [first] : [first, second]);
  if (answer === null || answer.message !== null) {
    void window.showWarningMessage(notice(answer?.message ?? "not a launch file, or unreadable"));
    return;
  }
  await show(client, answer);
}

/** The other node of a connection; the first one again stands for the question why that is started. */
async function secondNode(known: Reasons, first: string, others: readonly string[]): Promise<string | undefined> {
  if (others.length === 1) {
    return others[0];
  }
  const start = { label: plain(`Why is ${first} started?`), name: first };
  const found = partners(known.all, first, others).map((name) => ({ label: plain(name), name }));
  const title = plain(`Connection of ${first} with`);
  return (await window.showQuickPick([...found, start], { title }))?.name;
}

async function pick(names: readonly string[], title: string): Promise<string | undefined> {
  const items = names.map((name) => ({ label: plain(name), name }));
  return (await window.showQuickPick(items, { title }))?.name;
}

function ask(client: LanguageClient, question: Question, nodes: readonly string[]): Promise<Reasons | null> {
  const { uri, position, channel } = question;
  return client.sendRequest<Reasons | null>("rosPreflight/why", {
    uri,
    nodes,
    ...(position === undefined ? {} : { position: client.code2ProtocolConverter.asPosition(position) }),
    ...(channel === undefined ? {} : { channel }),
  });
}

async function show(client: LanguageClient, answer: Reasons): Promise<void> {
  const place = (location: Location) =>
    `${workspace.asRelativePath(Uri.parse(location.uri))}:${location.range.start.line + 1}`;
  const items = reasonItems(answer.chains, place);
  const title = plain(answer.chains.length === 1 ? (answer.chains[0]?.title ?? "") : "Connections");
  const chosen = await window.showQuickPick(items, { title, placeHolder: "Choose a link to go to its line" });
  if (chosen?.link?.location) {
    const { uri, range } = client.protocol2CodeConverter.asLocation(chosen.link.location);
    await commands.executeCommand("vscode.open", uri, { selection: new Range(range.start, range.start) });
  }
}
