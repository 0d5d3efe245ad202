// Prints report.html of result folders to PDF, as a user would, and reads the pages again.
//
// node check_print.mjs FOLDER RESULTS...     FOLDER: where node_modules is

import { execFile } from 'node:child_process';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { promisify } from 'node:util';

import { Tally, launch } from './browser.mjs';

const run = promisify(execFile);
const tables = ['areas', 'luminaires', 'sources', 'lit-surfaces', 'materials', 'area-details', 'surfaces'];

const plain = (text) => text.normalize('NFKC').replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&quot;', '"').replaceAll('&#39;', "'").replaceAll('&apos;', "'").replaceAll('&amp;', '&');
const wordsOf = (text) => plain(text).split(/\s+/).filter((word) => word !== '');

// The words of each page with their places.
async function pagesOf(pdf) {
  const { stdout } = await run('pdftotext', ['-bbox', pdf, '-'], { maxBuffer: 1 << 28 });
  return stdout.split('<page ').slice(1).map((text) => {
    const height = Number(text.match(/height="([\d.]+)"/)[1]);
    const words = [...text.matchAll(/<word xMin="([\d.-]+)" yMin="([\d.-]+)" xMax="([\d.-]+)" yMax="([\d.-]+)">([^<]*)<\/word>/g)]
      .map(([, left, top, right, bottom, word]) => ({ left: +left, top: +top, right: +right, bottom: +bottom, text: plain(word) }));
    return { height, words, texts: new Set(words.map((word) => word.text)) };
  });
}

// A name that is wider than its column is broken anywhere.
function holds(page, word) {
  if (page.texts.has(word)) return true;
  for (let k = 1; k < word.length; ++k) {
    if (page.texts.has(word.slice(0, k)) && holds(page, word.slice(k))) return true;
  }
  return false;
}
const holdsAll = (page, words) => words.every((word) => holds(page, word));

// Where the words stand one after the other.
function placesOf(page, words) {
  const places = [];
  for (let k = 0; k + words.length <= page.words.length; ++k) {
    if (words.every((word, n) => page.words[k + n].text === word)) places.push(page.words[k]);
  }
  return places;
}

// The content of the page that has to be found on paper.
async function contentOf(page) {
  return page.evaluate((ids) => {
    const shown = (element) => !element.closest('.screen-only');
    const text = (element) => {
      const copy = element.cloneNode(true);
      copy.querySelectorAll('svg').forEach((svg) => svg.remove());
      copy.querySelectorAll('small, div, br').forEach((one) => one.before(' '));
      return copy.textContent;
    };
    return {
      headings: [...document.querySelectorAll('main h1, main h2, main h3')].filter(shown).map((one) => ({ text: one.textContent, table: one.nextElementSibling?.matches('table, .scroll') ?? false })),
      tables: ids.filter((id) => document.getElementById(id)).map((id) => ({
        id,
        head: [...document.querySelectorAll(`#${id} thead th`)].map(text),
        rows: [...document.querySelectorAll(`#${id} tbody tr`)].map((row) => [...row.cells].map(text).join(' ')),
      })),
      figures: [...document.querySelectorAll('main figure')].filter(shown).map((figure) => [...figure.querySelectorAll('text')].map((one) => one.textContent)),
      title: [...document.querySelectorAll('.title dd')].map(text),
      areas: [...document.querySelectorAll('#areas tbody tr')].map((row) => row.querySelector('b').textContent),
    };
  }, tables);
}

function checkTable(tally, name, pages, { id, head, rows }) {
  const lost = rows.filter((row) => !pages.some((page) => holdsAll(page, wordsOf(row))));
  tally.check(`${name}: every row of #${id} is whole, on one page`, rows.length > 0 && lost.length === 0, `${rows.length} rows${lost.length > 0 ? `; not ${lost[0]}` : ''}`);
  // A page with a row has the heading of every column.
  const headless = [];
  for (const row of rows) {
    const on = pages.filter((page) => holdsAll(page, wordsOf(row)));
    for (const column of head) {
      if (!on.some((page) => holdsAll(page, wordsOf(column)))) headless.push(`${column} of ${row}`);
    }
  }
  tally.check(`${name}: every column of #${id} has its heading wherever it goes on`, headless.length === 0, headless[0]);
}

// Below each heading something follows on the same page; of a table more than its head.
function checkHeadings(tally, name, pages, headings) {
  const orphans = headings.filter(({ text, table }) => {
    const found = pages.flatMap((page) => placesOf(page, wordsOf(text)).map((place) => ({ page, place })));
    return !found.some(({ page, place }) => {
      const foot = page.height - 45; // the page's number is below
      const below = page.words.filter((word) => word.top > place.bottom && word.bottom < foot);
      return new Set(below.map((word) => Math.round(word.bottom))).size >= (table ? 2 : 1);
    });
  });
  tally.check(`${name}: no heading at the end of a page`, headings.length > 0 && orphans.length === 0, `${headings.length} headings${orphans.length > 0 ? `; not ${orphans[0].text}` : ''}`);
}

function checkFigures(tally, name, pages, figures) {
  const cut = figures.filter((texts) => texts.length > 0 && !pages.some((page) => texts.every((text) => holdsAll(page, wordsOf(text)))));
  tally.check(`${name}: every figure is whole, on one page`, cut.length === 0, `${figures.length} figures${cut.length > 0 ? `; not ${cut[0][0]}` : ''}`);
}

function checkPages(tally, name, pages, content) {
  const numbered = pages.filter((page, k) => placesOf(page, [String(k + 1), '/', String(pages.length)]).length > 0).length;
  tally.check(`${name}: pages are numbered`, numbered === pages.length, `${numbered} of ${pages.length} pages`);
  const empty = pages.filter((page) => page.words.length < 25).length;
  tally.check(`${name}: no page is nearly empty`, empty === 0, `${empty} pages`);
  // On A4 nothing is beyond the margin.
  const beyond = pages.flatMap((page) => page.words.filter((word) => word.right > 595.3 - 30 || word.left < 30));
  tally.check(`${name}: nothing is beyond the margins`, beyond.length === 0, beyond[0]?.text);
  for (const text of [...content.title, ...content.areas])
    tally.check(`${name}: the first page has '${text}'`, holdsAll(pages[0], wordsOf(text)));
}

const [folder, ...results] = process.argv.slice(2);
const tally = new Tally();
const browser = await launch(folder);
for (const name of results) {
  const url = pathToFileURL(path.resolve(name, 'report.html')).href;
  const pdf = path.join(name, 'printed.pdf');
  await run('/usr/bin/chromium', ['--headless', '--no-sandbox', '--disable-gpu', '--no-pdf-header-footer', `--print-to-pdf=${pdf}`, url]);
  const page = await browser.newPage();
  await page.goto(url);
  const content = await contentOf(page);
  await page.close();
  const pages = await pagesOf(pdf);
  checkPages(tally, name, pages, content);
  checkHeadings(tally, name, pages, content.headings);
  checkFigures(tally, name, pages, content.figures);
  for (const table of content.tables) checkTable(tally, name, pages, table);
}
await browser.close();
process.exitCode = tally.close();
