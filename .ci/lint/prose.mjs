// Checks what users read: phrases and spellings of terms.json, and the length of sentences.
// Arguments: Markdown files, or - for a JSON list of {"place", "text"} on standard input. Ends with 1 on a finding.
import { readFileSync } from "node:fs";
import { TextlintKernel } from "@textlint/kernel";
import plugin from "@textlint/textlint-plugin-markdown";
import { split } from "sentence-splitter";

const markdown = plugin.default ?? plugin; // a CommonJS module

const { phrases, spelling, words, longer } = JSON.parse(readFileSync(new URL("terms.json", import.meta.url), "utf8"));
const TERMS = [
  ...phrases.map(({ avoid, write }) => ({ pattern: new RegExp(avoid, "gi"), write })),
  ...spelling.map(({ avoid, write }) => ({ pattern: new RegExp(avoid, "g"), write })),
];

/** The text of a node without its mark-up, and the place in the source of each of its characters. */
function flattened(node) {
  let text = "";
  const places = [];
  const add = (piece, start, isOneToOne) => {
    text += piece;
    for (let at = 0; at < piece.length; at++) {
      places.push(isOneToOne ? start + at : start);
    }
  };
  const visit = (each) => {
    if (each.type === "Str") {
      add(each.value.replaceAll("\n", " "), each.range[0], true);
    } else if (each.type === "Code") {
      add("x", each.range[0], false); // one word, whatever is in it
    } else if (each.type === "Break") {
      add(" ", each.range[0], false);
    } else if (each.type !== "Html" && each.type !== "Image") {
      for (const child of each.children ?? []) {
        visit(child);
      }
    }
  };
  visit(node);
  return { text, places };
}

function sentences(text) {
  return split(text).filter((each) => each.type === "Sentence");
}

/** Whether a text may have longer sentences: `longer` of terms.json lists these files and folders. */
let isLonger = false;

function rule({ Syntax, RuleError, report }) {
  function check(node) {
    const { text, places } = flattened(node);
    const say = (message, at) => report(node, new RuleError(message, { index: places[at] - node.range[0] }));
    for (const { pattern, write } of TERMS) {
      for (const found of text.matchAll(pattern)) {
        say(`'${found[0]}': write ${write}`, found.index);
      }
    }
    for (const sentence of sentences(text)) {
      const count = sentence.raw.split(/\s+/).filter((word) => /[\p{L}\p{N}]/u.test(word)).length;
      if (count > words && !isLonger) {
        say(`a sentence of ${count} words: at most ${words}`, sentence.range[0]);
      }
    }
  }
  return { [Syntax.Paragraph]: check, [Syntax.Header]: check, [Syntax.TableCell]: check };
}

const kernel = new TextlintKernel();

async function findings(text) {
  const { messages } = await kernel.lintText(text, {
    ext: ".md",
    plugins: [{ pluginId: "markdown", plugin: markdown }],
    rules: [{ ruleId: "terms", rule }],
  });
  return messages;
}

for (const path of process.argv.slice(2)) {
  const isList = path === "-";
  const texts = isList ? JSON.parse(readFileSync(0, "utf8")) : [{ place: path, text: readFileSync(path, "utf8") }];
  for (const { place, text } of texts) {
    isLonger = longer.some((each) => place.startsWith(each));
    for (const { loc, message } of await findings(text)) {
      console.error(`${place}${isList ? "" : `:${loc.start.line}:${loc.start.column}`}: ${message}`);
      process.exitCode = 1;
    }
  }
}
