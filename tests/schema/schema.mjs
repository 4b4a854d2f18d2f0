// The JSON Schema of a camera file: it is one, as ajv judges; what the tool reads and what it writes is valid by it; and what
// it refuses the tool refuses.
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
const run = (...args) => spawnSync(tool, args, { encoding: "utf8" });

// Strict: an unknown keyword, or one that applies to no type, is an error.
const ajv = new Ajv2020({ strict: true, strictRequired: false });
const schema = JSON.parse(run("schema").stdout);
if (!ajv.validateSchema(schema)) fault(`the schema is none: ${ajv.errorsText()}`);
const isValid = ajv.compile(schema);

let read = 0, written = 0;
for (const name of readdirSync(join(source, "samples"), { recursive: true })) {
  if (!name.endsWith(".json")) continue;
  const file = join(source, "samples", name);
  const camera = run("convert", file, "--quiet", "--to", "camera");
  if (camera.status !== 0) continue;
  ++written;
  if (!isValid(JSON.parse(camera.stdout))) fault(`written of ${name}: ${ajv.errorsText(isValid.errors)}`);
  if (!name.endsWith("camera.json")) continue;
  ++read;
  if (!isValid(JSON.parse(readFileSync(file, "utf8")))) fault(`${name}: ${ajv.errorsText(isValid.errors)}`);
}
if (read < 8 || written < 10) fault(`only ${read} camera files were read, and ${written} written`);

const good = {
  convention: { preset: "opengl", ndcZ: "0..1" }, position: [3, 2, 5], target: [0, 0, 0],
  projection: { type: "perspective", fovY: 60, near: 0.1, far: 1000 }, viewport: { width: 1280, height: 720 },
};
const broken = [
  // Unknown members and words, and values of another kind.
  { fov: 60 }, { projection: { ...good.projection, zNear: 1 } }, { viewport: { ...good.viewport, w: 3 } },
  { convention: { axes: "RUB" } }, { convention: "directx" }, { convention: { preset: "gl" } }, { world: "wgs84" },
  { position: [1, 2] }, { position: { lat: 1, lon: 2 } }, { name: 5 }, { viewport: { width: -1, height: 720 } }, { projection: [] },
];
if (!isValid(good)) fault(`the schema refuses ${JSON.stringify(good)}`);
for (const members of broken) {
  const document = { ...good, ...members }, text = JSON.stringify(document);
  if (run("matrix", "-c", text).status !== 2) fault(`the tool reads ${text}`);
  if (isValid(document)) fault(`the schema accepts ${text}`);
}
console.log(`${read} camera files read, ${written} written, ${broken.length} broken ones; ${faults} faults`);
process.exitCode = faults === 0 ? 0 : 1;
