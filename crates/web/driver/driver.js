// Opens the page in Chromium, from its files, and compares it with native pictures:
//     node driver.js CHROMIUM FOLDER CASES SCREENSHOTS
// CASES is what `native hashes` has printed. Ends with a message and 1 at the first difference.
"use strict";

const fs = require("fs");
const path = require("path");
const { pathToFileURL } = require("url");
const { chromium } = require("playwright-core");

const [executablePath, folder, casesFile, screenshots] = process.argv.slice(2);
const cases = fs.readFileSync(casesFile, "utf8").trim().split("\n").map((line) => JSON.parse(line));
const stations = [...new Set(cases.map((of) => of.station))];
const index = pathToFileURL(path.join(folder, "index.html")).href;

/** The functions that run in the page. */
const inPage = () => {
  const station = (name) => document.getElementById(name);
  const frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  /** Waits for the picture of what has been set. */
  const drawn = async () => {
    do await frame();
    while (["waiting", "drawing"].includes(document.documentElement.dataset.state));
  };
  const pixels = (section) => {
    const canvas = section.querySelector("canvas");
    return canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  };
  window.check = {
    /** Puts controls at these positions, and draws. Returns those that did not take theirs. */
    async set(name, positions) {
      const wrong = [];
      for (const [k, position] of Object.entries(positions)) {
        const input = station(name).querySelector(`[data-parameter="${k}"]`);
        if (input.type === "checkbox") input.checked = position > 0.5;
        else input.value = position;
        const found = input.type === "checkbox" ? Number(input.checked) : Number(input.value);
        if (found !== position) wrong.push(`${k}: ${found} instead of ${position}`);
        input.dispatchEvent(new Event("input", { bubbles: true }));
      }
      await drawn();
      return wrong;
    },
    hash(name) {
      return hash(new Uint32Array(pixels(station(name)).buffer));
    },
    /** The picture, with the drawing over it, and the diagram and the table beside it. */
    seen(name) {
      const beside = [...station(name).querySelectorAll("svg, table")].map((element) => element.innerHTML);
      return [this.hash(name), ...beside].join("\n");
    },
    controls(name) {
      return [...station(name).querySelectorAll("label [data-parameter]")].map((input) => ({
        parameter: input.dataset.parameter,
        label: input.closest("label").textContent.trim(),
        positions: input.type === "checkbox" ? [0, 1] : [Number(input.max), Number(input.min)],
      }));
    },
  };
};

function assert(holds, text) {
  if (!holds) throw new Error(text);
}

/** A page whose errors end the check. */
async function open(browser, query, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1180, height: 900 }, ...options });
  const page = await context.newPage();
  const faults = [];
  page.on("pageerror", (error) => faults.push(`an error in the page: ${error.message}`));
  page.on("console", (line) => {
    if (["error", "warning"].includes(line.type())) faults.push(`the console says: ${line.text()}`);
  });
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) faults.push(`the page asks the network for ${request.url()}`);
  });
  await page.addInitScript({ path: path.join(__dirname, "hash.js") });
  await page.addInitScript(inPage);
  const show = async (name) => {
    await page.goto(`${index}${query}#${name}`);
    const drawn = page.waitForSelector(`#${name}[data-drawn]`, { timeout: 20000 });
    await drawn.catch((error) => assert(false, `${name}: ${faults[0] ?? error.message}`));
  };
  const sound = (what) => assert(faults.length === 0, `${what}: ${faults[0]}`);
  return { page, context, show, sound };
}

