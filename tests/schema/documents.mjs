// Random documents that the readers accept, in every way that the interface names.
const vector = (r, size = 9) => [r.number(-size, size), r.number(-size, size), r.number(-size, size)];
const place = (r) => ({ lat: r.number(-90, 90), lon: r.number(-200, 200), height: r.number(-50, 9000) });
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/// Fields that are there, null, or absent.
function maybe(r, object, key, make) {
  if (r.chance(0.3)) object[key] = r.chance(0.2) ? null : make();
}

export const kPresets = {
  opengl: "right", "opengl-lh": "left", d3d: "left", "d3d-rh": "right", vulkan: "right", metal: "right",
  webgpu: "right", unity: "left", unreal: "left", opencv: "right", ps2: "right",
};

function convention(r, isPs2, rightHanded) {
  if (isPs2) {
    if (!rightHanded && r.chance(0.2)) return "unreal";
    return r.of(["ps2", { preset: "vulkan", reverseZ: true }, { view: "RUB" }, { preset: "ps2", ndcY: "up" }, null, undefined]);
  }
  const names = Object.keys(kPresets).filter((name) => !rightHanded || kPresets[name] === "right");
  if (r.chance(0.2)) return undefined;
  if (r.chance(0.5)) return r.of(names);
  const axes = {};
  maybe(r, axes, "preset", () => r.of(Object.keys(kPresets)));
  maybe(r, axes, "view", () => r.of(["RUB", "RUF", "RDF"]));
  maybe(r, axes, "ndcZ", () => r.of(["-1..1", "0..1"]));
  maybe(r, axes, "reverseZ", () => r.chance(0.5));
  maybe(r, axes, "ndcY", () => r.of(["up", "down"]));
  maybe(r, axes, "vectors", () => r.of(["column", "row"]));
  maybe(r, axes, "storage", () => r.of(["column-major", "row-major"]));
  maybe(r, axes, "world", () => r.of(["right", "left"]));
  if (rightHanded && worldOf(axes) === "left") axes.world = "right";
  return axes;
}

function worldOf(given) {
  if (typeof given === "string") return kPresets[given];
  return given?.world ?? kPresets[given?.preset] ?? "right";
}

/// Rows of a rotation, and a last row.
function poseMatrix(r, mirrored) {
  const norm = (v) => v.map((x) => x / Math.hypot(...v));
  const z = norm(vector(r)), x = norm(cross([0.3, 0.9, 0.4], z)), y = cross(z, x);
  const sign = mirrored ? -1 : 1;
  const eye = vector(r);
  return [0, 1, 2].map((i) => [x[i], y[i], sign * z[i], eye[i]]).concat([[0, 0, 0, 1]]);
}

/// An angle, at times as a text.
function withUnit(r, degrees) {
  if (r.chance(0.8)) return degrees;
  const [plus, text] = [r.chance(0.3) && degrees >= 0 ? "+" : "", String(degrees).replace(/^0\./, ".")];
  return r.of([`${plus}${text}deg`, `${plus}${text}°`, `${(degrees * Math.PI) / 180} rad`, `${(degrees * Math.PI) / 180}rad`]);
}

/// At times an array of coordinates as an object, and a field under another of its names.
const kNames = {
  position: ["eye", "from"], target: ["lookAt", "at", "center", "to"], direction: ["forward"], up: [],
  rotation: ["quaternion", "orientation"],
};
function otherwise(r, camera) {
  for (const [name, others] of Object.entries(kNames)) {
    if ((camera[name] ?? null) === null) continue;
    if (Array.isArray(camera[name]) && r.chance(0.2))
      camera[name] = Object.fromEntries(camera[name].map((number, i) => ["xyzw"[i], number]));
    if (others.length === 0 || r.chance(0.6)) continue;
    camera[r.of(others)] = camera[name];
    if (r.chance(0.2)) camera[name] = null;
    else delete camera[name];
  }
}

export const kPoses = [
  "no pose", "target", "direction", "rotation", "euler", "worldFromCamera", "cameraFromWorld", "turn", "target place", "ecef",
];

