// Small changes to a document, most of which make it wrong.

/// The objects and arrays of a document, and the keys at which they hold something.
function places(root, found = []) {
  if (root === null || typeof root !== "object") return found;
  for (const key of Object.keys(root)) {
    found.push([root, Array.isArray(root) ? Number(key) : key]);
    places(root[key], found);
  }
  return found;
}

const held = (root, wanted) => places(root).filter(([at, key]) => wanted(at[key], at, key));
const isObject = (value) => value !== null && typeof value === "object" && !Array.isArray(value);

/// Puts something else where the condition holds; false where it holds nowhere.
function replace(r, root, wanted, make) {
  const found = held(root, wanted);
  if (found.length === 0) return false;
  const [at, key] = r.of(found);
  at[key] = make(at[key], at, key);
}

const kWords = [
  "", "opengl", "d3d", "unreal", "unity", "ps2", "opencv", "left", "right", "RUB", "RUF", "RDF", "FRU", "0..1", "-1..1", "up", "down",
  "row", "column", "row-major", "ecef", "WGS84", "top-left", "bottom-left", "perspective", "frustum", "intrinsics",
  "orthographic", "OpenGL", "1", "null",
];
const kUnknown = ["colour", "fov", "fovy", "Position", "extra", "points", "z", "w"];

/// Numbers at the limits of fields and just beyond them.
const kBeyond90 = [90, -90, 90.5, -90.5], kAngle = [0, 180, 179.5, 180.5], kZero = [0, 5e-324, -5e-324];
const kLimits = {
  lat: kBeyond90, pitch: kBeyond90, fovY: kAngle, fovX: kAngle, fovDiagonal: kAngle, near: kZero, far: kZero, fx: kZero, fy: kZero,
  scrz: kZero, ax: kZero, ay: kZero, width: kZero, height: [...kZero, -1000000.5], aspect: kZero, nearWidth: kZero, nearHeight: kZero,
  focalLength: kZero, sensorWidth: kZero, sensorHeight: kZero, radius: kZero, skew: kZero, w: kZero, viewDistance: kZero,
};

/// Fields that go with some of their neighbours and not with others.
const kNeighbours = {
  type: { fovY: 60, fovX: 60, aspect: 1.5, nearWidth: 1, nearHeight: 1, focalLength: 35, sensorWidth: 36, sensorHeight: 24, width: 2, left: -1 },
  position: { up: [0, 0.5, 1], cameraAxes: "RUB", heading: 10, target: [50, 40, 30], direction: [1, 1, 1], world: "ecef" },
  direction: { up: (at) => at.direction },
  worldFromCamera: { position: [1, 2, 3], up: [0, 1, 0] },
  cameraFromWorld: { position: [1, 2, 3], up: [0, 1, 0] },
  screen: { z: 1, x: 1, pixel: [1, 2] },
  X: { Z: 1, W: 0 },
  x: { z: 1, w: 0, position: [1, 2, 3], lat: 1 },
};

/// A field that an object at the same place of another document has, one that is not there yet where there is one.
function graft(r, root, another) {
  for (let attempt = 0; attempt < 8; ++attempt) {
    const pairs = [];
    const walk = (own, other) => {
      if (isObject(own) && isObject(other)) pairs.push([own, other]);
      if (own === null || other === null || typeof own !== "object" || typeof other !== "object") return;
      for (const key of Object.keys(own)) if (key in other) walk(own[key], other[key]);
    };
    const other = another();
    walk(root, other);
    const fresh = pairs.flatMap(([own, from]) => Object.keys(from).filter((key) => !(key in own)).map((key) => [own, from, key]));
    if (fresh.length === 0) continue;
    const [own, from, key] = r.of(fresh);
    own[key] = structuredClone(from[key]);
    return undefined;
  }
  return false;
}