async function checkStation({ page, show, sound }, name, simd) {
  const what = `${name} (${simd === "1" ? "simd128" : "plain"})`;
  await show(name);
  const loaded = await page.evaluate(() => document.documentElement.dataset.simd);
  assert(loaded === simd, `${what}: the page has loaded the other program`);
  const shared = simd === "1" && ["mipmaps", "relief", "model"].includes(name);
  const workers = (await page.locator("#speed").textContent()).includes("by 3 workers");
  assert(workers === shared, `${what}: ${shared ? "workers do not draw it" : "workers draw it"}`);
  const set = (positions) => page.evaluate(([name, positions]) => check.set(name, positions), [name, positions]);
  const of = (f) => page.evaluate(([name, f]) => check[f](name), [name, f]);

  const own = cases.filter((one) => one.station === name);
  assert((await of("hash")) === own[0].hash, `${what}: the first picture is not the native one`);
  for (const { parameters, hash } of own) {
    const wrong = await set({ ...parameters });
    assert(wrong.length === 0, `${what}: controls have other steps, ${wrong[0]}`);
    const found = await of("hash");
    assert(found === hash, `${what} at ${parameters}: the canvas has the hash ${found}, the native picture ${hash}`);
  }

  const first = { ...own[0].parameters };
  const controls = await of("controls");
  for (const { parameter, label, positions } of controls) {
    // Some controls need another one: a mirrored texture for its mistake.
    const begin = name === "frames" && parameter === "5" ? { ...first, 4: 1 } : first;
    await set(begin);
    const before = await of("seen");
    let changed = false;
    for (const position of positions) {
      await set({ ...begin, [parameter]: position });
      changed ||= (await of("seen")) !== before;
    }
    assert(changed, `${what}: the control “${label}” does not change the picture`);
  }
  await set(first);

  // Keys move a slider by a step, and the words beside it say so.
  const slider = page.locator(`#${name} input[type=range]`).first();
  const position = async () => [await slider.inputValue(), await slider.getAttribute("aria-valuetext")].join(": ");
  const before = await position();
  await slider.focus();
  // At an end one of the two has no way to go.
  for (const key of ["ArrowRight", "ArrowLeft"]) {
    if ((await position()) === before) await page.keyboard.press(key);
    await set({});
  }
  const after = await position();
  const moved = after.split(": ").every((part, k) => part !== before.split(": ")[k]);
  assert(moved, `${what}: keys move ${before} to ${after}`);
  await set(first);

  const handle = { pipeline: ".diagram" }[name] ?? "canvas";
  if (handle !== "canvas" || (await page.locator(`#${name}[data-drag]`).count())) {
    const before = await of("seen");
    const box = await page.locator(`#${name} ${handle}`).boundingBox();
    await page.mouse.move(box.x + 0.3 * box.width, box.y + 0.5 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.45 * box.width, box.y + 0.4 * box.height, { steps: 3 });
    await page.mouse.up();
    await page.mouse.move(2, 2);
    await set({});
    assert((await of("seen")) !== before, `${what}: dragging does not change the picture`);
    await set(first);
  }
  sound(what);
  return { sets: own.length, controls: controls.length };
}

/** A finger on the wall moves the lamp. */
async function checkTouch(browser) {
  const opened = await open(browser, "", { hasTouch: true, viewport: { width: 360, height: 740 } });
  const { page, show, sound, context } = opened;
  await show("relief");
  const before = await page.evaluate(() => check.hash("relief"));
  await page.locator("#relief canvas").scrollIntoViewIfNeeded();
  const box = await page.locator("#relief canvas").boundingBox();
  const protocol = await context.newCDPSession(page);
  const touch = (type, share) => {
    const points = share === undefined ? [] : [{ x: box.x + share * box.width, y: box.y + 0.4 * box.height }];
    return protocol.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  };
  await touch("touchStart", 0.3);
  for (const share of [0.4, 0.5, 0.6]) await touch("touchMove", share);
  await touch("touchEnd");
  await page.evaluate(() => check.set("relief", {}));
  assert((await page.evaluate(() => check.hash("relief"))) !== before, "touch: a finger does not move the lamp");
  sound("touch");
  await context.close();
}

