/** A filter on documents, in the form that both the editor and the language client take. */
interface LanguageFilter {
  readonly scheme: string;
  readonly language: string;
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

/** The documents that the server is told of: launch files, and what may be a parameter file of their nodes. */
export const servedFiles: readonly LanguageFilter[] = [...launchFiles, { scheme: "file", language: "yaml" }];
