// What is printed is what the schema of results says, and little else is.
import { countFields, fieldsOf } from "./fields.mjs";
import { kPoses, kProjections } from "./documents.mjs";
import { kMutations } from "./mutations.mjs";
import { Tally } from "./random.mjs";
import { parsed, valuesOf } from "./runs.mjs";

const kAlways = new Set(["project", "ray", "cull"]); // JSON where their input is
const kFields = ["screen", "depth", "viewDistance", "visible", "outside", "ndc", "clip", "view", "pixelSize", "screenBox", "bound"];

/// The part of the schema that a run's output is of; nothing where it is no JSON.
function partOf({ command, options, flags }) {
  if (flags.has("--list") || flags.has("--help") || flags.has("-h")) return undefined;
  const to = options["--to"];
  if (kAlways.has(command)) {
    if (options["--prefix"] !== undefined || (to !== undefined && to !== "json" && to !== "ndjson")) return undefined;
    return flags.has("--planes") ? "planes" : flags.has("--corners") ? "corners" : command;
  }
  if (command === "inspect" && options["--convention"] !== undefined) return undefined; // matrices under their own names
  if (command === "matrix") return to === undefined || to === "json" ? command : undefined;
  if (command === "depth" && options["--depth"] !== undefined) return to === "json" ? "depths" : undefined;
  if (["explain", "inspect", "depth", "measure"].includes(command)) return to === "json" ? command : undefined;
  return undefined;
}

/// Without the fields of a result's name that --fields left out: those are the record's own. A pixel's is no result.
function described(value, fields, part) {
  if (fields === undefined || fields === "all" || value === null || typeof value !== "object") return value;
  if (Array.isArray(value)) return value.map((record) => described(record, fields, part));
  if (Array.isArray(value.points)) return { ...value, points: described(value.points, fields, part) };
  const chosen = fields.split(",");
  if (part === "ray") chosen.push("screen");
  return Object.fromEntries(Object.entries(value).filter(([key]) => !kFields.includes(key) || chosen.includes(key)));
}

const kScene = JSON.stringify({
  objects: [
    { id: 1, sphere: { center: [0, 0, 0], radius: 3 } }, { plane: { point: [0, 0, 0], normal: [0, 1, 0] } },
    { id: "earth", ellipsoid: "WGS84" },
  ],
});
const kPoints =
  '[0,0,0] {"id":1,"x":5,"y":5,"z":5} {"direction":[1,2,3]} {"position":[1,1,1,-2]}\n[[1,2,3],{"screen":1}]\n' +
  '{"segment":[[0,0,0],[9,9,9]],"pixel":[100,100]} {"segment":[[-900,1,1],[900,2,3]],"pixel":null} {"points":[[1,2,3],[6371000,0,0]],"a":1}';
const kShapes = '[0,0,0] {"sphere":{"center":[1,2,3],"radius":4}} [{"box":{"min":[-9,-9,-9],"max":[9,9,9]}}] {"points":[{"triangle":[[0,0,0],[1,0,0],[0,1,0]]}]}';

