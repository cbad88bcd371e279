/** The files of the page that `ros-preflight graph --format html` writes too; the bundle has copies of them. */
export type PageFile = "page.html" | "drawing.css" | "view.css" | "view.js";

/** The page for a webview. Only what carries the nonce counts, and nothing is fetched. */
export function graphPage(read: (file: PageFile) => string, nonce: string): string {
  const parts: Record<string, string> = {
    POLICY: `default-src 'none'; style-src 'nonce-${nonce}'; script-src 'nonce-${nonce}'; base-uri 'none'; form-action 'none'`,
    TITLE: "ROS graph",
    NONCE: ` nonce="${nonce}"`,
    DRAWING: read("drawing.css"),
    STYLE: read("view.css"),
    SCRIPT: read("view.js"),
    DATA: "null",
  };
  // `%NAME%` at every other place: what is put in is not looked at again.
  return read("page.html")
    .split("%")
    .map((text, i) => (i % 2 === 0 ? text : (parts[text] ?? "")))
    .join("");
}

/** The UTF-16 offset in a line of a column in code points, counted from 1. */
export function utf16Column(line: string, column: number): number {
  return [...line].slice(0, Math.max(0, column - 1)).join("").length;
}
