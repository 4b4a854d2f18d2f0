// Cameras of three.js and glTF, and where three.js itself projects points: one case a line, as JSON.
//   node threejs.mjs
globalThis.self = globalThis;
const THREE = await import('three');
const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');

// Mulberry32: the same numbers everywhere.
function generator(seed) {
  let a = seed >>> 0;
  return () => {
    a = (a + 0x6d2b79f5) | 0;
    let t = Math.imul(a ^ (a >>> 15), 1 | a);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

let random;
Math.random = () => random();  // three.js makes its uuids from it
const between = (low, high) => low + (high - low) * random();
const vector = size => new THREE.Vector3(between(-size, size), between(-size, size), between(-size, size));
const quaternion = () =>
  new THREE.Quaternion(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)).normalize();

function place(object) {
  object.position.copy(vector(10));
  object.quaternion.copy(quaternion());
  object.updateMatrix();
}

/// What the camera sees of each of some points in front of it, and a little beside the picture.
function judged(camera, width, height) {
  camera.updateMatrixWorld(true);
  camera.updateProjectionMatrix();
  const world = camera.matrixWorldInverse.clone().invert();
  const points = [], pixels = [];
  while (points.length < 6) {
    const ndc = new THREE.Vector3(between(-1.3, 1.3), between(-1.3, 1.3), between(-0.9, 0.99));
    const point = ndc.applyMatrix4(camera.projectionMatrixInverse).applyMatrix4(world);
    const p = point.clone().project(camera);
    points.push(point.toArray());
    pixels.push([((p.x + 1) / 2) * width, ((1 - p.y) / 2) * height, (p.z + 1) / 2]);
  }
  return { points, pixels };
}

function write(name, file, pick, camera, width, height, options = {}) {
  const depth = options.depth !== false;
  const { points, pixels } = judged(camera, width, height);
  const viewport = options.ownViewport ? null : `${width}x${height}`;
  console.log(JSON.stringify({ name, pick, viewport, depth, file, points, pixels }));
}

/// The object as a file, read by three.js again.
function writeObject(name, object, cameraNumber, width, height, options) {
  const file = JSON.parse(JSON.stringify(object.toJSON()));
  delete file.images;
  const cameras = [];
  new THREE.ObjectLoader().parse(file).traverse(o => o.isCamera && cameras.push(o));
  const camera = cameras[cameraNumber];
  let top = camera;
  while (top.parent) top = top.parent;
  top.updateMatrixWorld(true);
  write(name, file, String(cameraNumber), camera, width, height, options);
}

const size = () => [640 + Math.floor(between(0, 1280)), 480 + Math.floor(between(0, 600))];
const perspective = (width, height) =>
  new THREE.PerspectiveCamera(between(15, 110), width / height, between(0.05, 1), between(50, 5000));
const orthographic = (width, height) => {
  const half = between(0.5, 20), x = between(-3, 3), y = between(-3, 3);
  return new THREE.OrthographicCamera(x - (half * width) / height, x + (half * width) / height, y + half, y - half,
    between(0.05, 1), between(50, 500));
};

const threeCases = {
  'three perspective': () => {
    const [w, h] = size(), c = perspective(w, h);
    place(c);
    writeObject('three perspective', c, 0, w, h);
  },
  'three perspective zoom': () => {
    const [w, h] = size(), c = perspective(w, h);
    c.zoom = between(0.5, 4);
    place(c);
    writeObject('three perspective zoom', c, 0, w, h);
  },
  'three view offset': () => {
    const [w, h] = size(), c = perspective(w, h);
    c.zoom = between(0.5, 2);
    c.setViewOffset(w, h, between(0, w / 2), between(0, h / 2), w / 4, h / 3);
    place(c);
    writeObject('three view offset', c, 0, w / 4, h / 3, { ownViewport: true });
  },
  'three film offset': () => {
    const [w, h] = size(), c = perspective(w, h);
    c.filmGauge = between(8, 70);
    c.filmOffset = between(-10, 10);
    place(c);
    writeObject('three film offset', c, 0, w, h);
  },
  'three film offset in portrait': () => {
    const [h, w] = size(), c = perspective(w, h);
    c.filmOffset = between(-10, 10);
    place(c);
    writeObject('three film offset in portrait', c, 0, w, h);
  },
  'three orthographic': () => {
    const [w, h] = size(), c = orthographic(w, h);
    c.zoom = between(0.5, 4);
    place(c);
    writeObject('three orthographic', c, 0, w, h);
  },
  'three orthographic view offset': () => {
    const [w, h] = size(), c = orthographic(w, h);
    c.zoom = between(0.5, 4);
    c.setViewOffset(w, h, between(0, w / 2), between(0, h / 2), w / 4, h / 3);
    place(c);
    writeObject('three orthographic view offset', c, 0, w / 4, h / 3, { ownViewport: true });
  },
  'three scene': () => {
    const [w, h] = size(), scene = new THREE.Scene(), group = new THREE.Group(), rig = new THREE.Group();
    for (const node of [group, rig]) place(node);
    group.scale.setScalar(between(0.1, 10));
    rig.scale.setScalar(between(0.1, 10));
    const first = perspective(w, h), second = perspective(w, h), third = orthographic(w, h);
    for (const c of [first, second, third]) place(c);
    third.scale.set(2, 3, 0.5);
    scene.add(first, group);
    group.add(rig);
    rig.add(second, third);
    scene.traverse(o => o.updateMatrix());
    const number = Math.floor(between(0, 3));
    writeObject('three scene', scene, number, w, h);
  },
};

function gltf(cameras, nodes, roots) {
  return { asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: roots }], nodes, cameras };
}

