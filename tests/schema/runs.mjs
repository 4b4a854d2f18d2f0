// The runs of the transcripts (see cmd/transcripts.py) that can be told without a shell: their arguments and input, and what
// they print.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

/// The words of a line, "|" and "<" among them; nothing where a shell does more than put words together.
function wordsOf(line) {
  const kPart = /'([^']*)'|"([^"$`\\]*)"|(\||<(?!<))|([^\s'"|<>$`\\;&*?()]+)|(\s+)/y;
  const words = [];
  let word;
  const end = () => void (word !== undefined && words.push(word), (word = undefined));
  for (let part; kPart.lastIndex < line.length; ) {
    if (!(part = kPart.exec(line))) return undefined;
    const [, single, double, sign, plain, blank] = part;
    if (sign || blank) end();
    if (sign) words.push({ sign });
    else if (!blank) word = (word ?? "") + (single ?? double ?? plain);
  }
  end();
  return words;
}

/// What a command before the pipe prints, or nothing.
function printed([program, ...words]) {
  if (program === "echo") return words.join(" ");
  if (program !== "printf" || words.length === 0 || /%|\\[^n]/.test(words[0].replace(/^%s\\n$/, ""))) return undefined;
  return words[0] === "%s\\n" ? words.slice(1).join("\n") : words[0].replaceAll("\\n", "\n");
}

/// The run that a line is, or nothing. fileOf: the text of a file, or nothing; withValue: the options that take one.
function runOf(line, fileOf, withValue) {
  const words = wordsOf(line);
  if (!words) return undefined;
  const stages = [[]];
  for (const word of words) word.sign === "|" ? stages.push([]) : stages.at(-1).push(word);
  const [program, command, ...args] = stages.pop();
  if (program !== "viewproj" || stages.length > 1) return undefined;
  const run = { command, options: {}, flags: new Set(), files: [] };
  let input = stages.length ? printed(stages[0]) : undefined;
  for (let i = 0; i < args.length; ++i) {
    if (args[i].sign) input = fileOf(args[++i]);
    else if (withValue.has(args[i])) run.options[args[i] === "-c" ? "--camera" : args[i]] = args[++i];
    else if (args[i].startsWith("--") && args[i].includes("=")) run.options[args[i].split("=")[0]] = args[i].replace(/^[^=]*=/, "");
    else if (args[i].startsWith("-") && args[i] !== "-") run.flags.add(args[i]);
    else run.files.push(args[i]);
  }
  run.text = (given) => {
    if (given === undefined || given === "-") return input;
    return given.trimStart().startsWith("{") ? given : fileOf(given.replace(/#.*$/, ""));
  };
  return run;
}

/// help: what `viewproj help --json` prints.
export function readRuns(folder, help) {
  const options = help.commands.flatMap((command) => command.options);
  const withValue = new Set(options.filter((option) => option.value).flatMap((option) => option.names));
  const runs = [];
  for (const name of readdirSync(folder).filter((name) => name.endsWith(".txt"))) {
    let files, lines; // of the case; and those that a file or an output has
    const fileOf = (file) => {
      if (files.has(file)) return files.get(file).join("\n");
      const beside = file.startsWith("../") && join(folder, file.slice(3));
      return beside && existsSync(beside) ? readFileSync(beside, "utf8").replace(/^\uFEFF/, "") : undefined;
    };
    for (const line of readFileSync(join(folder, name), "utf8").split("\n")) {
      const mark = line.slice(0, 2), output = [];
      if (mark === "==") files = new Map();
      else if (mark === "--") files.set(line.slice(3), (lines = output));
      else if (mark === "$ ") {
        const run = runOf(line.slice(2), fileOf, withValue);
        lines = output;
        if (run) runs.push({ ...run, lines });
      } else if (mark === "> " && runs.at(-1)?.lines === lines) runs.pop();
      else if (mark === "  " || line === "") lines?.push(line.slice(2).replace(/ \(no-eol\)$/, ""));
    }
  }
  return runs.map((run) => ({ ...run, output: run.lines.join("\n") }));
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
