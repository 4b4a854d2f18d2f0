// ajv against the readers. See schemas.sh.
//   node judge.mjs VIEWPROJ SCHEMA_READER TRANSCRIPTS SCRATCH
import { spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import Ajv2020 from "ajv/dist/2020.js";
import * as documents from "./documents.mjs";
import { countFields, fieldsOf } from "./fields.mjs";
import { kMutations, kTextMutations } from "./mutations.mjs";
import { Random, Tally } from "./random.mjs";
import { checkResults } from "./results.mjs";
import { kRules, ruleOf } from "./rules.mjs";
import { parsed, readRuns, valuesOf } from "./runs.mjs";

const [tool, reader, transcripts, scratch] = process.argv.slice(2);

const faults = [];
const fault = (text) => faults.push(text);
const say = (text) => process.stdout.write(text + "\n");

export function run(args, input = "") {
  const done = spawnSync(tool, args, { input, encoding: "utf8", maxBuffer: 1 << 30 });
  return { status: done.status, output: done.stdout, error: done.stderr };
}

// Strict: unknown keywords, keywords that apply to no type and required fields without a schema are errors.
const ajv = new Ajv2020({ strict: true, strictTypes: true, strictTuples: true, strictRequired: true, validateSchema: true });
for (const name of ["camera", "points", "scene", "results"]) {
  const schema = JSON.parse(run(["schema", name]).output);
  if (!ajv.validateSchema(schema)) fault(`${name}: ${ajv.errorsText()}`);
  ajv.addSchema(schema);
  for (const part of Object.keys(schema.$defs ?? {})) {
    ajv.getSchema(`${schema.$id}#/$defs/${part}`); // every part compiles, whether it is used or not
  }
}
const schemaOf = {
  camera: ajv.getSchema("urn:viewproj:schema:camera"),
  scene: ajv.getSchema("urn:viewproj:schema:scene"),
  points: ajv.getSchema("urn:viewproj:schema:points"),
  shapes: ajv.getSchema("urn:viewproj:schema:points#/$defs/shapes"),
  pixels: ajv.getSchema("urn:viewproj:schema:points#/$defs/pixels"),
};

/// What the reader says of each text: nothing where it accepts.
function readDocuments(kind, texts) {
  const done = spawnSync(reader, [kind, join(scratch, "document")], {
    input: texts.map((text) => JSON.stringify(text) + "\n").join(""), encoding: "utf8", maxBuffer: 1 << 30,
  });
  const verdicts = done.stdout.split("\n").slice(0, -1);
  if (done.status !== 0 || verdicts.length !== texts.length)
    throw new Error(`schema_reader ${kind}: ${verdicts.length} verdicts on ${texts.length} documents; ${done.stderr}`);
  return verdicts.map((verdict) => (verdict === "accepted" ? undefined : verdict));
}

const kEarthCamera = JSON.stringify({
  world: "ecef", position: [6378137, 0, 0], direction: [1, 0, 0], up: [0, 0, 1],
  projection: { type: "perspective", fovY: 60, near: 1 }, viewport: { width: 640, height: 480 },
});
const kCamera = kEarthCamera.replace('"world":"ecef",', "");
/// Of those places are points, and three numbers without names are none.
const isOfTheEarth = (value) =>
  value !== null && typeof value === "object" && (Object.keys(value).some((key) => /^lat(itude)?$/i.test(key)) || Object.values(value).some(isOfTheEarth));
const kCommandOf = { points: "project", shapes: "cull", pixels: "ray" };

/// Each text is a line of its own. The prefix keeps results apart from the records' fields.
function readRecords(kind, texts) {
  const verdicts = texts.map(() => undefined);
  for (const [camera, onEarth] of [[kEarthCamera, true], [kCamera, false]]) {
    const places = texts.flatMap((text, i) => (isOfTheEarth(JSON.parse(text)) === onEarth ? [i] : []));
    readWith(camera, kind, places.map((i) => texts[i])).forEach((verdict, i) => (verdicts[places[i]] = verdict));
  }
  return verdicts;
}

function readWith(camera, kind, texts) {
  const kLast = '{"id":"the last","x":1,"y":1' + (kind === "pixels" ? "}" : ',"z":1}');
  const lines = [...texts.map((text) => text.replaceAll(/[\r\n]/g, " ")), kLast];
  const verdicts = texts.map(() => undefined);
  // In an array some faults end a run: the next one goes on behind them.
  for (let begin = 0; begin < texts.length; ) {
    const args = ["--from", "json", "--keep-going", "--prefix", "result:", "--first-line", String(begin + 1)];
    const done = run([kCommandOf[kind], "-c", camera, ...args], lines.slice(begin).join("\n") + "\n");
    const errors = [...done.error.matchAll(/^viewproj: <stdin>:(\d+):\d+: (.*)$/gm)];
    for (const [, line, message] of errors) verdicts[line - 1] ??= message;
    if ((done.status !== 0) !== errors.length > 0) fault(`${kind}: status ${done.status} with ${errors.length} errors`);
    if (done.output.includes('"the last"')) break;
    if (errors.length === 0) throw new Error(`${kind}: ended without a message: ${done.error}`);
    begin = Number(errors.at(-1)[1]);
  }
  return verdicts;
}

const read = (kind, texts) => (kind in kCommandOf ? readRecords : readDocuments)(kind, texts);

// By kind: how often each field was in a document that reader and schema accept.
const met = Object.fromEntries(Object.keys(schemaOf).map((kind) => [kind, new Tally()]));

/// Compares the verdicts; by: what to count each document under.
function compare(kind, given, by, tally, rules) {
  const texts = given.filter((text) => parsed(text));
  tally.add(`${kind}: not JSON, passed over`, given.length - texts.length);
  const verdicts = read(kind, texts);
  texts.forEach((text, i) => {
    if (verdicts[i] === "foreign") return tally.add(`${kind}: of another program, passed over`);
    const value = JSON.parse(text), valid = schemaOf[kind](value);
    const accepted = verdicts[i] === undefined;
    tally.add(`${kind}: ${accepted ? "accepted" : "rejected"} by the reader`);
    by?.(i, accepted);
    if (valid && accepted) countFields(value, met[kind]);
    if (valid === accepted) return;
    const rule = ruleOf(kind, verdicts[i] ?? "", value);
    if (rule) rules.add(`${kind}: ${rule}`);
    else if (valid) fault(`${kind}: the schema accepts, the reader says ${verdicts[i]}: ${text}`);
    else fault(`${kind}: the reader accepts, the schema says ${ajv.errorsText(schemaOf[kind].errors)}: ${text}`);
  });
}

// What the transcripts read.
const runs = readRuns(transcripts, JSON.parse(run(["help", "--json"]).output));
const rules = new Tally();
{
  const texts = { camera: new Set(), scene: new Set(), points: new Set(), shapes: new Set(), pixels: new Set() };
  const kRecords = { project: "points", measure: "points", cull: "shapes", ray: "pixels" };
  for (const r of runs) {
    const alone = r.command === "matrix" || r.command === "depth";
    const camera = r.options["--camera"] ?? (alone ? r.files[0] ?? "-" : undefined);
    if (camera !== undefined && !/\.glb(#|$)/.test(camera)) texts.camera.add(r.text(camera));
    if (r.options["--scene"] !== undefined) texts.scene.add(r.text(r.options["--scene"]));
    const kind = kRecords[r.command];
    if (kind && camera !== "-") for (const value of valuesOf(r.text(r.files[0]) ?? "?") ?? []) texts[kind].add(value);
  }
  const tally = new Tally();
  for (const kind of Object.keys(texts)) {
    texts[kind].delete(undefined);
    compare(kind, [...texts[kind]], undefined, tally, rules);
    if (tally.get(`${kind}: accepted by the reader`) < 5) fault(`${kind}: too few in the transcripts`);
  }
  say("documents of the transcripts:\n" + tally);
}

// The names that a field may have: those that the reader knows are those of the schema.
{
  const kNamed = ["convention", "convention.preset", "convention.world", "convention.view", "convention.ndcZ", "convention.ndcY",
    "convention.vectors", "convention.storage", "world", "cameraAxes", "projection.type", "viewport.origin"];
  const thorough = new Ajv2020({ allErrors: true });
  const schema = thorough.compile(schemaOf.camera.schema);
  for (const field of kNamed) {
    const keys = field.split(".");
    const named = keys.reduceRight((value, key) => ({ [key]: value }), "?");
    if (named.viewport) Object.assign(named.viewport, { width: 1, height: 1 });
    const message = readDocuments("camera", [JSON.stringify(named)])[0];
    const known = /; known are (.*) \(is "\?"\)$/.exec(message)?.[1].split(", ") ?? [];
    schema(named);
    const allowed = schema.errors.filter((e) => e.keyword === "enum" && e.instancePath === "/" + keys.join("/"));
    const names = [...new Set(allowed.flatMap((e) => e.params.allowedValues))].filter((name) => name !== null);
    if (known.length === 0 || String(known) !== String(names)) fault(`${field}: the reader knows ${known}; the schema ${names}`);
  }
  say(`the names of ${kNamed.length} fields compared\n`);
}

// Random documents as they are and with up to three mutations.
const kGenerated = {
  camera: { count: 40000, make: makeCamera },
  scene: { count: 8000, make: documents.scene },
  points: { count: 10000, make: documents.points },
  shapes: { count: 6000, make: documents.shapes },
  pixels: { count: 6000, make: documents.pixels },
};
function makeCamera(r) {
  return documents.camera(r, r.of(documents.kPoses), r.of(documents.kProjections));
}

function mutated(kind, seed, names) {
  const r = new Random(seed);
  let root = kGenerated[kind].make(r);
  for (let steps = r.below(4); steps > 0; --steps) {
    const name = r.of(Object.keys(kMutations));
    const result = kMutations[name](r, root, () => kGenerated[kind].make(r));
    if (result === false) continue;
    if (result !== undefined) root = structuredClone(result);
    names.push(name);
  }
  let text = JSON.stringify(root);
  if (r.chance(0.1)) {
    const name = r.of(Object.keys(kTextMutations));
    const result = kTextMutations[name](r, text);
    if (result !== false) {
      text = result;
      names.push(name);
    }
  }
  return text;
}

{
  const tally = new Tally(), mutations = new Tally();
  for (const [kind, { count }] of Object.entries(kGenerated)) {
    const steps = [], texts = [];
    for (let seed = 0; texts.length < count; ++seed) {
      const names = [], text = mutated(kind, seed, names);
      if (!parsed(text)) continue;
      steps.push(names);
      texts.push(text);
    }
    compare(kind, texts, (i, accepted) => {
      if (steps[i].length === 0) mutations.add(`${kind}, as it is: ${accepted ? "accepted" : "rejected"}`);
      for (const name of steps[i]) mutations.add(`${name}: ${accepted ? "accepted" : "rejected"}`);
    }, tally, rules);
    const asIs = mutations.get(`${kind}, as it is: accepted`), not = mutations.get(`${kind}, as it is: rejected`);
    if (!(not <= 0.05 * asIs)) fault(`${kind}: of the documents without a mutation ${not} are rejected, ${asIs} accepted`);
  }
  for (const name of [...Object.keys(kMutations), ...Object.keys(kTextMutations)])
    if (mutations.get(`${name}: rejected`) < 20) fault(`mutation '${name}' was rejected too seldom to count`);
  say("random documents:\n" + tally + "\nby mutation:\n" + mutations);
}

// Each field of the schemas was in some document.
{
  let fields = 0;
  for (const [kind, validate] of Object.entries(schemaOf)) {
    const root = ajv.getSchema(`urn:viewproj:schema:${kind === "shapes" || kind === "pixels" ? "points" : kind}`).schema;
    for (const field of fieldsOf(validate.schema, root, new Set())) {
      if (kind === "shapes" && field.startsWith("direction")) continue; // of points, and refused here: it has no place
      ++fields;
      if (met[kind].get(field) < 10) fault(`${kind}: the field ${field} was in ${met[kind].get(field)} documents`);
    }
  }
  if (fields < 100) fault(`the schemas have only ${fields} fields`);
  say(`each of ${fields} fields was in some document`);
}

say("accepted by the schema and rejected by the reader, by rule:\n" + rules);
for (const kind of Object.keys(kRules))
  for (const rule of Object.keys(kRules[kind])) if (rules.get(`${kind}: ${rule}`) === 0) fault(`rule '${kind}: ${rule}' was never met`);

say("results:\n" + checkResults({ ajv, runs, run, fault, makeCamera: documents.camera, Random }));

for (const text of faults.slice(0, 40)) say(`FAULT ${text.slice(0, 2000)}`);
say(`${faults.length} faults`);
process.exitCode = faults.length === 0 ? 0 : 1;