/// Runs of every command with random cameras.
function randomRuns(run, makeCamera, Random) {
  const runs = [];
  for (let seed = 0; seed < 2 * kProjections.length; ++seed) {
    const r = new Random(seed);
    const camera = JSON.stringify(makeCamera(r, kPoses[1 + (seed % (kPoses.length - 1))], kProjections[1 + (seed % (kProjections.length - 1))], true));
    const add = (command, args, input) => {
      const options = {}, flags = new Set(args);
      for (let i = 0; i + 1 < args.length; ++i) if (args[i].startsWith("--")) options[args[i]] = args[i + 1];
      const { output } = run([command, ...args, "-c", camera], input);
      runs.push({ command, options, flags, output });
      return output;
    };
    add("project", ["--keep-going", "--fields", kFields.join()], kPoints);
    add("project", ["--keep-going", "--to", "json"], kPoints);
    add("ray", ["--bound", "--keep-going", "--scene", kScene], '[10,20] {"pixel":[1,2],"depth":0.5} {"screen":null,"viewDistance":2} {"screen":[3,4],"viewDistance":7} [1]');
    add("ray", ["--all-hits", "--scene", kScene, "--to", "json"], "[[100,100],[0,0]]");
    add("ray", ["--fields", "pixelSize,viewDistance,direction"], '[10,20] {"pixel":[1,2],"depth":0.5}');
    add("project", [], kShapes);
    add("cull", ["--keep-going"], kShapes + "[1]");
    add("cull", ["--corners"]);
    add("depth", ["--to", "json", "--depth", "0,0.5,1.5"]);
    add("cull", ["--planes"]);
    const matrices = add("matrix", ["--inverse"]);
    add("matrix", ["--relative-to-eye", "--bake-viewport", "--float"]);
    add("matrix", ["--inverse", "--model", `{"scale":[1,2,3]}`]);
    add("explain", ["--to", "json", "--point", "0.5,1,2"]);
    add("explain", ["--to", "json", "--pixel", "100,80"]);
    add("explain", ["--to", "json", "--pixel", "100,80,0.5"]);
    if (seed % 6 === 0) add("measure", ["--to", "json"], "[0,0,0] [1,2,3]");
    add("depth", ["--to", "json", "--gap", "0.01"]);
    const { output } = run(["inspect", "--to", "json"], matrices);
    runs.push({ command: "inspect", options: { "--to": "json" }, flags: new Set(), output });
  }
  return runs;
}

/// Values, and what makes each of them none that is printed: undefined leaves a field out.
const kEnd = { t: 0, screen: [100, 50], depth: 0.6, viewDistance: 2, cutBy: null };
const kWrong = [
  ["project", { position: [0, 0, -2], screen: [100, 50], depth: 0.6, viewDistance: 2, visible: true },
    [{ outside: ["left"] }, { screen: [100] }, { screen: "100" }, { depth: "0.6" }, { visible: "yes" }, { visible: null }]],
  ["project", { position: [9, 0, -2], screen: [300, 50], depth: 0.6, viewDistance: 2, visible: false, outside: ["right"] },
    [{ outside: ["beside"] }, { outside: "right" }, { outside: ["right", "right"] }]],
  ["projectedSegment", { segment: [[0, 0, -2], [0, 0, -3]], visible: true, start: kEnd, end: { ...kEnd, t: 1 } },
    [{ start: null }, { end: null }, { end: { ...kEnd, t: 1.5 } }, { start: { ...kEnd, t: -0.5 } }, { start: { ...kEnd, cutBy: "side" } },
      { start: { ...kEnd, screen: undefined } }]],
  ["ray", { pixel: [1, 2], origin: [0, 0, 0], direction: [0, 0, -1] },
    [{ direction: [2, 0, 0] }, { direction: [0, -1] }, { direction: "up" }, { origin: [0, 0] }, { pixelSize: -1 }]],
  ["cull", { position: [0, 0, -2], cull: "inside", plane: null }, [{ plane: "left" }, { cull: "within" }, { cull: "outside" }, { plane: 1 }]],
  ["cull", { position: [0, 0, 2], cull: "outside", plane: "near" }, [{ plane: null }, { plane: "nearest" }]],
  ["cull", { line: 2, error: "has no point" }, [{ line: undefined }, { error: undefined }, { error: 3 }, { line: "2" }, { more: 1 }]],
];

/// A wrong value is refused, by the part and by the whole.
function checkWrong(ajv, whole, fault) {
  let refused = 0;
  for (const [part, value, changes] of kWrong) {
    const schema = ajv.getSchema(`urn:viewproj:schema:results#/$defs/${part}`);
    if (!schema(value)) fault(`${part}: refused: ${JSON.stringify(value)}`);
    for (const change of changes) {
      const wrong = JSON.parse(JSON.stringify({ ...value, ...change }));
      if (schema(wrong)) fault(`${part}: accepted: ${JSON.stringify(wrong)}`);
      else ++refused;
    }
  }
  return refused;
}

/// The objects of a value by where they stand, whatever the place in an array.
function objectsIn(value, path = "", found = []) {
  if (Array.isArray(value)) for (const one of value) objectsIn(one, path, found);
  else if (value !== null && typeof value === "object") {
    found.push([path, value]);
    for (const [key, inner] of Object.entries(value)) objectsIn(inner, `${path}.${key}`, found);
  }
  return found;
}