const trs = (scale = null) => ({
  translation: vector(10).toArray(),
  rotation: quaternion().toArray(),
  ...(scale ? { scale } : {}),
});

/// aspect: of the viewport, where the file has none.
async function writeGltf(name, file, node, width, height, options = {}) {
  const loaded = await new GLTFLoader().parseAsync(JSON.stringify(file), '');
  loaded.scene.updateMatrixWorld(true);
  const camera = loaded.cameras[0];
  if (options.aspect) camera.aspect = options.aspect;
  write(name, file, String(node), camera, width, height, options);
}

const gltfPerspective = (aspect, zfar = true) => ({
  type: 'perspective',
  perspective: {
    yfov: between(0.3, 2), znear: between(0.05, 1), ...(zfar ? { zfar: between(50, 5000) } : {}),
    ...(aspect ? { aspectRatio: aspect } : {}),
  },
});

const gltfCases = {
  'glTF perspective': () => {
    const [w, h] = size();
    return writeGltf('glTF perspective', gltf([gltfPerspective(w / h)], [{ camera: 0, ...trs() }], [0]), 0, w, h);
  },
  'glTF without aspectRatio': () => {
    const [w, h] = size();
    return writeGltf('glTF without aspectRatio', gltf([gltfPerspective()], [{ camera: 0, ...trs() }], [0]), 0, w, h,
      { aspect: w / h });
  },
  'glTF without zfar': () => {
    const [w, h] = size();
    return writeGltf('glTF without zfar', gltf([gltfPerspective(w / h, false)], [{ camera: 0, ...trs() }], [0]), 0,
      w, h, { depth: false });  // three.js makes it 2e6
  },
  'glTF orthographic': () => {
    const [w, h] = size(), ymag = between(0.5, 20);
    const camera = { type: 'orthographic', orthographic: { xmag: (ymag * w) / h, ymag, znear: 0, zfar: 100 } };
    return writeGltf('glTF orthographic', gltf([camera], [{ camera: 0, ...trs() }], [0]), 0, w, h);
  },
  'glTF hierarchy': () => {
    const [w, h] = size(), s = between(0.1, 10);
    const rotated = new THREE.Matrix4().compose(vector(5), quaternion(), new THREE.Vector3(s, s, s));
    // Scales that differ, and no turn below them: the axes stay at right angles.
    const nodes = [
      { children: [1], ...trs([0.5, 2, 3]) },
      { children: [2], translation: vector(3).toArray() },
      { camera: 0, translation: vector(3).toArray(), scale: [2, 0.25, 7] },
      { children: [4], ...trs([s, s, s]) },
      { children: [0], matrix: rotated.toArray() },
    ];
    return writeGltf('glTF hierarchy', gltf([gltfPerspective(w / h)], nodes, [3]), 2, w, h);
  },
};

let seed = 0;
for (let trial = 0; trial < 4; ++trial)
  for (const make of [...Object.values(threeCases), ...Object.values(gltfCases)]) {
    random = generator(++seed);
    await make();
  }
