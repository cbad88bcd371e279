// Formats Lua files, or with --check says which are not formatted and ends with 1. StyLua's own command would be
// fetched from outside of the registry; its library is WebAssembly, and the same on every machine.
import { readFileSync, writeFileSync } from "node:fs";
import { Config, formatCode, IndentType, LuaVersion, OutputVerification, QuoteStyle } from "@johnnymorganz/stylua";

const [first, ...rest] = process.argv.slice(2);
const isCheck = first === "--check";
for (const path of isCheck ? rest : [first, ...rest]) {
  const config = Config.new();
  config.column_width = 120;
  config.indent_type = IndentType.Spaces;
  config.indent_width = 2;
  config.quote_style = QuoteStyle.AutoPreferSingle;
  config.syntax = LuaVersion.LuaJIT;
  const text = readFileSync(path, "utf8");
  const formatted = formatCode(text, config, undefined, OutputVerification.Full);
  if (formatted === text) {
    continue;
  }
  if (isCheck) {
    console.error(`${path} is not formatted: make format`);
    process.exitCode = 1;
  } else {
    writeFileSync(path, formatted);
  }
}