/// A field that all objects of a place have is one that none may lack, but for a format, which other depths have not.
const kMayLack = /\.d(16|24|32f)$/;
function checkFields(part, values, schema, fault) {
  const places = new Map();
  for (const value of values)
    for (const [path, object] of objectsIn(value)) {
      const keys = Object.keys(object), before = places.get(path);
      places.set(path, { count: (before?.count ?? 0) + 1, keys: before ? before.keys.filter((key) => keys.includes(key)) : keys });
    }
  let refused = 0;
  for (const [path, { count, keys }] of places)
    for (const key of keys) {
      if (count < 3 || kMayLack.test(`${part}${path}.${key}`)) continue;
      const changed = structuredClone(values.find((value) => objectsIn(value).some(([other]) => other === path)));
      delete objectsIn(changed).find(([other]) => other === path)[1][key];
      if (schema(changed)) fault(`${part}: accepted without ${path}.${key}`);
      else ++refused;
    }
  return refused;
}

/// No value of a closed form is one any more after these mutations.
const kTelling = ["write a number as a string", "put an object"];
const kClosed = ["planes", "corners", "matrix", "explain", "inspect", "depth", "depths", "measure"];

export function checkResults({ ajv, runs, run, fault, makeCamera, Random }) {
  const whole = ajv.getSchema("urn:viewproj:schema:results");
  const counts = new Map(), met = new Map();
  const count = (name) => counts.set(name, (counts.get(name) ?? 0) + 1);
  const printed = new Map(kClosed.map((part) => [part, []]));
  let seed = 0;
  for (const r of [...runs, ...randomRuns(run, makeCamera, Random)]) {
    const part = partOf(r);
    if (part === undefined || !/^\s*[{[]/.test(r.output)) continue;
    const values = valuesOf(r.output);
    if (values === undefined || values.some((text) => !parsed(text))) {
      count("cut short or not JSON");
      continue;
    }
    const schema = ajv.getSchema(`urn:viewproj:schema:results#/$defs/${part}`);
    for (const text of values) {
      const value = described(JSON.parse(text), r.options["--fields"], part);
      count(part);
      if (!met.has(part)) met.set(part, new Tally());
      countFields(value, met.get(part));
      if (!schema(value)) fault(`${part}: ${ajv.errorsText(schema.errors)}: ${text}`);
      if (!whole(value)) fault(`results: ${ajv.errorsText(whole.errors)}: ${text}`);
      if (!kClosed.includes(part)) continue;
      printed.get(part).push(value);
      const name = kTelling[seed % kTelling.length];
      const changed = structuredClone(value);
      if (kMutations[name](new Random(seed++), changed) === false) continue;
      // A reading's convention has the axes that it determines: any of them may be absent, and all.
      const others = (of) => JSON.stringify(of, (key, inner) => (key === "convention" ? undefined : inner));
      if (others(changed) === others(value)) count(`${part}, mutated in its convention`);
      else if (schema(changed)) fault(`${part}: accepted after '${name}': ${JSON.stringify(changed)}`);
      else count(`${part}, mutated and rejected`);
    }
  }
  for (const part of [...kClosed, ...kAlways]) if ((counts.get(part) ?? 0) < 3) fault(`results of ${part} are too few`);
  for (const [part, tally] of met)
    for (const field of fieldsOf(whole.schema.$defs[part], whole.schema, new Set()))
      // A reading's layout stands beside its convention.
      if (tally.get(field) === 0 && !/^matrices.readings.convention.(vectors|storage)$/.test(field)) fault(`results of ${part}: the field ${field} was never printed`);
  counts.set("wrong values refused", checkWrong(ajv, whole, fault));
  for (const [part, values] of printed)
    counts.set(`${part}, without a field and rejected`, checkFields(part, values, ajv.getSchema(`urn:viewproj:schema:results#/$defs/${part}`), fault));
  return [...counts].map(([name, number]) => `  ${number} ${name}`).join("\n");
}
