// Runs the Khronos glTF validator on files and says what it finds; exit status 1 where any file has an error.
//
// node validate.mjs FOLDER FILE...     FOLDER: where node_modules/gltf-validator is

import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';

const severities = ['error', 'warning', 'info', 'hint'];

// Reads what a file refers to, from where the file is. Data URIs do not come here.
function resourceReader(file) {
  return async (uri) => new Uint8Array(await readFile(path.resolve(path.dirname(file), decodeURIComponent(uri))));
}

// Errors and warnings one by one; of infos and hints the first of each kind, with their number. (That no texture uses
// the texture coordinates, which are there for the tiles, is said once per surface.)
function collected(messages) {
  const kinds = new Map();
  messages.forEach((message, index) => {
    const kind = message.severity <= severities.indexOf('warning') ? index : message.code;
    const [first, count] = kinds.get(kind) ?? [message, 0];
    kinds.set(kind, [first, count + 1]);
  });
  return kinds.values();
}

async function validate(validator, file) {
  const bytes = new Uint8Array(await readFile(file));
  const report = await validator.validateBytes(bytes, {
    uri: path.basename(file),
    maxIssues: 0, // all of them
    externalResourceFunction: resourceReader(file),
  });
  const { numErrors, numWarnings, messages } = report.issues;
  const triangles = report.info?.totalTriangleCount ?? 0; // no info where the file could not be read at all
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${triangles} triangles`);
  for (const [message, count] of collected(messages)) {
    const place = message.pointer ?? `byte ${message.offset}`;
    const more = count > 1 ? ` (and ${count - 1} more such)` : '';
    console.log(`  ${severities[message.severity]} ${message.code} at ${place}: ${message.message}${more}`);
  }
  return numErrors === 0;
}

async function main([folder, ...files]) {
  if (files.length === 0) {
    console.error('There is no file to validate. Give the folder of the validator, then the files.');
    return 2;
  }
  const validator = createRequire(path.resolve(folder, 'package.json'))('gltf-validator');
  console.log(`Khronos glTF validator ${validator.version()}`);
  let passed = 0;
  for (const file of files) {
    // A file that is not there, or no glTF at all, fails like one with errors; the others are still looked at.
    const sound = await validate(validator, file).catch((reason) => {
      console.log(`${file}: ${reason?.message ?? reason}`);
      return false;
    });
    if (sound) passed += 1;
  }
  const failed = files.length - passed;
  console.log(`${passed} passed, ${failed} failed`);
  return failed === 0 ? 0 : 1;
}

process.exitCode = await main(process.argv.slice(2));
