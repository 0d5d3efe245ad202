// Loads room_lit.glb files with three.js in a browser: no complaint, and a picture of many colours.
//
// node check_lit_room.mjs FOLDER FILE...     FOLDER: where node_modules is

import { readFile } from 'node:fs/promises';
import path from 'node:path';

import { Tally, coloursOf, complaintsOf, launch } from './browser.mjs';

const origin = 'http://lichtmc.test';

const html = `<!DOCTYPE html>
<script type="importmap">{"imports": {"three": "${origin}/three/build/three.module.js"}}</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from '${origin}/three/examples/jsm/loaders/GLTFLoader.js';
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(800, 600);
document.body.append(renderer.domElement);
new GLTFLoader().load('${origin}/room_lit.glb', ({ scene }) => {
  const box = new THREE.Box3().setFromObject(scene);
  const size = box.getSize(new THREE.Vector3()).length();
  const camera = new THREE.PerspectiveCamera(40, 4 / 3, 0.01 * size, 10 * size);
  const middle = box.getCenter(new THREE.Vector3());
  camera.position.copy(middle).add(new THREE.Vector3(0.6, 0.9, 0.8).multiplyScalar(size));
  camera.lookAt(middle);
  const world = new THREE.Scene();
  world.add(scene);
  renderer.render(world, camera);
  let meshes = 0;
  scene.traverse(object => { meshes += object.isMesh ? 1 : 0; });
  window.meshes = meshes;
}, undefined, error => { console.error(String(error)); window.meshes = 0; });
</script>`;

// The page, the file and the modules come from the disk; nothing is asked of a network.
async function serve(page, folder, file) {
  await page.route(`${origin}/**`, async (route) => {
    const { pathname } = new URL(route.request().url());
    if (pathname === '/') return route.fulfill({ contentType: 'text/html', body: html });
    if (pathname === '/favicon.ico') return route.fulfill({ status: 204 });
    if (pathname === '/room_lit.glb') return route.fulfill({ body: await readFile(file) });
    const module = await readFile(path.join(folder, 'node_modules', pathname));
    return route.fulfill({ contentType: 'text/javascript', body: module });
  });
}

const [folder, ...files] = process.argv.slice(2);
const tally = new Tally();
const browser = await launch(folder);
for (const file of files) {
  const page = await browser.newPage();
  const complaints = complaintsOf(page);
  await serve(page, folder, file);
  await page.goto(origin);
  await page.waitForFunction(() => window.meshes !== undefined);
  const meshes = await page.evaluate(() => window.meshes);
  const picture = await page.locator('canvas').screenshot({ path: `${path.dirname(file)}/three.png` });
  const colours = await coloursOf(page, picture);
  tally.check(`${file}: loads in three.js`, meshes > 0 && complaints.length === 0, `${meshes} meshes; ${complaints.join('; ')}`);
  // An even sphere has few tiles' colours; an empty picture has one.
  tally.check(`${file}: three.js shows something`, colours > 20, `${colours} colours`);
  await page.close();
}
await browser.close();
process.exitCode = tally.close();
