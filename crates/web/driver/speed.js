// Times of pictures of 640x480 by the programs of WebAssembly in Node, beside those of native code:
//     node speed.js PLAIN.wasm SIMD128.wasm < what `native times` has printed
"use strict";

const fs = require("fs");
const { hash } = require("./hash.js");

const FRAMES = 11;

/** The least time of a station's picture in a program, in milliseconds, whose pixels are the native ones. */
function time(program, number, { station, size: [width, height], parameters, hash: expected }) {
  const controls = new Float32Array(program.memory.buffer, program.parameters(), 16);
  controls.fill(0);
  controls.set(parameters);
  const times = [];
  let address = 0;
  // The first frames are drawn while the program is still being compiled.
  for (let frame = 0; frame < FRAMES + 3; frame++) {
    const begin = performance.now();
    address = program.pixels(number, width, height);
    if (frame >= 3) times.push(performance.now() - begin);
  }
  const found = address ? hash(new Uint32Array(program.memory.buffer, address, width * height)) : "none";
  if (found !== expected) throw new Error(`${station}: the picture's hash is ${found}, of native code ${expected}`);
  return Math.min(...times);
}

const programs = process.argv.slice(2).map((file) => {
  return new WebAssembly.Instance(new WebAssembly.Module(fs.readFileSync(file))).exports;
});
const cases = fs.readFileSync(0, "utf8").trim().split("\n").map((line) => JSON.parse(line));
const cell = (text) => String(text).padStart(10);
console.log(["station   ", ...["native", "plain", "simd128", "plain/n.", "simd128/n."].map(cell)].join(" "));
try {
  cases.forEach((of, number) => {
    const times = programs.map((program) => time(program, number, of));
    const ratios = times.map((ms) => (ms / of.ms).toFixed(2));
    const cells = [of.ms, ...times].map((ms) => cell(ms.toFixed(2))).concat(ratios.map(cell));
    console.log([of.station.padEnd(10), ...cells].join(" "));
  });
} catch (error) {
  console.error(`speed: ${error.message}`);
  process.exit(1);
}