function addPose(r, camera, way, world) {
  const left = world === "left";
  if (way === "target" || way === "direction" || way === "ecef") {
    camera.position = way === "ecef" ? [6400000, r.number(0, 9), r.number(0, 9)] : vector(r);
    if (way === "ecef") camera.world = "ecef";
    if (way === "target") camera.target = camera.position.map((x) => x + r.number(1, 5));
    else camera.direction = [r.number(1, 2), r.number(1, 2), r.number(1, 2)];
    maybe(r, camera, "up", () => [r.number(-1, 0), r.number(-1, 0), 3]);
  } else if (way === "rotation" || way === "euler") {
    camera.position = vector(r);
    if (way === "rotation") camera.rotation = [...vector(r), 1];
    else camera.euler = { order: r.of(["XYZ", "YXZ", "ZXZ"]), degrees: vector(r, 360) };
    const axes = r.of(left ? ["RUF", "FRU"] : ["RUB", "RDF", null]);
    if (axes || r.chance(0.5)) camera.cameraAxes = axes;
  } else if (way === "worldFromCamera" || way === "cameraFromWorld") {
    const leftAxes = r.chance(0.5);
    camera[way] = poseMatrix(r, leftAxes !== left);
    camera.cameraAxes = leftAxes ? r.of(["RUF", "FRU"]) : r.of(["RUB", "RDF", null]);
  } else if (way === "turn") {
    camera.position = place(r);
    if (r.chance(0.7)) camera.pitch = withUnit(r, r.number(-89, 89));
    maybe(r, camera, "roll", () => withUnit(r, r.number(-360, 360)));
    if (r.chance(0.7) || (camera.pitch ?? camera.roll ?? null) === null) camera.heading = r.number(-360, 720);
  } else if (way === "target place") {
    camera.position = place(r);
    camera.target = r.chance(0.7) ? place(r) : [r.number(1, 9), r.number(1, 9), r.number(1, 9)];
    maybe(r, camera, "up", () => [0.1, 0.2, 0.9]);
  }
}

export const kProjections = [
  "no projection", "fovY", "fovX", "fovDiagonal", "nearSize", "focalLength", "both sides", "frustum", "intrinsics",
  "edges", "width", "one side", "ps2",
];

function projection(r, way, viewport) {
  const p = { type: "perspective" };
  const shape = viewport ? viewport.width / viewport.height : r.number(1, 2);
  const own = (object) => maybe(r, object, "aspect", () => r.chance(0.2) ? `${shape} / 1.0` : shape);
  const angle = () => withUnit(r, r.number(1, 179));
  if (way === "fovY") p.fovY = angle(), own(p);
  if (way === "fovX") p.fovX = angle(), own(p);
  if (way === "fovDiagonal") p.fovDiagonal = angle(), own(p);
  if (way === "nearSize") p.nearHeight = r.number(0.1, 2), p.nearWidth = p.nearHeight * shape;
  if (way === "focalLength") p.focalLength = r.number(10, 200), p[r.of(["sensorWidth", "sensorHeight"])] = 24, own(p);
  if (way === "both sides") p.focalLength = 35, p.sensorHeight = 24, p.sensorWidth = 24 * shape;
  if (way === "frustum" || way === "edges") {
    p.type = way === "frustum" ? way : "orthographic";
    p.bottom = r.number(-2, 0);
    p.top = r.number(1, 2);
    p.left = r.number(-2, 0);
    p.right = p.left + (p.top - p.bottom) * shape;
  }
  if (way === "one side") p.type = "orthographic", p[r.of(["width", "height"])] = r.number(1, 9), own(p);
  if (way === "width") p.type = "orthographic", p.height = r.number(1, 9), p.width = p.height * shape;
  if (way === "intrinsics") {
    p.type = way;
    Object.assign(p, { fx: r.number(100, 999), fy: r.number(100, 999), cx: r.number(0, 999), cy: r.number(0, 999) });
    maybe(r, p, "skew", () => 0);
  }
  if (way === "ps2") {
    p.type = way;
    Object.assign(p, { scrz: 512, ax: r.number(0.5, 2), ay: r.number(0.5, 2), cx: 2048, cy: 2048, zMin: 1, zMax: 65535 });
  }
  const flat = p.type === "orthographic";
  p.near = flat ? r.number(-5, 1) : r.number(0.01, 1);
  if (flat) p.far = r.number(2, 999);
  else maybe(r, p, "far", () => r.number(2, 999));
  maybe(r, p, "shift", () => [r.number(-1, 1), r.number(-1, 1)]);
  return p;
}

