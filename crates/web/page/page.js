// The page: it loads the program, shows the station of the address, and draws when something has changed.
"use strict";

(() => {
  const NAMES = ["affine", "depth", "pipeline", "mipmaps", "relief", "projector", "frames", "model"];
  /** Those that take one thread too long, and are drawn by workers together. */
  const SHARED = ["mipmaps", "relief", "model"];
  const MOST_WORKERS = 8;
  /** The results that are sums over the rows of a picture. */
  const SUMS = { model: [2] };
  const message = document.getElementById("message");
  const root = document.documentElement;
  let program;
  let crew;
  let current;
  let waiting = false;
  let drawing = false;
  let begun = false;

  function bytes(text) {
    const binary = atob(text);
    return Uint8Array.from(binary, (c) => c.charCodeAt(0));
  }

  async function load() {
    const query = new URLSearchParams(location.search);
    let code = bytes(SIMD128);
    const simd = query.get("simd") !== "0" && WebAssembly.validate(code);
    if (!simd) code = bytes(PLAIN);
    const compiled = await WebAssembly.compile(code);
    program = (await WebAssembly.instantiate(compiled)).exports;
    root.dataset.simd = simd ? "1" : "0";
    const workers = Math.min(Number(query.get("workers") ?? navigator.hardwareConcurrency), MOST_WORKERS);
    try {
      if (workers > 1) crew = new Crew(compiled, workers);
    } catch {
      // A browser that has no workers here draws by itself.
    }
  }

  function say(text, place = message) {
    if (place.textContent !== text) place.textContent = text;
    place.hidden = text === "";
  }

  /** The program's message. */
  function told() {
    return new TextDecoder().decode(new Uint8Array(program.memory.buffer, program.message(), program.message_length()));
  }

  function inputs(section) {
    return section.querySelectorAll("[data-parameter]");
  }

  function value(input) {
    return input.type === "checkbox" ? Number(input.checked) : Number(input.value);
  }

  /** The positions of a station's controls. */
  function positions(section) {
    const found = [];
    for (const input of inputs(section)) found[input.dataset.parameter] = value(input);
    return found;
  }

  /** Draws as soon as the screen is ready for it and the picture before is done. */
  function invalidate() {
    if (!program) return;
    root.dataset.state = "waiting";
    if (waiting || drawing) return;
    waiting = true;
    requestAnimationFrame(async () => {
      waiting = false;
      drawing = true;
      root.dataset.state = "drawing";
      try {
        if (program) await draw();
      } catch (error) {
        stop(error);
      }
      drawing = false;
      if (root.dataset.state === "drawing") root.dataset.state = "drawn";
      else invalidate();
    });
  }

  /** After a fault of the program itself nothing of it can be trusted. */
  function stop(error) {
    program = undefined;
    root.dataset.state = "stopped";
    crew?.end();
    say(`The program has stopped: ${error.message}. Load the page again.`);
  }

  /** A picture by this thread: its pixels, its results, or why there is none. */
  function drawAlone({ station, width, height, found }) {
    const controls = new Float32Array(program.memory.buffer, program.parameters(), 16);
    controls.fill(0);
    controls.set(found);
    const address = program.pixels(station, width, height);
    if (!address) return { fault: told() };
    const pixels = new Uint8ClampedArray(program.memory.buffer, address, 4 * width * height);
    const results = new Float32Array(program.memory.buffer, program.results(), program.result_count()).slice();
    return { pixels, results: [results] };
  }

  async function drawTogether(picture) {
    try {
      return await crew.draw(picture);
    } catch (error) {
      // Workers that do not work are not asked again.
      crew.end();
      crew = undefined;
      return drawAlone(picture);
    }
  }

  async function draw() {
    const section = current;
    const [width, height] = [Number(section.dataset.width), Number(section.dataset.height)];
    const found = positions(section);
    const picture = { station: NAMES.indexOf(section.id), width, height, found };
    const begin = performance.now();
    const shared = crew && SHARED.includes(section.id);
    const { pixels, results, fault } = shared ? await drawTogether(picture) : drawAlone(picture);
    const time = performance.now() - begin;
    root.dataset.milliseconds = String(time);
    const by = shared && crew ? ` by ${crew.workers.length} workers` : "";
    document.getElementById("speed").textContent = `The last took ${time.toFixed(1)} ms${by}.`;
    if (fault) {
      say(`No picture: ${fault}.`);
      return;
    }
    say("");
    const canvas = section.querySelector("canvas");
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    canvas.getContext("2d", { willReadFrequently: true }).putImageData(new ImageData(pixels, width, height), 0, 0);
    const all = results[0].slice();
    for (const k of SUMS[section.id] ?? []) all[k] = results.reduce((sum, of) => sum + of[k], 0);
    show(section, found, Stations[section.id](section, all, found));
    section.dataset.drawn = String(Number(section.dataset.drawn ?? 0) + 1);
  }

  /** The words beside the picture. */
  function show(section, found, { readout, outputs = {}, unused = [] }) {
    for (const input of inputs(section)) {
      const k = Number(input.dataset.parameter);
      const label = input.closest("label");
      label?.classList.toggle("unused", unused.includes(k));
      const output = label?.querySelector("output");
      if (!output) continue;
      const names = input.dataset.names?.split("|");
      const shown = outputs[k] ?? String(found[k]).replace("-", "−");
      const text = names ? names[found[k]] : shown + (input.dataset.unit ?? "");
      output.textContent = text;
      input.setAttribute("aria-valuetext", text);
    }
    const list = section.querySelector(".readout");
    const words = readout.flat();
    if (list.children.length !== words.length) {
      list.replaceChildren(...words.map((_, k) => document.createElement(k % 2 ? "dd" : "dt")));
    }
    words.forEach((word, k) => {
      if (list.children[k].textContent !== word) list.children[k].textContent = word;
    });
  }

  /** Shows the station of the address. */
  function turn() {
    const name = location.hash.slice(1);
    current = document.getElementById(NAMES.includes(name) ? name : NAMES[0]);
    for (const section of document.querySelectorAll("section")) section.hidden = section !== current;
    for (const link of document.querySelectorAll("nav a")) {
      if (link.hash === `#${current.id}`) {
        link.setAttribute("aria-current", "page");
        link.scrollIntoView({ block: "nearest", inline: "nearest" });
      } else link.removeAttribute("aria-current");
    }
    document.title = `${current.querySelector("h1").lastChild.textContent.trim()} – alberti`;
    if (begun) scrollTo(0, 0);
    begun = true;
    invalidate();
  }

  /** Moves a control by a share of its range. */
  function move(section, parameter, share) {
    const input = section.querySelector(`[data-parameter="${parameter}"]`);
    const [least, most] = [Number(input.min), Number(input.max)];
    const exact = (input.exact ?? Number(input.value)) + share * (most - least);
    // The rest of a step is kept for the next move.
    input.exact = Math.min(most, Math.max(least, exact));
    input.value = input.exact;
  }

  function settle(section) {
    for (const input of inputs(section)) delete input.exact;
  }

  /** Calls `moved` with the way of a pointer that drags, in shares of the element's size. */
  function onDrag(element, section, moved) {
    let last;
    element.addEventListener("pointerdown", (event) => {
      last = event;
      settle(section);
      element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
      if (!last || event.pointerId !== last.pointerId) return;
      const box = element.getBoundingClientRect();
      moved((event.clientX - last.clientX) / box.width, (last.clientY - event.clientY) / box.height, event, box);
      last = event;
      invalidate();
    });
    for (const name of ["pointerup", "pointercancel"]) element.addEventListener(name, () => (last = undefined));
  }

  function pointers(section, canvas) {
    const places = ["x", "y"].map((axis) => section.querySelector(`[data-pointer="${axis}"]`));
    if (!places[0]) return;
    canvas.addEventListener("pointermove", (event) => {
      const box = canvas.getBoundingClientRect();
      const at = (share, size) => Math.min(size - 1, Math.max(0, Math.floor(share * size)));
      places[0].value = at((event.clientX - box.left) / box.width, canvas.width);
      places[1].value = at((event.clientY - box.top) / box.height, canvas.height);
      invalidate();
    });
    canvas.addEventListener("pointerleave", () => {
      for (const place of places) place.value = -1;
      invalidate();
    });
  }

  for (const section of document.querySelectorAll("section")) {
    const canvas = section.querySelector("canvas");
    section.querySelector("form").addEventListener("input", () => {
      settle(section);
      invalidate();
    });
    section.querySelector("form").addEventListener("submit", (event) => event.preventDefault());
    pointers(section, canvas);
    const drag = section.dataset.drag?.split(" ");
    if (drag) {
      onDrag(canvas, section, (right, up) => {
        move(section, drag[0], right);
        move(section, drag[1], up);
      });
    }
  }

  // The triangle of the pipeline: 30 units of the diagram are one of the world.
  const pipeline = document.getElementById("pipeline");
  const diagram = pipeline.querySelector(".diagram");
  onDrag(diagram, pipeline, (right, up, event, box) => {
    const [across, upwards] = [(right * 640) / 30, (up * 300) / 30];
    const side = event.clientX < box.left + box.width / 2;
    move(pipeline, side ? 3 : 1, side ? -across / 9 : across / 6);
    move(pipeline, 2, upwards / 4);
  });

  // Files: the mesh, and images as the browser decodes them.
  const model = document.getElementById("model");
  const fault = model.querySelector("form .message");

  function hand(kind, data, width = 0, height = 0) {
    const room = program.reserve(data.length);
    if (room || data.length === 0) new Uint8Array(program.memory.buffer).set(data, room);
    if ((!room && data.length > 0) || !program.load(kind, width, height)) throw new Error(told());
    crew?.take({ kind, data, width, height });
  }

  async function take(file) {
    if (/\.obj$/i.test(file.name)) return hand(0, new Uint8Array(await file.arrayBuffer()));
    if (!file.type.startsWith("image/")) {
      throw new Error("found neither an OBJ model nor an image; export the model as OBJ (Wavefront)");
    }
    // No colour conversion and no premultiplied alpha: texels as they are in the file.
    const image = await createImageBitmap(file, { colorSpaceConversion: "none", premultiplyAlpha: "none" });
    const scale = Math.min(1, 4096 / Math.max(image.width, image.height));
    const [width, height] = [image.width, image.height].map((side) => Math.max(1, Math.round(side * scale)));
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0, width, height);
    hand(/normal|_nrm|_nor\b/i.test(file.name) ? 2 : 1, context.getImageData(0, 0, width, height).data, width, height);
  }

  async function takeAll(files) {
    const faults = [];
    for (const file of files) {
      try {
        await take(file);
      } catch (error) {
        if (error instanceof WebAssembly.RuntimeError) return stop(error);
        faults.push(`${file.name}: ${error.message}`);
      }
    }
    say(faults.join(" — "), fault);
    invalidate();
  }

  const picture = model.querySelector(".drop");
  for (const name of ["dragover", "dragenter"]) {
    document.addEventListener(name, (event) => {
      event.preventDefault();
      if (current === model) picture.classList.add("over");
    });
  }
  for (const name of ["dragleave", "drop"]) {
    document.addEventListener(name, (event) => {
      event.preventDefault();
      picture.classList.remove("over");
    });
  }
  document.addEventListener("drop", (event) => {
    if (current === model && event.dataTransfer) takeAll(event.dataTransfer.files);
  });
  model.querySelector("input[type=file]").addEventListener("change", (event) => takeAll(event.target.files));
  model.querySelector(".forget").addEventListener("click", () => {
    hand(3, new Uint8Array());
    say("", fault);
    invalidate();
  });

  addEventListener("hashchange", turn);
  turn();
  load().then(invalidate, (error) => {
    say(`The program does not start: ${error.message}. It needs a browser with WebAssembly.`);
  });
})();
