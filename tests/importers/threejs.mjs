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

let random, name;  // of the case
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

/// The world point at these NDC x and y, so far along the viewing axis.
function pointAt(camera, x, y, distance) {
  const p = new THREE.Vector3(x, y, 0).applyMatrix4(camera.projectionMatrixInverse);
  if (camera.isPerspectiveCamera) p.multiplyScalar(-distance / p.z);
  else p.z = -distance;
  return p.applyMatrix4(camera.matrixWorldInverse.clone().invert());
}

/// What three.js makes of a point: its NDC, the sides of the clip volume that it lies beyond, and by a Frustum whether it
/// is seen. Nothing where it is too near to a side of the picture to tell.
function seen(camera, point) {
  const view = point.clone().applyMatrix4(camera.matrixWorldInverse);
  const clip = new THREE.Vector4(view.x, view.y, view.z, 1).applyMatrix4(camera.projectionMatrix);
  const margins = { left: clip.x + clip.w, right: clip.w - clip.x, bottom: clip.y + clip.w, top: clip.w - clip.y,
    near: clip.z + clip.w, far: clip.w - clip.z };
  for (const side of ['left', 'right', 'bottom', 'top'])
    if (Math.abs(margins[side]) < 1e-6 * Math.abs(clip.w)) return undefined;
  const behind = clip.w <= 0;
  const outside = behind ? ['behind'] : Object.keys(margins).filter(side => margins[side] < 0);
  const frustum = new THREE.Frustum().setFromProjectionMatrix(
    new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
  const visible = frustum.containsPoint(point);
  if (visible !== (outside.length === 0)) throw new Error('three.js disagrees with itself');
  return { ndc: behind ? null : point.clone().project(camera), viewDistance: -view.z, visible, outside };
}

/// Some points in the picture and around it, before near and beyond far, and behind the eye; each with what is seen of it.
function judged(camera, width, height, { depth = true, fromBottom = false }) {
  camera.updateMatrixWorld(true);
  camera.updateProjectionMatrix();
  const points = [], judgements = [];
  while (points.length < 9) {
    // Within, before near, beyond far, behind the eye; an orthographic near may be 0, and a far plane three.js's own.
    const { near, far } = camera, within = between(0.01, 0.99), kind = points.length % 5;
    const distance = camera.isPerspectiveCamera
      ? [near * (far / near) ** within, 0.9 * near, depth ? 1.1 * far : 0.8 * near, -near, 2 * near][kind]
      : near + (far - near) * [within, -0.1, 1.1, -0.5, 0.02][kind];
    const point = pointAt(camera, between(-1.3, 1.3), between(-1.3, 1.3), distance);
    const told = seen(camera, point);
    if (!told) continue;
    const { ndc, viewDistance, visible, outside } = told;
    points.push(point.toArray());
    judgements.push({
      screen: ndc && [((ndc.x + 1) / 2) * width, ((1 + (fromBottom ? ndc.y : -ndc.y)) / 2) * height],
      ...(depth ? { depth: ndc && (ndc.z + 1) / 2 } : {}), viewDistance, visible, outside,
    });
  }
  return { points, judgements };
}

/// options: depth: whether it is known; ownViewport: whether the file has it; fromBottom: whether y counts from there.
function write(file, pick, camera, width, height, options = {}) {
  const viewport = options.ownViewport ? null : `${width}x${height}`;
  console.log(JSON.stringify({ name, pick, viewport, file, ...judged(camera, width, height, options) }));
}

/// The object as a file, read by three.js again.
function writeObject(object, cameraNumber, width, height, options = {}) {
  const file = JSON.parse(JSON.stringify(object.toJSON()));
  delete file.images;
  options.change?.(file);
  const cameras = [];
  new THREE.ObjectLoader().parse(file).traverse(o => o.isCamera && cameras.push(o));
  const camera = cameras[cameraNumber];
  let top = camera;
  while (top.parent) top = top.parent;
  top.updateMatrixWorld(true);
  write(file, options.pick ?? String(cameraNumber), camera, width, height, options);
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
  'three perspective': (w, h) => {
    const c = perspective(w, h);
    place(c);
    writeObject(c, 0, w, h);
  },
  'three perspective zoom': (w, h) => {
    const c = perspective(w, h);
    c.zoom = between(0.5, 4);
    place(c);
    writeObject(c, 0, w, h);
  },
  'three orthographic': (w, h) => {
    const c = orthographic(w, h);
    c.zoom = between(0.5, 4);
    place(c);
    writeObject(c, 0, w, h);
  },
  'three view that is not enabled': (w, h) => {
    const c = perspective(w, h);
    c.setViewOffset(w, h, between(0, w / 2), between(0, h / 2), w / 4, h / 3);
    c.clearViewOffset();
    place(c);
    writeObject(c, 0, w, h);
  },
  'three view that does not say whether it is enabled': (w, h) => {
    const c = perspective(w, h);
    c.setViewOffset(w, h, between(0, w / 2), between(0, h / 2), w / 4, h / 3);
    place(c);
    const change = file => delete file.object.view.enabled;
    writeObject(c, 0, w, h, { change });
  },
  'three position, quaternion and scale': (w, h) => {
    const rig = new THREE.Group(), c = perspective(w, h);
    place(rig);
    rig.scale.setScalar(between(0.1, 10));
    place(c);
    c.scale.set(2, 3, 0.5);
    rig.add(c);
    rig.updateMatrixWorld(true);
    c.name = 'front';
    const apart = object => {
      const position = new THREE.Vector3(), quaternion = new THREE.Quaternion(), scale = new THREE.Vector3();
      new THREE.Matrix4().fromArray(object.matrix).decompose(position, quaternion, scale);
      delete object.matrix;
      Object.assign(object, { position: position.toArray(), quaternion: quaternion.toArray(), scale: scale.toArray() });
      object.children?.forEach(apart);
    };
    writeObject(rig, 0, w, h, { pick: 'front', change: file => apart(file.object) });
  },
  'three camera by its uuid': (w, h) => {
    const scene = new THREE.Scene(), first = perspective(w, h), second = perspective(w, h);
    for (const c of [first, second]) place(c);
    scene.add(first, second);
    scene.traverse(o => o.updateMatrix());
    writeObject(scene, 1, w, h, { pick: second.uuid });
  },
  'three scene': (w, h) => {
    const scene = new THREE.Scene(), group = new THREE.Group(), rig = new THREE.Group();
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
    writeObject(scene, number, w, h);
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

/// aspect: of the viewport, where the file has none. pick: what is said in place of the node's number.
async function writeGltf(file, node, width, height, options = {}) {
  const loaded = await new GLTFLoader().parseAsync(JSON.stringify(file), '');
  loaded.scene.updateMatrixWorld(true);
  const camera = loaded.cameras[0];
  if (options.aspect) camera.aspect = options.aspect;
  write(file, options.pick ?? String(node), camera, width, height, options);
}

const gltfPerspective = (aspect, zfar = true) => ({
  type: 'perspective',
  perspective: {
    yfov: between(0.3, 2), znear: between(0.05, 1), ...(zfar ? { zfar: between(50, 5000) } : {}),
    ...(aspect ? { aspectRatio: aspect } : {}),
  },
});

const gltfCases = {
  'glTF perspective': (w, h) => writeGltf(gltf([gltfPerspective(w / h)], [{ camera: 0, ...trs() }], [0]), 0, w, h),
  'glTF without aspectRatio': (w, h) => writeGltf(gltf([gltfPerspective()], [{ camera: 0, ...trs() }], [0]), 0, w, h,
      { aspect: w / h }),
  'glTF without zfar': (w, h) => writeGltf(gltf([gltfPerspective(w / h, false)], [{ camera: 0, ...trs() }], [0]), 0,
      w, h, { depth: false }),  // three.js makes it 2e6
  'glTF orthographic': (w, h) => {
    const ymag = between(0.5, 20);
    const camera = { type: 'orthographic', orthographic: { xmag: (ymag * w) / h, ymag, znear: 0, zfar: 100 } };
    return writeGltf(gltf([camera], [{ camera: 0, ...trs() }], [0]), 0, w, h);
  },
  'glTF by the name of the node': (w, h) => {
    const node = { camera: 0, name: 'dolly', translation: vector(10).toArray() };
    return writeGltf(gltf([gltfPerspective(w / h)], [{ name: 'other' }, node], [0, 1]), 1, w, h,
      { pick: 'dolly' });
  },
  'glTF by the name of the camera': (w, h) => {
    const node = { camera: 0, rotation: quaternion().toArray() };
    return writeGltf(gltf([{ name: 'long lens', ...gltfPerspective(w / h) }], [node], [0]), 0,
      w, h, { pick: 'long lens' });
  },
  'glTF hierarchy': (w, h) => {
    const s = between(0.1, 10);
    const rotated = new THREE.Matrix4().compose(vector(5), quaternion(), new THREE.Vector3(s, s, s));
    // Scales that differ, and no turn below them: the axes stay at right angles.
    const nodes = [
      { children: [1], ...trs([0.5, 2, 3]) },
      { children: [2], translation: vector(3).toArray() },
      { camera: 0, translation: vector(3).toArray(), scale: [2, 0.25, 7] },
      { children: [4], ...trs([s, s, s]) },
      { children: [0], matrix: rotated.toArray() },
    ];
    return writeGltf(gltf([gltfPerspective(w / h)], nodes, [3]), 2, w, h);
  },
};

/// The matrices that three.js itself draws with, under each of their names, by columns in a row or as rows on paper.
function writeMatrices(w, h, make) {
  const c = random() < 0.5 ? perspective(w, h) : orthographic(w, h);
  // Inverting a matrix, three.js may miss the 1 at its end by a bit; such a view is not read.
  do {
    place(c);
    c.updateMatrixWorld(true);
  } while (c.matrixWorldInverse.elements[15] !== 1);
  c.updateProjectionMatrix();
  const rows = m => [0, 1, 2, 3].map(i => [0, 1, 2, 3].map(j => m.elements[4 * j + i]));
  const { convention = 'opengl', ownViewport, fromBottom, ...matrices } = make(c, m => m.toArray(), rows);
  write({ ...(convention ? { convention } : {}), ...matrices }, null, c, w, h, { ownViewport, fromBottom });
}

const matricesCases = {
  'matrices of three.js': (w, h) => writeMatrices(w, h, (c, flat) =>
    ({ viewMatrix: flat(c.matrixWorldInverse), projectionMatrix: flat(c.projectionMatrix) })),
  'matrices as rows': (w, h) => writeMatrices(w, h, (c, flat, rows) =>
    ({ view: rows(c.matrixWorldInverse), projection: rows(c.projectionMatrix) })),
  'matrices with the inverse view': (w, h) => writeMatrices(w, h, (c, flat, rows) =>
    ({ viewInverse: rows(c.matrixWorld), projectionMatrix: rows(c.projectionMatrix) })),
  'matrices with the world matrix': (w, h) => writeMatrices(w, h, (c, flat) =>
    ({ viewMatrixInverse: flat(c.matrixWorld), projection: flat(c.projectionMatrix) })),
  'matrices and an eye': (w, h) => writeMatrices(w, h, (c, flat, rows) => {
    const turned = new THREE.Matrix4().extractRotation(c.matrixWorldInverse);
    return { view: rows(turned), projection: rows(c.projectionMatrix), eye: c.position.toArray() };
  }),
  'matrices of fixed-function OpenGL': (w, h) => writeMatrices(w, h, (c, flat, rows) =>
    ({ modelview: flat(c.matrixWorldInverse), projection: flat(c.projectionMatrix), viewport: [0, 0, w, h], ownViewport: true, fromBottom: true })),
  'matrices as Unity calls them': (w, h) => writeMatrices(w, h, (c, flat, rows) =>
    ({ worldToCameraMatrix: rows(c.matrixWorldInverse), proj: rows(c.projectionMatrix),
      projectionInverse: rows(c.projectionMatrixInverse), viewportInverse: [] })),
  'matrices of an engine': (w, h) => writeMatrices(w, h, (c, flat) =>
    ({ cameraToWorldMatrix: flat(c.matrixWorld), projectionMatrix: flat(c.projectionMatrix) })),
  'matrices and a viewport matrix': (w, h) => writeMatrices(w, h, (c, flat, rows) => ({
    view: rows(c.matrixWorldInverse), projection: rows(c.projectionMatrix), ownViewport: true,
    viewport: [[w / 2, 0, 0, w / 2], [0, -h / 2, 0, h / 2], [0, 0, 0.5, 0.5], [0, 0, 0, 1]],
  })),
};

let seed = 0;
for (const [title, make] of Object.entries({ ...threeCases, ...gltfCases, ...matricesCases })) {
  name = title;
  random = generator(++seed);
  await make(...size());
}
