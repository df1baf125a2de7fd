// Runs a program for wasm32 in Node: node node.js PROGRAM. It prints, and ends with the program's status.
"use strict";
const fs = require("fs");

let program;
const host = {
    write: (at, length) => fs.writeSync(1, new Uint8Array(program.exports.memory.buffer, at, length)),
    end: (status) => process.exit(status),
};
program = new WebAssembly.Instance(new WebAssembly.Module(fs.readFileSync(process.argv[2])), { env: host });
program.exports.begin();
