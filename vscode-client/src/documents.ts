/** A filter on documents, in the form that both the editor and the language client take. */
interface LanguageFilter {
  readonly scheme: string;
  readonly language: string;
  readonly pattern?: string;
}

/**
 * The documents that the server is told of.
 *
 * Many users have associated `*.launch` with XML in their settings, and a `.test` file that starts with an XML
 * declaration is taken for XML too: those are launch files all the same.
 */
export const launchFiles: readonly LanguageFilter[] = [
  { scheme: "file", language: "roslaunch" },
  { scheme: "file", language: "xml", pattern: "**/*.{launch,launch.xml,test}" },
];
