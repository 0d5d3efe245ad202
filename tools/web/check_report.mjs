// Opens report.html of result folders in a browser, as a person would, and holds its pictures against tiles.csv.
//
// node check_report.mjs FOLDER RESULTS...     FOLDER: where node_modules is

import { readFile } from 'node:fs/promises';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { Tally, coloursOf, complaintsOf, launch, load } from './browser.mjs';

const longest_opening_ms = 2000;

// Rows of a table of comma-separated values as objects; fields may stand in quotes.
function rowsOf(text) {
  const fields = (line) => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map(([, field]) => field.replace(/^"|"$/g, '').replaceAll('""', '"'));
  const [head, ...lines] = text.trimEnd().split('\n');
  const names = fields(head);
  return lines.map((line) => Object.fromEntries(fields(line).map((field, k) => [names[k], field])));
}

const numbers = (text) => text.split(',').map(Number);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// The pixels of a plan's picture. They leave the page as text: numbers one by one take a hundred times as long.
async function pixelsOf(figure) {
  const { width, height, base64 } = await figure.evaluate(async (element) => {
    const image = new Image();
    image.src = element.querySelector('image[image-rendering]').getAttribute('href');
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const pieces = [];
    for (let k = 0; k < data.length; k += 8192) pieces.push(String.fromCharCode(...data.subarray(k, k + 8192)));
    return { width: image.width, height: image.height, base64: btoa(pieces.join('')) };
  });
  return { width, height, data: Buffer.from(base64, 'base64') };
}

function shareOf(value, { low, high, scale }) {
  const [a, b, x] = scale === 'log' ? [low, high, value].map(Math.log) : [low, high, value].map(Number);
  return Math.min(1, Math.max(0, (x - a) / (b - a))) || 0;
}

// How many tiles of a plan have the colour that their irradiance times `factor` has by the maps of d3.
function compare(tiles, plan, pixels, colours, factor) {
  const corner = numbers(plan.corner);
  const across = numbers(plan.across);
  const down = numbers(plan.down);
  const normal = [across[1] * down[2] - across[2] * down[1], across[2] * down[0] - across[0] * down[2], across[0] * down[1] - across[1] * down[0]];
  const length = Math.sqrt(dot(normal, normal));
  let same = 0;
  let other = 0;
  for (const tile of tiles) {
    if (tile.surface !== plan.map) continue;
    const way = [tile.x - corner[0], tile.y - corner[1], tile.z - corner[2]];
    if (Math.abs(dot(way, normal)) / length > 1e-3) continue;
    const x = Math.floor(dot(way, across) / dot(across, across));
    const y = Math.floor(dot(way, down) / dot(down, down));
    if (x < 0 || y < 0 || x >= pixels.width || y >= pixels.height) continue;
    const at = 4 * (y * pixels.width + x);
    if (pixels.data[at + 3] === 0) continue;
    const expected = colours[plan.colours](shareOf(factor * tile.irradiance, plan)).match(/\d+|#.*/g);
    const channels = expected[0].startsWith('#') ? [1, 3, 5].map((k) => parseInt(expected[0].slice(k, k + 2), 16)) : expected.map(Number);
    const worst = Math.max(...channels.map((value, k) => Math.abs(value - pixels.data[at + k])));
    if (worst <= 3) same += 1;
    else other += 1;
  }
  return { same, other };
}

async function checkColours(tally, page, name, tiles, colours) {
  let same = 0;
  let other = 0;
  let brighter = 0;
  const figures = await page.locator('figure.plan').all();
  if (figures.length === 0) {
    // Curved all over: its tile map is shown as it is counted.
    const maps = await page.locator('figure.tile-map image').count();
    tally.check(`${name}: curved surfaces have their tile maps`, maps > 0, `${maps} pictures`);
    return;
  }
  for (const figure of figures) {
    const plan = await figure.evaluate((element) => ({ ...element.dataset }));
    const pixels = await pixelsOf(figure);
    const found = compare(tiles, plan, pixels, colours, 1);
    same += found.same;
    other += found.other;
    brighter += compare(tiles, plan, pixels, colours, 1.2).same;
  }
  // A tile whose point lies on its rim may show its neighbour's colour.
  tally.check(`${name}: plans have the colours of tiles.csv`, same >= 50 && other <= 0.01 * same, `${same} tiles agree, ${other} do not, in ${figures.length} plans`);
  // What is above the scale's top, or dark, has the same colour a fifth brighter.
  tally.check(`${name}: tiles a fifth brighter would be noticed`, brighter < 0.7 * same, `${brighter} of ${same} would agree`);
}

async function checkTable(tally, page, name) {
  const heading = page.locator('#surfaces th', { hasText: 'mean' });
  const column = await heading.evaluate((element) => element.cellIndex);
  const values = () => page.locator('#surfaces tbody tr').evaluateAll((rows, k) => rows.map((row) => Number(row.cells[k].dataset.value)), column);
  const sorted = (list, turn) => list.every((value, k) => k === 0 || turn * (value - list[k - 1]) >= 0);
  const before = await values();
  await heading.click();
  const up = await values();
  await heading.press('Enter');
  const down = await values();
  const whole = up.length === before.length && [...up].sort().join() === [...before].sort().join();
  tally.check(`${name}: the table of surfaces sorts`, whole && sorted(up, 1) && sorted(down, -1), `${up.length} rows`);
}

async function checkView(tally, page, name, tiles) {
  const canvas = page.locator('#view3d canvas');
  await canvas.scrollIntoViewIfNeeded();
  const before = await canvas.screenshot({ path: `${name}/view3d.png` });
  tally.check(`${name}: the 3-D view shows something`, (await coloursOf(page, before)) > 20, `${await coloursOf(page, before)} colours`);
  const box = await canvas.boundingBox();
  let text = '';
  for (const [across, along] of [[0.5, 0.5], [0.5, 0.6], [0.4, 0.5], [0.6, 0.6]]) {
    await page.mouse.move(box.x + across * box.width, box.y + along * box.height);
    await page.waitForTimeout(150);
    text = await page.locator('#view3d .readout').textContent();
    if (/\d (lx|W\/m²)/.test(text)) break;
  }
  const [, surface, value, row] = text.match(/^(.*): ([\d.e+-]+) (?:lx|W\/m²) .*\(column (.*)\)$/) ?? [];
  const [column, line] = (row ?? '').split(', row ');
  const tile = tiles.find((one) => one.surface === surface && one.column === column && one.row === line);
  tally.check(`${name}: the 3-D view tells a tile's number`, tile !== undefined && Math.abs(tile.irradiance - value) <= 0.006 * value, `${text}`);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.7 * box.width, box.y + 0.6 * box.height, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(150);
  tally.check(`${name}: dragging turns the 3-D view`, !before.equals(await canvas.screenshot()));
}

// Contrast by WCAG 2: (brighter + 0.05) / (darker + 0.05) of relative luminances.
async function checkScheme(tally, page, name, scheme) {
  await page.emulateMedia({ colorScheme: scheme });
  const [ink, paper] = await page.evaluate(() => {
    const style = getComputedStyle(document.body);
    return [style.color, style.backgroundColor].map((text) => text.match(/\d+/g).slice(0, 3).map(Number));
  });
  const luminance = (rgb) => dot(rgb.map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4)), [0.2126, 0.7152, 0.0722]);
  const [dark, bright] = [luminance(ink), luminance(paper)].sort((a, b) => a - b);
  const contrast = (bright + 0.05) / (dark + 0.05);
  const fits = (luminance(paper) > luminance(ink)) === (scheme === 'light');
  tally.check(`${name}: ${scheme} scheme`, fits && contrast >= 4.5, `contrast ${contrast.toFixed(1)}`);
}

