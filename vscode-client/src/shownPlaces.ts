import { realpathSync, statSync } from "node:fs";
import * as path from "node:path";
import type { Place } from "./pageMessages";

/** What of the server's graph leads to places; the page knows the rest. */
export interface Graph {
  readonly title: string;
  readonly files: readonly { readonly path: string }[];
  readonly nodes: readonly { readonly places: readonly Place[] }[];
  readonly edges: readonly { readonly places: readonly Place[] }[];
}

/** The workspace's own files are opened at once, others once the user says so, and what is no file never. */
export type Belongs = "workspace" | "elsewhere" | "nowhere";

const LAUNCH_FILE = /\.(launch|test|xml|ya?ml|py)$/;

/** The places that the shown graph has: a page that somebody else speaks through can name no others. */
export class ShownPlaces {
  private readonly keys: ReadonlySet<string>;
  private readonly launchFiles: ReadonlySet<string>;

  constructor(graph?: Graph) {
    const places = [...(graph?.nodes ?? []), ...(graph?.edges ?? [])].flatMap((each) => each.places);
    this.keys = new Set(places.map(keyOf));
    this.launchFiles = new Set(graph?.files.map((file) => file.path));
  }

  has(place: Place): boolean {
    return this.keys.has(keyOf(place));
  }

  /**
   * Whether a file is in one of these folders, or a launch file that is included from elsewhere: by its real path, as
   * links of a workspace lead anywhere. A source's path is what its node reported, which may be any file of the machine.
   */
  belongs(file: string, folders: readonly string[]): Belongs {
    try {
      const real = realpathSync(file);
      if (!statSync(real).isFile()) {
        return "nowhere";
      }
      const isWithin = folders.some((folder) => isVisible(path.relative(realpathSync(folder), real)));
      const isLaunched = this.launchFiles.has(file) && LAUNCH_FILE.test(real) && isVisible(path.relative("/", real));
      return isWithin || isLaunched ? "workspace" : "elsewhere";
    } catch {
      return "nowhere"; // it is gone, or not to be looked at
    }
  }
}

function keyOf({ file, line, column }: Place): string {
  return JSON.stringify([file, line, column]);
}

/** Whether a path leads neither out of its folder nor through hidden ones, such as `.git`. */
function isVisible(relative: string): boolean {
  return (
    relative !== "" && !path.isAbsolute(relative) && !relative.split(path.sep).some((part) => part.startsWith("."))
  );
}
