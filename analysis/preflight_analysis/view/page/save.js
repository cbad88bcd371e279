// The picture as a file of its own.
import { editor, element, make, state } from "./page.js";

export function save() {
  const copy = /** @type {SVGElement} */ (state.svg.cloneNode(true));
  for (const part of copy.querySelectorAll(".off")) {
    part.remove();
  }
  copy.setAttribute("width", String(state.drawn.width));
  copy.setAttribute("height", String(state.drawn.height));
  copy.classList.remove("lit");
  const style = document.createElementNS("http://www.w3.org/2000/svg", "style");
  // A file has no editor around it: the colours of this moment.
  const colours = getComputedStyle(document.documentElement);
  const drawing = element("drawing").textContent ?? "";
  const names = [...new Set(drawing.match(/--[a-z0-9]+(?=:)/g))].filter((name) => name !== "--line");
  const rules = drawing.replace(/^:root \{[^}]*\}|^@media[\s\S]*?\n\}\n|^:root\[[^}]*\}/gm, "");
  const values = names.map((name) => `${name}: ${colours.getPropertyValue(name).trim()};`);
  style.textContent = `:root { ${values.join(" ")} }\n${rules}`;
  copy.prepend(style);
  const text = `<?xml version="1.0" encoding="utf-8"?>\n${new XMLSerializer().serializeToString(copy)}\n`;
  if (editor !== undefined) {
    editor.postMessage({ type: "save", svg: text });
    return;
  }
  const blob = new Blob([text], { type: "image/svg+xml" });
  const link = make("a", { href: URL.createObjectURL(blob), download: "graph.svg" });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
