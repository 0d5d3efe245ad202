// Debian's Chromium without a window, and a tally of checks.

import path from 'node:path';
import { pathToFileURL } from 'node:url';

// A module of the packages in FOLDER/node_modules.
export const load = (folder, file) => import(pathToFileURL(path.resolve(folder, 'node_modules', file)).href);

// WebGL by the processor: there is no graphics card on a test machine. The sandbox does not work for root.
export async function launch(folder) {
  const { chromium } = (await load(folder, 'playwright-core/index.js')).default;
  return chromium.launch({
    executablePath: '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });
}

export class Tally {
  passed = 0;
  failed = 0;

  check(name, holds, found) {
    if (holds) this.passed += 1;
    else this.failed += 1;
    console.log(`${holds ? 'ok    ' : 'FAILED'} ${name}${found === undefined ? '' : `: ${found}`}`);
  }

  close() {
    console.log(`${this.passed} passed, ${this.failed} failed`);
    return this.failed === 0 ? 0 : 1;
  }
}

// Collects what a page complains about.
export function complaintsOf(page) {
  const complaints = [];
  page.on('console', (message) => {
    if (message.type() === 'error') complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('requestfailed', (request) => complaints.push(`failed: ${request.url().slice(0, 80)}`));
  return complaints;
}

// How many colours a picture of a part of a page has.
export async function coloursOf(page, png) {
  return page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const pixels = new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer);
    return new Set(pixels).size;
  }, png.toString('base64'));
}
