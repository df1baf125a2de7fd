// Times of pictures of 640x480 on the page in Chromium, as a control moves, by one thread and by workers:
//     node frames.js CHROMIUM FOLDER
// Each line has the milliseconds from a control's place to all pixels: the median of so many frames.
"use strict";

const path = require("path");
const { pathToFileURL } = require("url");
const { chromium } = require("playwright-core");

const [executablePath, folder] = process.argv.slice(2);
const FRAMES = 41;
/** The stations, and a control of each that changes all of the picture. */
const CONTROLS = { mipmaps: 4, relief: 4, projector: 0, frames: 6, model: 0 };

/** Moves a control to and fro, and returns the times of the pictures in order. */
const times = async ([name, parameter, frames]) => {
  const root = document.documentElement;
  const input = document.getElementById(name).querySelector(`[data-parameter="${parameter}"]`);
  const [first, step] = [Number(input.value), Number(input.step)];
  const found = [];
  for (let frame = 0; frame < frames; frame++) {
    input.value = first + step * ((frame % 5) - 2);
    input.dispatchEvent(new Event("input", { bubbles: true }));
    do await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    while (["waiting", "drawing"].includes(root.dataset.state));
    found.push(Number(root.dataset.milliseconds));
  }
  return found.sort((a, b) => a - b);
};

async function run() {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  const table = {};
  let workers;
  try {
    const page = await browser.newPage({ viewport: { width: 1180, height: 900 } });
    workers = await page.evaluate(() => navigator.hardwareConcurrency);
    for (const query of ["?workers=1", `?workers=${workers}`]) {
      for (const [name, parameter] of Object.entries(CONTROLS)) {
        await page.goto(`${pathToFileURL(path.join(folder, "index.html")).href}${query}#${name}`);
        await page.waitForSelector(`#${name}[data-drawn]`, { timeout: 20000 });
        // The program is still being compiled at first.
        await page.evaluate(times, [name, parameter, 10]);
        const sorted = await page.evaluate(times, [name, parameter, FRAMES]);
        (table[name] ??= []).push(sorted[(FRAMES - 1) / 2]);
      }
    }
  } finally {
    await browser.close();
  }
  const cell = (text) => String(text).padStart(12);
  console.log(["in Chromium", cell("one thread"), cell(`${workers} workers`), cell("frames/s")].join(" "));
  for (const [name, [alone, together]] of Object.entries(table)) {
    const cells = [alone.toFixed(1), together.toFixed(1), (1000 / together).toFixed(0)].map(cell);
    console.log([name.padEnd(11), ...cells].join(" "));
  }
}

run().catch((error) => {
  console.error(`frames: ${error.message}`);
  process.exit(1);
});
