// The crew: programs in workers, each of which draws rows of a picture.
"use strict";

/** The work of a worker, whose text is its script. It has the program's functions alone. */
function work() {
  let program;
  const told = () => {
    const { memory, message, message_length } = program;
    return new TextDecoder().decode(new Uint8Array(memory.buffer, message(), message_length()));
  };
  onmessage = async ({ data: { code, file, picture } }) => {
    try {
      if (code) program = (await WebAssembly.instantiate(code)).exports;
      if (file) {
        const { kind, data, width, height } = file;
        const room = program.reserve(data.length);
        if (room) new Uint8Array(program.memory.buffer).set(data, room);
        program.load(kind, width, height);
      }
      if (!picture) return;
      const { station, width, height, found, rows } = picture;
      const controls = new Float32Array(program.memory.buffer, program.parameters(), 16);
      controls.fill(0);
      controls.set(found);
      const address = program.rows(station, width, height, ...rows);
      if (!address) return postMessage({ told: told() });
      const pixels = new Uint8ClampedArray(program.memory.buffer, address, 4 * width * (rows[1] - rows[0])).slice();
      const results = new Float32Array(program.memory.buffer, program.results(), program.result_count()).slice();
      postMessage({ rows, pixels, results }, [pixels.buffer]);
    } catch (error) {
      postMessage({ stopped: error.message });
    }
  };
}

/** Workers that draw pictures together, as many as the machine has processors for. */
class Crew {
  /** Bands of a picture for each worker: those who are done early take more. */
  static BANDS = 4;

  constructor(code, count) {
    const script = URL.createObjectURL(new Blob([`(${work})()`], { type: "text/javascript" }));
    this.workers = Array.from({ length: count }, () => new Worker(script));
    URL.revokeObjectURL(script);
    for (const worker of this.workers) worker.postMessage({ code });
  }

  /** Hands all of them a file, as it was loaded. */
  take(file) {
    for (const worker of this.workers) worker.postMessage({ file });
  }

  end() {
    for (const worker of this.workers) worker.terminate();
  }

  /** A picture and its results: pixels, row by row, and the results of each band. It throws the reason if there is none. */
  draw(picture) {
    const { width, height } = picture;
    const rows = Math.ceil(height / (Crew.BANDS * this.workers.length));
    const pixels = new Uint8ClampedArray(4 * width * height);
    const results = [];
    let next = 0;
    let fault;
    const hand = (worker) => {
      const first = next;
      next = Math.min(height, first + rows);
      if (first < next) worker.postMessage({ picture: { ...picture, rows: [first, next] } });
      return first < next;
    };
    const busy = (worker) =>
      new Promise((done, failed) => {
        worker.onerror = (event) => failed(new Error(event.message || "a worker does not start"));
        worker.onmessage = ({ data }) => {
          if (data.stopped) return failed(new Error(data.stopped));
          if (data.told) fault = data.told;
          else {
            pixels.set(data.pixels, 4 * width * data.rows[0]);
            results.push(data.results);
          }
          if (fault || !hand(worker)) done();
        };
        if (!hand(worker)) done();
      });
    return Promise.all(this.workers.map(busy)).then(() => ({ pixels, results, fault }));
  }
}