/** A model of a file, its texture, and files that are none. */
async function checkModel(browser) {
  const { page, show, sound, context } = await open(browser, "");
  await show("model");
  const given = (name, text, mimeType = "") => ({ name, mimeType, buffer: Buffer.from(text) });
  const take = async (...files) => {
    await page.setInputFiles("#model input[type=file]", files);
    await page.waitForTimeout(300);
    await page.evaluate(() => check.set("model", {}));
    const fault = page.locator("#model form .message");
    return [await page.evaluate(() => check.hash("model")), (await fault.isVisible()) ? await fault.textContent() : ""];
  };
  const clay = await page.evaluate(() => check.hash("model"));
  const cube = "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
  const [quad, none] = await take(given("quad.obj", cube));
  assert(quad !== clay && none === "", `model: a quad is not taken: ${none}`);
  const size = `width="64" height="64"`;
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" ${size}><rect ${size} fill="teal"/></svg>`;
  const pixels = await page.evaluate(async (svg) => {
    const image = Object.assign(new Image(), { src: `data:image/svg+xml,${encodeURIComponent(svg)}` });
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: 64, height: 64 });
    canvas.getContext("2d").drawImage(image, 0, 0);
    return canvas.toDataURL("image/png").split(",")[1];
  }, svg);
  const texture = { name: "teal.png", mimeType: "image/png", buffer: Buffer.from(pixels, "base64") };
  const [teal, fine] = await take(texture);
  assert(teal !== quad && fine === "", `model: a texture is not taken: ${fine}`);
  const [kept, told] = await take(given("torn.obj", "v 1 2\n"));
  assert(kept === teal && told.includes("line 1 of the model"), `model: a torn file is told as “${told}”`);
  const [, unknown] = await take(given("model.stl", "solid"));
  assert(unknown.includes("OBJ"), `model: a file of another kind is told as “${unknown}”`);
  await page.click("#model .forget");
  await page.evaluate(() => check.set("model", {}));
  assert((await page.evaluate(() => check.hash("model"))) === clay, "model: the clay does not come back");
  sound("model");
  await context.close();
}

async function screens(browser) {
  const looks = {
    light: { colorScheme: "light" },
    dark: { colorScheme: "dark" },
    narrow: { colorScheme: "light", viewport: { width: 360, height: 740 }, deviceScaleFactor: 2 },
  };
  for (const [look, options] of Object.entries(looks)) {
    const { page, show, sound, context } = await open(browser, "", { ...options, reducedMotion: "reduce" });
    const fits = async (name) => {
      const [wide, has] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert(wide <= has, `${name} (${look}): the page is ${wide} wide, the window ${has}`);
    };
    for (const name of stations) {
      await show(name);
      await page.screenshot({ path: path.join(screenshots, `${name}-${look}.png`), fullPage: true });
      await fits(name);
    }
    await page.goto(index.replace(/index\.html$/, "theory.html"));
    await page.screenshot({ path: path.join(screenshots, `theory-${look}.png`) });
    await fits("theory");
    sound(look);
    await context.close();
  }
}

/** Links of the page lead to headings that are there. */
async function checkLinks(browser) {
  const { page, show, context } = await open(browser, "");
  await show(stations[0]);
  const links = await page.$$eval("a[href^='theory.html#']", (found) => found.map((link) => link.getAttribute("href")));
  await page.goto(index.replace(/index\.html$/, "theory.html"));
  for (const link of links) {
    const anchor = link.split("#")[1];
    assert(await page.evaluate((anchor) => !!document.getElementById(anchor), anchor), `no heading for ${link}`);
  }
  assert(links.length >= stations.length, "a station has no link to the theory");
  await context.close();
}

async function run() {
  fs.mkdirSync(screenshots, { recursive: true });
  // Without the sandbox, since a check may run as root in a container.
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  try {
    // By one thread, and by workers, of which there are as many on any machine.
    for (const [query, simd] of [["?workers=3", "1"], ["?simd=0&workers=1", "0"]]) {
      const opened = await open(browser, query);
      for (const name of stations) {
        const { sets, controls } = await checkStation(opened, name, simd);
        const program = simd === "1" ? "simd128" : "plain  ";
        console.log(`${name.padEnd(10)} ${program}  ${sets} pictures as native, ${controls} controls`);
      }
      await opened.context.close();
    }
    await checkTouch(browser);
    await checkModel(browser);
    await checkLinks(browser);
    await screens(browser);
  } finally {
    await browser.close();
  }
}

run().catch((error) => {
  console.error(`driver: ${error.message}`);
  process.exit(1);
});
