// node validate.js FILE...: fails where the Khronos validator finds errors or warnings, or where a file holds no triangles.
const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');

async function check(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {uri: path.basename(file)});
  const {numErrors, numWarnings, messages} = report.issues;
  for (const {code, message, pointer, severity} of messages)
    if (severity < 2) console.log(`${file}: ${code} at ${pointer}: ${message}`);
  console.log(`${path.basename(file)}: ${report.info.totalTriangleCount} triangles, ${numErrors} errors, ` +
              `${numWarnings} warnings, ${messages.length} messages`);
  return numErrors + numWarnings === 0 && report.info.totalTriangleCount > 0;
}

async function main() {
  const files = process.argv.slice(2);
  let sound = files.length > 0;
  for (const file of files) sound = (await check(file)) && sound;
  process.exitCode = sound ? 0 : 1;
}

main();