/// Each changes the document in place, or returns what it is from then on; false where there is nothing to change.
export const kMutations = {
  "drop a field"(r, root) {
    const found = held(root, (value, at) => isObject(at));
    if (found.length === 0) return false;
    const [at, key] = r.of(found);
    delete at[key];
  },
  "add an unknown field"(r, root) {
    const targets = [root, ...held(root, isObject).map(([at, key]) => at[key])].filter(isObject);
    if (targets.length === 0) return false;
    r.of(targets)[r.of(kUnknown)] = r.of([1, "x", null, [1, 2, 3], {}]);
  },
  "take a field of another": graft,
  "put null": (r, root) => replace(r, root, () => true, () => null),
  "put a string": (r, root) => replace(r, root, () => true, () => r.of(kWords)),
  "put another word": (r, root) => replace(r, root, (v) => typeof v === "string", () => r.of(kWords)),
  "put a flag": (r, root) => replace(r, root, () => true, () => r.chance(0.5)),
  "put a number": (r, root) => replace(r, root, () => true, () => r.of([0, 1, -1, 0.5, 90])),
  "put an array": (r, root) => replace(r, root, () => true, () => r.of([[], [0, 0, 0], [1, 2, 3], [1, 2, 3, 4], [null, 1, 2]])),
  "put an object": (r, root) => replace(r, root, () => true, () => r.of([{}, { lat: 1, lon: 2, height: 3 }, { type: "frustum" }])),
  "change a sign": (r, root) => replace(r, root, (v) => typeof v === "number", (v) => -v),
  "put 0": (r, root) => replace(r, root, (v) => typeof v === "number", () => 0),
  "put an extreme": (r, root) =>
    replace(r, root, (v) => typeof v === "number", () => r.of([1e308, -1e308, 5e-324, 1e-200, 1e200, 179.99999999999997, 180, 90.5, -90.5, 1e17])),
  "put a limit": (r, root) => replace(r, root, (v, at, key) => typeof v === "number" && key in kLimits, (v, at, key) => r.of(kLimits[key])),
  "add a field beside its like"(r, root) {
    const objects = [root, ...held(root, isObject).map(([at, key]) => at[key])].filter(isObject);
    const found = objects.flatMap((at) => Object.keys(at).filter((key) => key in kNeighbours).map((key) => [at, kNeighbours[key]]));
    if (found.length === 0) return false;
    const [at, fields] = r.of(found), name = r.of(Object.keys(fields));
    at[name] = structuredClone(fields[name] instanceof Function ? fields[name](at) : fields[name]);
  },
  "scale a number": (r, root) => replace(r, root, (v) => typeof v === "number", (v) => v * r.of([2, 1000, -10, 0.001])),
  "write a number as a string": (r, root) => replace(r, root, (v) => typeof v === "number", (v) => String(v) + r.of(["", "deg", "e3deg"])),
  "put all 0": (r, root) => replace(r, root, (v) => Array.isArray(v) || (isObject(v) && Object.values(v).every((n) => typeof n === "number")),
    (v) => (Array.isArray(v) ? v.map(() => 0) : Object.fromEntries(Object.keys(v).map((key) => [key, 0])))),
  "add to a text": (r, root) => replace(r, root, (v) => typeof v === "string", (v) => v + r.of(["x", " ", "0"])),
  "shorten an array": (r, root) => replace(r, root, (v) => Array.isArray(v) && v.length > 0, (v) => v.slice(0, -1)),
  "lengthen an array": (r, root) => replace(r, root, (v) => Array.isArray(v) && v.length > 0, (v) => [...v, v[r.below(v.length)]]),
  "empty an array or object": (r, root) =>
    replace(r, root, (v) => v !== null && typeof v === "object", (v) => (Array.isArray(v) ? [] : {})),
  "wrap in an array": (r, root) => replace(r, root, () => true, (v) => [v]),
  "exchange two values"(r, root) {
    const found = places(root);
    if (found.length < 2) return false;
    const [a, i] = r.of(found), [b, j] = r.of(found.filter(([at]) => at === a));
    [a[i], b[j]] = [b[j], a[i]];
  },
  "make two numbers the same"(r, root) {
    const found = held(root, (v) => typeof v === "number");
    if (found.length < 2) return false;
    const [at, key] = r.of(found);
    at[key] = r.of(found.filter(([other]) => other === at).map(([, k]) => at[k]));
  },
  "repeat a value": (r, root) => replace(r, root, (v, at) => Object.keys(at).length > 1, (v, at) => structuredClone(at[r.of(Object.keys(at))])),
  "change the whole": (r, root) => r.of([null, true, 5, "x", [], {}, [root], [[]], { points: [root] }, { points: root }]),
};

/// Changes that only the text can show.
export const kTextMutations = {
  "give a key twice"(r, text) {
    const keys = [...text.matchAll(/[{,]("[^"\\]+":(?:-?[\d.e+-]+|"[^"\\]*"|true|false|null|\[[^[\]{}]*\]))(?=[,}])/g)];
    if (keys.length === 0) return false;
    const [whole, field] = r.of(keys);
    return text.replace(whole, () => whole + "," + field);
  },
  "write a number too large"(r, text) {
    const numbers = [...text.matchAll(/(?<=[:,[])-?\d[\d.e+-]*(?=[,\]}])/g)];
    if (numbers.length === 0) return false;
    const at = r.of(numbers);
    return text.slice(0, at.index) + r.of(["1e999", "-1e400"]) + text.slice(at.index + at[0].length);
  },
  "write a number at length"(r, text) {
    const numbers = [...text.matchAll(/(?<=[:,[])-?\d+(?=[,\]}])/g)];
    if (numbers.length === 0) return false;
    const at = r.of(numbers);
    return text.slice(0, at.index) + at[0] + r.of(["e0", ".0", "00000000000000000000000000", "E+00", "e-3"]) + text.slice(at.index + at[0].length);
  },
  "escape a key": (r, text) => text.replace(/[{,]"([a-z])/i, (whole, c) => whole.slice(0, -1) + "\\u" + c.charCodeAt(0).toString(16).padStart(4, "0")),
};
