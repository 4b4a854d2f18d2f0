// The JSON Schema of a camera file against the tool: what the tool reads as a camera file of its own, and what it writes as
// one, is valid; and the tool refuses what the schema refuses.
//   node schema.mjs VIEWPROJ SOURCE_FOLDER
import { spawnSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import Ajv2020 from "ajv/dist/2020.js";

const [tool, source] = process.argv.slice(2);
let faults = 0;
function fault(text) {
  ++faults;
  console.log(`FAULT ${text.slice(0, 1000)}`);
}

function run(...args) {
  const done = spawnSync(tool, args, { encoding: "utf8" });
  return { good: done.status === 0, refused: done.status === 1, output: done.stdout, error: done.stderr.trim() };
}

// Strict: unknown keywords, keywords that apply to no type and required fields without a schema are errors.
const ajv = new Ajv2020({ strict: true, strictTypes: true, strictTuples: true, strictRequired: true });
const schema = JSON.parse(run("schema").output);
if (!ajv.validateSchema(schema)) fault(`the schema is none: ${ajv.errorsText()}`);
const isValid = ajv.compile(schema);

function parsed(text) {
  try {
    return JSON.parse(text);
  } catch {
    return undefined; // as with comments, which JSON has not
  }
}

/// Of samples and of the transcripts: files, and what stands in quotes on a command line.
function documents() {
  const texts = new Set();
  for (const folder of ["samples", "tests/cmd/transcripts"])
    for (const name of readdirSync(join(source, folder), { recursive: true })) {
      if (!/\.(json|gltf|txt)$/.test(name)) continue;
      const text = readFileSync(join(source, folder, name), "utf8");
      if (!name.endsWith(".txt")) texts.add(text);
      for (const [, quoted] of text.matchAll(/'(\{[^']*\})'/g)) texts.add(quoted);
      for (const [, block] of text.matchAll(/^-- \S+\n((?:  .*\n)+)/gm)) texts.add(block);
    }
  const kLongest = 100000; // of an argument
  return [...texts].filter((text) => text.length < kLongest && text.trimStart().startsWith("{") && parsed(text));
}

let own = 0, written = 0;
for (const text of documents()) {
  const camera = run("matrix", "-c", text, "--to", "camera");
  if (!camera.good) continue;
  ++written;
  if (!isValid(JSON.parse(camera.output))) fault(`written: ${ajv.errorsText(isValid.errors)}: ${camera.output}`);
  // --set takes this field of a file of ours alone.
  if (!run("matrix", "-c", text, "--set", '$schema="camera.schema.json"', "--to", "camera").good) continue;
  ++own;
  if (!isValid(parsed(text))) fault(`read by the tool: ${ajv.errorsText(isValid.errors)}: ${text}`);
}
if (own < 80 || written < 110) fault(`only ${own} camera files were read, and ${written} written`);

// A good document, and what breaks it: members that are merged into it. null takes one out.
const base = {
  convention: { preset: "opengl", ndcZ: "0..1" }, position: [3, 2, 5], target: [0, 0, 0], up: [0, 1, 0],
  projection: { type: "perspective", fovY: 60, near: 0.1, far: 1000 }, viewport: { width: 1280, height: 720 },
};
const orthographic = { type: "orthographic", fovY: null, near: -1, left: -16, right: 16, bottom: -9, top: 9 };
const broken = [
  // Unknown members and words.
  { fov: 60 }, { Position: [1, 2, 3] }, { projection: { fov: 60 } }, { projection: { zNear: 1 } }, { viewport: { w: 3 } },
  { viewport: { crop: { x: 0, y: 0, width: 1, height: 1, z: 0 } } }, { convention: { axes: "RUB" } }, { convention: "directx" },
  { convention: { preset: "gl" } }, { convention: { ndcZ: "0..2" } }, { convention: { vectors: "columns" } },
  { viewport: { origin: "top" } }, { projection: { type: "fisheye" } }, { projection: { type: null } }, { world: "wgs84" },
  // Wrong types and values.
  { position: [1, 2] }, { position: [1, 2, "3"] }, { position: 5 }, { position: { x: 1, y: 2 } }, { position: { lat: 1, lon: 2 } },
  { up: [0, 0, 0] }, { up: "y" }, { name: 5 }, { projection: { fovY: 0 } }, { projection: { fovY: 180 } },
  { projection: { fovY: "60" } }, { projection: { fovY: true } }, { projection: { near: 0 } }, { projection: { near: null } },
  { projection: { far: "1e3" } }, { projection: { aspect: "16:9:1" } }, { projection: { shift: 0.1 } }, { projection: [] },
  { viewport: { width: -1 } }, { viewport: { width: "1280" } }, { viewport: { height: null } }, { viewport: [0, 0, 3] },
  { viewport: { depthRange: [1] } }, { viewport: { depthRange: [1, 1] } }, { viewport: "1280x720" },
  { convention: { reverseZ: "yes" } }, { convention: 3 },
  // Two of a group, or members that do not go together.
  { direction: [0, 0, -1] }, { eye: [1, 2, 3] }, { rotation: [0, 0, 0, 1] }, { heading: 20 }, { cameraAxes: "RUB" },
  { projection: { fovX: 60 } }, { projection: { focalLength: 50, sensorWidth: 36 } }, { projection: { fovY: null } },
  { projection: { fovY: null, focalLength: 50 } }, { projection: { fovY: null, nearWidth: 1 } }, { projection: { left: 1 } },
  { position: null }, { target: null, rotation: [0, 0, 0, 0] }, { target: null, up: null, rotation: [0, 0, 1] },
  { target: null, up: null, euler: { order: "XYQ", degrees: [1, 2, 3] } }, { target: null, up: null, euler: { order: "XYZ" } },
  { projection: { ...orthographic, far: null } }, { projection: { ...orthographic, width: 2 } },
  { projection: { ...orthographic, top: null } }, { projection: { type: "frustum", fovY: null, left: -1, right: 1 } },
  { projection: { type: "intrinsics", fovY: null, fx: 100, fy: 100, cx: 3 } },
  { projection: { type: "intrinsics", fovY: null, fx: 100, fy: 100, cx: 3, cy: 4, skew: 1 } },
];
const good = [{}, { projection: orthographic }, { target: null, direction: [1, 0, 0] }, { projection: { fovY: null, fovX: "1.2rad" } }];

function merged(into, members) {
  const result = { ...into };
  for (const [key, value] of Object.entries(members)) {
    const isPart = value && typeof value === "object" && !Array.isArray(value) && typeof result[key] === "object" && key !== "position";
    if (value === null) delete result[key];
    else result[key] = isPart ? merged(result[key], value) : value;
  }
  return result;
}
for (const [list, isGood] of [[good, true], [broken, false]])
  for (const members of list) {
    const document = merged(base, members), text = JSON.stringify(document);
    const read = run("matrix", "-c", text);
    if (isGood ? !read.good : !read.refused) fault(`the tool ${isGood ? "refuses" : "reads"} ${text}: ${read.error}`);
    if (isValid(document) !== isGood) fault(`the schema ${isGood ? "refuses" : "accepts"} ${text}`);
  }
console.log(`${own} camera files read, ${written} written, ${broken.length} broken ones; ${faults} faults`);
process.exitCode = faults === 0 ? 0 : 1;
