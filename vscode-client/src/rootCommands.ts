import { commands, Uri, window, workspace } from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { notice, plain } from "./messages";
import { type Choice, choices, hint, parseArguments, prefilled, type Roots, type Selected } from "./roots";

type Positioned = Parameters<LanguageClient["protocol2CodeConverter"]["asPosition"]>[0];
type Located = Parameters<LanguageClient["protocol2CodeConverter"]["asLocation"]>[0];

/** A place in a file and the places that refer to it, as the server gives them. */
export type Place = [uri: string, position: Positioned, locations: Located[]];

/** The commands that the server may put into its answers, since this editor carries them out. */
export const clientCommands = [
  "rosPreflight.showReferences",
  "rosPreflight.selectRoot",
  "workbench.trust.manage",
  "editor.action.triggerSuggest",
];

/** Shows the places that a code lens counts. */
export async function showReferences(client: LanguageClient, ...[uri, position, locations]: Place): Promise<void> {
  const { asPosition, asLocation } = client.protocol2CodeConverter;
  await commands.executeCommand(
    "editor.action.showReferences",
    Uri.parse(uri),
    asPosition(position),
    locations.map((location) => asLocation(location)),
  );
}

/** Lets the user choose the root, and its arguments, in whose context a file is shown. */
export async function selectRoot(client: LanguageClient, uri: string): Promise<void> {
  const found = await client.sendRequest<Roots>("rosPreflight/roots", { uri });
  const shownPath = (of: string) => workspace.asRelativePath(Uri.parse(of));
  const choice = await window.showQuickPick<Choice>(choices(found, uri, shownPath), {
    title: plain(`Analyse ${shownPath(uri)} as launched by`),
  });
  if (choice === undefined) {
    return;
  }
  const root = choice.root;
  const args = root && (await askArguments(choice.label, prefilled(root), hint(root)));
  if (root !== undefined && args === undefined) {
    return;
  }
  const selected = await client.sendRequest<Selected>("rosPreflight/selectRoot", {
    uri,
    root: root === undefined ? null : { uri: root.uri, args },
  });
  if (selected.message !== null) {
    void window.showWarningMessage(notice(selected.message));
  }
}

async function askArguments(label: string, value: string, more: string): Promise<Record<string, string> | undefined> {
  const typed = await window.showInputBox({
    title: plain(`Arguments of ${label}`),
    prompt: more === "" ? "name:=value ..." : plain(`name:=value ...; defaults: ${more}`),
    value,
    valueSelection: [value.length, value.length],
    validateInput: (text) => {
      const parsed = parseArguments(text);
      return typeof parsed === "string" ? plain(parsed) : undefined;
    },
  });
  const parsed = typed === undefined ? undefined : parseArguments(typed);
  return typeof parsed === "string" ? undefined : parsed;
}
