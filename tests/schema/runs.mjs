// The recorded runs of the tool (see record.cpp): what they read and printed.
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { join, resolve } from "node:path";

const kLargest = 300000;
const kWithValue = new Set(
  ("-c --camera --viewport --set --read-as --convention --ndc-z --which --to --type --from --columns --prefix --jobs " +
    "--first-line --precision --tolerance --fields --model --point --pixel --ray-from --scene --at --gap --resolve " +
    "--format --seconds --digits --world --reading --float-digits --depth --map --scale --margin --pixels --by -o --output " +
    "--delimiter --decimal --comment").split(" "),
);

/// The text of a file that is not too large, or nothing.
export function textOf(file) {
  if (!existsSync(file)) return undefined;
  const status = statSync(file);
  if (!status.isFile() || status.size > kLargest) return undefined;
  return readFileSync(file, "utf8").replace(/^\uFEFF/, "");
}

export function readRuns(folder) {
  return readdirSync(folder).map((name) => {
    const at = (part) => join(folder, name, part);
    const [command, ...args] = readFileSync(at("args"), "utf8").split("\0").slice(0, -1);
    const run = { command, options: {}, flags: new Set(), files: [], folder: readFileSync(at("cwd"), "utf8").trim() };
    for (let i = 0; i < args.length; ++i) {
      if (kWithValue.has(args[i])) run.options[args[i] === "-c" ? "--camera" : args[i]] = args[++i];
      else if (args[i].startsWith("--") && args[i].includes("=")) run.options[args[i].split("=")[0]] = args[i].replace(/^[^=]*=/, "");
      else if (args[i].startsWith("-") && args[i] !== "-") run.flags.add(args[i]);
      else run.files.push(args[i]);
    }
    const standardInput = () => textOf(at("in"));
    run.text = (given) => {
      if (given === undefined || given === "-") return standardInput();
      if (given.trimStart().startsWith("{")) return given;
      return textOf(resolve(run.folder, given.replace(/#.*$/, "")));
    };
    run.status = existsSync(at("status")) ? Number(readFileSync(at("status"), "utf8")) : NaN;
    run.output = textOf(at("out")) ?? "";
    return run;
  });
}

/// The values of a JSON sequence, as text; nothing if it is none.
export function valuesOf(text) {
  const values = [];
  let depth = 0, begin = -1, inString = false;
  for (let i = 0; i < text.length; ++i) {
    const c = text[i];
    if (inString) {
      if (c === "\\") ++i;
      else if (c === '"') inString = false;
    } else if (c === '"') inString = true;
    else if (c === "{" || c === "[") {
      if (depth++ === 0) begin = i;
    } else if (c === "}" || c === "]") {
      if (--depth === 0) values.push(text.slice(begin, i + 1));
      if (depth < 0) return undefined;
    } else if (depth === 0 && !/\s/.test(c)) return undefined;
    if (inString && depth === 0) return undefined;
  }
  return depth === 0 ? values : undefined;
}

export function parsed(text) {
  try {
    return { value: JSON.parse(text) };
  } catch {
    return undefined;
  }
}
