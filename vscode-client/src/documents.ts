/** A filter on documents, in the form that both the editor and the language client take. */
interface LanguageFilter {
  readonly scheme: string;
  readonly language?: string;
  readonly pattern?: string;
}

/**
 * Launch files: the first one that is open starts the server.
 *
 * Many users have associated `*.launch` with XML in their settings, and a `.test` file that starts with an XML
 * declaration is taken for XML too: those are launch files all the same.
 *
 * Of the Python files in a `launch` folder the server takes those that make a launch description, whatever their names.
 */
export const launchFiles: readonly LanguageFilter[] = [
  { scheme: "file", language: "roslaunch" },
  { scheme: "file", language: "xml", pattern: "**/*.{launch,launch.xml,test}" },
  { scheme: "file", language: "xml", pattern: "**/*_launch.xml" },
  { scheme: "file", language: "yaml", pattern: "**/*{.,_}launch.{yaml,yml}" },
  { scheme: "file", language: "python", pattern: "**/*launch.py" },
  { scheme: "file", language: "python", pattern: "**/launch/**/*.py" },
];

/** What says how a package is built: what is wrong there is shown once the server has started. */
const buildFiles = { scheme: "file", pattern: "**/{CMakeLists.txt,setup.py,setup.cfg}" };

/** Robot descriptions, which start the server too. Extensions call their language `xml`, `xacro` or `urdf`. */
const robotDescriptions = { scheme: "file", pattern: "**/*.{xacro,urdf,srdf}" };

/**
 * The documents that the server is told of: launch files, what they may hand to their nodes, and build files. Which YAML is a
 * parameter file, and which XML a behavior tree, the server knows; all other it leaves alone.
 */
export const servedFiles: readonly LanguageFilter[] = [
  ...launchFiles,
  robotDescriptions,
  buildFiles,
  { scheme: "file", language: "yaml" },
  { scheme: "file", language: "xml" },
];

/** What starts the server, beside behavior trees, which only their text tells from other XML. */
export const startingFiles: readonly LanguageFilter[] = [...launchFiles, robotDescriptions];

const TREE = /<BehaviorTree\b/;
const TREE_REACH = 20_000;

/** Whether the text of an XML file is a behavior tree: its beginning says so. */
export function isBehaviorTree(text: string): boolean {
  return TREE.test(text.slice(0, TREE_REACH));
}
