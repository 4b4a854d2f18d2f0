// node project.js "16 numbers, row by row" WIDTH HEIGHT: JSON records on lines, read in blocks
'use strict';
const m = process.argv[2].trim().split(/\s+/).map(Number), width = +process.argv[3], height = +process.argv[4];
let rest = '';
process.stdin.setEncoding('utf8');
process.stdin.on('data', (block) => {
  const lines = (rest + block).split('\n');
  rest = lines.pop();
  let out = '';
  for (const line of lines) {
    const p = JSON.parse(line);
    const w = p.x * m[12] + p.y * m[13] + p.z * m[14] + m[15];
    p.screen = [((p.x * m[0] + p.y * m[1] + p.z * m[2] + m[3]) / w + 1) / 2 * width,
                (1 - (p.x * m[4] + p.y * m[5] + p.z * m[6] + m[7]) / w) / 2 * height];
    p.depth = ((p.x * m[8] + p.y * m[9] + p.z * m[10] + m[11]) / w + 1) / 2;
    out += JSON.stringify(p) + '\n';
  }
  if (!process.stdout.write(out)) { process.stdin.pause(); process.stdout.once('drain', () => process.stdin.resume()); }
});
