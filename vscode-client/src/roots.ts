/** A launch as somebody would start it, and the arguments that its file declares; in the server's own words. */
export interface Root {
  readonly uri: string;
  readonly args: Readonly<Record<string, string>>;
  readonly declared: readonly DeclaredArgument[];
}

export interface DeclaredArgument {
  readonly name: string;
  readonly default: string | null;
  readonly doc: string | null;
  readonly required: boolean;
}

/** The answer to `rosPreflight/roots`: the roots that reach a file, and the one that it is shown in. */
export interface Roots {
  readonly shown: Root | null;
  readonly roots: readonly Root[];
}

/** The answer to `rosPreflight/selectRoot`; `message` says why the file is not shown in that context. */
export interface Selected {
  readonly shown: Root | null;
  readonly message: string | null;
}

/** An entry of the list to choose from. Without a root: back to the usual one. */
export interface Choice {
  readonly label: string;
  readonly description: string;
  readonly root: Root | undefined;
}

/**
 * The roots to choose from, the shown one marked; `shownPath` makes a path out of a URI.
 *
 * The file itself is always among them: any launch file can be launched alone.
 */
export function choices(found: Roots, file: string, shownPath: (uri: string) => string): Choice[] {
  const known = found.roots.some((root) => root.uri === file)
    ? found.roots
    : [...found.roots, { uri: file, args: {}, declared: [] }];
  const listed = known.map((root) => ({
    label: [shownPath(root.uri), ...words(root.args)].join(" "),
    description: [root.uri === file ? "this file" : "", root === found.shown || same(root, found.shown) ? "shown" : ""]
      .filter((word) => word !== "")
      .join(", "),
    root,
  }));
  return [...listed, { label: "Default", description: "what counts where you choose none", root: undefined }];
}

function same(one: Root, other: Root | null): boolean {
  return other !== null && one.uri === other.uri && words(one.args).join(" ") === words(other.args).join(" ");
}

function words(args: Readonly<Record<string, string>>): string[] {
  return Object.entries(args).map(([name, value]) => `${name}:=${quoted(value)}`);
}

function quoted(value: string): string {
  if (value !== "" && !/[\s"']/.test(value)) {
    return value;
  }
  return value.includes('"') ? `'${value}'` : `"${value}"`;
}

/** What stands in the input of arguments at first: those of the root, and those that it needs and does not have. */
export function prefilled(root: Root): string {
  const needed = root.declared.filter(({ name, required }) => required && !(name in root.args));
  return [...words(root.args), ...needed.map(({ name }) => `${name}:=`)].join(" ");
}

/** The other arguments that may be given, for the text below the input. */
export function hint(root: Root): string {
  const more = root.declared.filter(({ name, required }) => !required && !(name in root.args));
  return more.map((argument) => `${argument.name}:=${quoted(argument.default ?? "")}`).join(" ");
}

/** Arguments as typed, `name:=value` with quotes around blanks, or in words for the user what is wrong with them. */
export function parseArguments(typed: string): Record<string, string> | string {
  const args: Record<string, string> = {};
  const word = /\s*([A-Za-z]\w*):=(?:"([^"]*)"|'([^']*)'|([^\s"']*))(?=\s|$)/y;
  const text = typed.trimEnd();
  while (word.lastIndex < text.length) {
    const at = word.lastIndex;
    const found = word.exec(text);
    if (found === null) {
      return `'${text.slice(at).trim()}' is not name:=value`;
    }
    const [, name = "", double, single, plain] = found;
    args[name] = double ?? single ?? plain ?? "";
  }
  return args;
}
