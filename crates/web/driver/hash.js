// The hash of a picture's words: that of `hash` in src/canvas.rs.
"use strict";

function hash(words) {
  const from = (basis) => words.reduce((hash, word) => Math.imul(hash ^ word, 0x01000193), basis) >>> 0;
  const hex = (half) => half.toString(16).padStart(8, "0");
  return hex(from(0x811c9dc5)) + hex(from(0x9747b28c));
}

if (typeof window === "undefined") module.exports = { hash };
else window.hash = hash;