function viewport(r, isPs2) {
  const v = { width: r.of([640, 1280, 1921]), height: r.of([480, 720, 1080]) };
  if (!isPs2) {
    maybe(r, v, "x", () => r.number(-99, 99));
    maybe(r, v, "y", () => r.number(-99, 99));
    maybe(r, v, "depthRange", () => [r.number(0, 0.4), r.number(0.5, 1)]);
  }
  maybe(r, v, "origin", () => r.of(["top-left", "bottom-left"]));
  maybe(r, v, "pixelCenter", () => r.of([0, 0.5]));
  maybe(r, v, "crop", () => ({ x: r.number(0, 99), y: r.number(0, 99), width: 64, height: 48 }));
  return v;
}

/// pose and way: names of the lists above. whole: with every part.
export function camera(r, pose, way, whole = false) {
  const c = {};
  maybe(r, c, "name", () => r.of(["front", ""]));
  maybe(r, c, "$schema", () => "camera.json");
  const isPs2 = way === "ps2";
  const onEarth = pose === "turn" || pose === "target place" || pose === "ecef";
  const given = convention(r, isPs2, onEarth);
  if (given !== undefined) c.convention = given;
  addPose(r, c, pose, worldOf(given));
  if (whole || way !== "no projection" || r.chance(0.5)) c.viewport = viewport(r, isPs2);
  if (way !== "no projection") {
    const own = ["nearSize", "both sides", "frustum", "edges", "width"].includes(way);
    if (own && !whole && r.chance(0.3)) delete c.viewport;
    c.projection = projection(r, way, c.viewport);
    if (!whole && (c.projection.aspect ?? null) !== null && r.chance(0.5)) delete c.viewport;
  }
  const picture = c.viewport;
  if (!isPs2 && picture && r.chance(0.2))
    c.viewport = [picture.x ?? 0, picture.y ?? 0, picture.width, picture.height];
  otherwise(r, c);
  return c;
}

const kId = (r) => r.of([7, "lamp", -1.5]);

/// An array, an object or a place, the same way for all points of a record.
function waysOf(r) {
  return r.of([
    (at) => at,
    (at) => at,
    ([x, y, z]) => ({ x, y, z }),
    ([x, y, z]) => ({ lat: 46 + x / 10, lon: 7 + y / 10, height: z }),
  ]);
}

/// At times as an object.
const point = (r, at) => (r.chance(0.3) ? { x: at[0], y: at[1], z: at[2] } : at);

function shape(r, kind, as = (at) => point(r, at)) {
  const at = vector(r);
  if (kind === "plane") return { point: as(at), normal: as([r.number(1, 2), 0, r.number(-1, 1)]) };
  if (kind === "sphere") return { center: as(at), radius: r.of([0, 2.5]) };
  if (kind === "box") {
    const min = as(at), max = as(at.map((x) => x + r.number(0, 3)));
    return "lat" in min ? { min, max: min } : { min, max };
  }
  if (kind === "triangle") return [as(at), as(vector(r)), as(vector(r))];
  return "WGS84";
}

/// Of a scene with a camera on the Earth.
function placedShape(r, kind) {
  const at = () => {
    const { lat, lon, height } = place(r);
    return { lat, lon, height };
  };
  if (kind === "plane") return { point: at(), normal: [r.number(1, 2), 0, r.number(-1, 1)] };
  if (kind === "sphere") return { center: at(), radius: r.of([0, 2.5]) };
  if (kind === "triangle") return [at(), at(), at()];
  const corner = at();
  return kind === "box" ? { min: corner, max: corner } : "WGS84";
}

export const kShapes = ["plane", "sphere", "box", "triangle", "ellipsoid"];

export function scene(r) {
  const s = { objects: [] };
  maybe(r, s, "name", () => "yard");
  maybe(r, s, "$schema", () => "scene.json");
  for (let count = r.below(4); count > 0; --count) {
    const kind = r.of(kShapes);
    const object = { [kind]: r.chance(0.2) ? placedShape(r, kind) : shape(r, kind) };
    if (kind === "ellipsoid") maybe(r, object, "height", () => r.number(-1000, 5000));
    maybe(r, object, "id", () => kId(r));
    maybe(r, object, "name", () => "crate");
    if (r.chance(0.1)) object[r.of(kShapes.filter((other) => other !== kind))] = null;
    s.objects.push(object);
  }
  return s;
}

const kPointKinds = ["array", "weighted", "position", "xyz", "xyzw", "place", "direction", "segment", "segment and pixel", "alias", "object", "sphere", "box", "triangle"];