// On paper nothing is wider than the page: A4 less the margins of report.css, at 96 pixels per inch.
async function checkPrint(tally, page, name) {
  await page.emulateMedia({ media: 'print' });
  const before = page.viewportSize();
  for (const [orientation, millimetres] of [['portrait', 210 - 26], ['landscape', 297 - 26]]) {
    const width = Math.floor((millimetres / 25.4) * 96);
    await page.setViewportSize({ width, height: before.height });
    const cut = await page.evaluate((right) => [...document.querySelectorAll('main *')]
      .filter((element) => element.getBoundingClientRect().right > right + 1 && !element.closest('svg'))
      .map((element) => element.tagName + (element.id ? `#${element.id}` : '')), width);
    tally.check(`${name}: nothing is cut in ${orientation}`, cut.length === 0, cut.slice(0, 5).join(', '));
  }
  await page.setViewportSize(before);
  await page.emulateMedia({ media: 'screen' });
}

const [folder, ...results] = process.argv.slice(2);
const tally = new Tally();
const { interpolateViridis, interpolateInferno } = await load(folder, 'd3-scale-chromatic/src/index.js');
const browser = await launch(folder);
await (await browser.newPage()).evaluate(() => document.createElement('canvas').getContext('webgl2')); // what starting
// the browser takes is not the page's
for (const name of results) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  const complaints = complaintsOf(page);
  const asked = [];
  page.on('request', (request) => {
    if (!/^(data|blob):/.test(request.url())) asked.push(request.url());
  });
  const tiles = rowsOf(await readFile(path.join(name, 'tiles.csv'), 'utf8'));
  // The quickest of three: the machine may be busy with other things.
  let ready = Infinity;
  for (let k = 0; k < 3; ++k) {
    const began = Date.now();
    await page.goto(pathToFileURL(path.resolve(name, 'report.html')).href);
    await page.waitForSelector('#view3d[data-state=ready]', { timeout: 20000 });
    ready = Math.min(ready, Date.now() - began);
  }
  tally.check(`${name}: opens in time`, ready < longest_opening_ms, `${tiles.length} tiles; 3-D view after ${ready} ms`);
  tally.check(`${name}: asks for no other file`, asked.length === 3, `${asked.length} requests in three openings`);
  await checkTable(tally, page, name);
  await checkColours(tally, page, name, tiles, { viridis: interpolateViridis, inferno: interpolateInferno });
  await checkView(tally, page, name, tiles);
  await checkScheme(tally, page, name, 'dark');
  await page.screenshot({ path: `${name}/report_dark.png` });
  await checkScheme(tally, page, name, 'light');
  await page.screenshot({ path: `${name}/report_light.png`, fullPage: true });
  await checkPrint(tally, page, name);
  const pdf = await page.pdf({ path: `${name}/report.pdf`, format: 'A4', printBackground: true });
  tally.check(`${name}: prints`, pdf.length > 20000, `${pdf.length} bytes`);
  tally.check(`${name}: no complaint in the console`, complaints.length === 0, complaints.join('; '));
  await page.close();
}
await browser.close();
process.exitCode = tally.close();
