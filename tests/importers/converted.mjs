// Where three.js puts points through the cameras of a file, from the picture's top left corner, as JSON; a glTF is
// validated first.
//   node converted.mjs FILE POINTS WIDTH HEIGHT
import { readFileSync } from 'node:fs';
globalThis.self = globalThis;
const THREE = await import('three');
const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');
const { default: validator } = await import('gltf-validator');

const [file, points, width, height] = process.argv.slice(2);
const text = readFileSync(file);
let scene;
if (file.endsWith('.gltf')) {
  const { issues } = await validator.validateBytes(new Uint8Array(text));
  if (issues.numErrors + issues.numWarnings > 0) throw new Error(JSON.stringify(issues.messages));
  ({ scene } = await new GLTFLoader().parseAsync(text.toString(), ''));
} else {
  scene = new THREE.ObjectLoader().parse(JSON.parse(text));
}
scene.updateMatrixWorld(true);
const pixels = [];
scene.traverse(camera => {
  if (!camera.isCamera) return;
  camera.updateProjectionMatrix();
  camera.matrixWorldInverse.copy(camera.matrixWorld).invert();
  pixels.push(JSON.parse(readFileSync(points)).map(point => {
    const ndc = new THREE.Vector3(...point).project(camera);
    return [((ndc.x + 1) / 2) * width, ((1 - ndc.y) / 2) * height];
  }));
});
console.log(JSON.stringify(pixels));