/// x, y, z or lat, lon, height by the names that others have for them.
function otherNames(r) {
  const [x, y, z] = vector(r);
  return r.of([
    () => ({ X: x, Y: y, Z: z }),
    () => ({ X: x, Y: y, Z: z, W: 2 }),
    () => ({ Lat: 46.5, LON: 7, Height: z }),
    () => ({ latitude: 46.5, lng: 7, altitude: z }),
    () => ({ [r.of(["pos", "point", "location", "xyz", "Position"])]: r.of([[x, y, z], { x, y, z }, { X: x, Y: y, Z: z }]) }),
    () => ({ point: "A12", location: { city: "Bern" }, pos: [x, y, z] }),
  ])();
}
const atOf = (r) => {
  const [x, y, z] = vector(r);
  return r.of([{ x, y, z }, { x, y, z, w: 2 }, { X: x, Y: y, Z: z, W: 2 }, { X: x, y, z }, { lat: 46.5, lon: 7, height: z }]);
};

function pointRecord(r, kind = r.of(kPointKinds)) {
  const at = vector(r);
  if (kind === "array") return r.chance(0.5) ? at : [...at, r.number(0, 0.99)];
  if (kind === "weighted") return [...at, r.of([1, 2, -0.5])];
  const record = {};
  maybe(r, record, "id", () => kId(r));
  if (kind === "position") record.position = r.chance(0.5) ? at : [...at, 2];
  if (kind === "xyz" || kind === "xyzw") [record.x, record.y, record.z] = at;
  if (kind === "xyzw") record.w = 3;
  if (kind === "alias") Object.assign(record, otherNames(r));
  if (kind === "object") record.position = atOf(r);
  if (kind === "place") Object.assign(record, place(r));
  if (kind === "direction") record.direction = r.chance(0.3) ? { x: at[0], y: at[1], z: at[2] } : at;
  if (kind.startsWith("segment")) {
    const as = waysOf(r);
    record.segment = [as(at), as(vector(r))];
  }
  if (kShapes.includes(kind)) record[kind] = shape(r, kind, waysOf(r));
  if (kind === "segment and pixel") record.pixel = r.chance(0.3) ? null : [100, 50];
  maybe(r, record, "colour", () => ({ red: [1, null] }));
  return record;
}

function shapeRecord(r) {
  const kind = r.of(["point", "round", "sphere", "box", "triangle"]);
  if (kind === "point") {
    const point = pointRecord(r, r.of(["array", "weighted", "position", "xyz", "xyzw", "place", "alias", "object"]));
    if (Array.isArray(point)) return point;
    maybe(r, point, "plane", () => "left"); // as cull writes it
    maybe(r, point, "ellipsoid", () => 7);
    return point;
  }
  if (kind === "round") return { ...pointRecord(r, r.of(["position", "xyz", "xyzw", "place", "alias", "object"])), radius: r.of([0, 2.5]) };
  const record = { [kind]: shape(r, kind, waysOf(r)) };
  maybe(r, record, "id", () => kId(r));
  return record;
}

function pixelRecord(r) {
  const at = [r.number(0, 640), r.number(0, 480)];
  const kind = r.of(["array", "screen", "pixel", "xy", "XY", "Screen"]);
  if (kind === "array") return r.chance(0.5) ? at : [...at, r.number(0, 0.99)];
  const record = {};
  maybe(r, record, "id", () => kId(r));
  if (kind === "xy") [record.x, record.y] = at;
  else if (kind === "XY") [record.X, record.Y] = at;
  else if (kind === "Screen") record.Screen = at;
  else record[kind] = r.chance(0.2) ? null : at;
  maybe(r, record, "depth", () => r.number(0, 0.99));
  maybe(r, record, "viewDistance", () => r.number(1, 99));
  if (kind === "screen") maybe(r, record, "z", () => 1);
  return record;
}

/// A value of a stream: a record, an array of some or a document.
function arranged(r, record) {
  if (r.chance(0.6)) return record(r);
  const records = [];
  for (let count = r.below(3); count > 0; --count) records.push(record(r));
  return r.chance(0.5) ? records : { points: records, source: "survey" };
}

export const points = (r) => arranged(r, pointRecord);
export const shapes = (r) => arranged(r, shapeRecord);
export const pixels = (r) => arranged(r, pixelRecord);
