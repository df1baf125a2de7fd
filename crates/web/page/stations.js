// The read-outs and diagrams of the stations, from the numbers that the program returns with a picture. Each station's
// source lists them.
"use strict";

const Stations = (() => {
  const SVG = "http://www.w3.org/2000/svg";

  /** A number with three digits, as people write it. */
  function number(x, digits = 3) {
    if (!Number.isFinite(x)) return "–";
    if (x === 0) return "0";
    const size = Math.abs(x);
    if (size >= 1e6 || size < 1e-3) {
      const [mantissa, exponent] = x.toExponential(digits - 2).split("e");
      const raised = [...String(Number(exponent))].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("");
      return `${mantissa.replace("-", "−")} · 10${raised}`;
    }
    const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
    return x.toLocaleString("en", { maximumFractionDigits: decimals }).replace("-", "−");
  }

  function fixed(x, decimals = 2) {
    return Number.isFinite(x) ? x.toFixed(decimals).replace("-", "−") : "–";
  }

  function draw(parent, name, attributes, text) {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (text !== undefined) element.textContent = text;
    parent.append(element);
    return element;
  }

  function cleared(svg) {
    svg.replaceChildren();
    return svg;
  }

  /** Fits an overlay to its canvas's pixels. */
  function overlay(section) {
    const svg = cleared(section.querySelector(".overlay"));
    svg.setAttribute("viewBox", `0 0 ${section.dataset.width} ${section.dataset.height}`);
    return svg;
  }

  function ring(svg, x, y, radius) {
    for (const name of ["mark dark", "mark"]) draw(svg, "circle", { class: name, cx: x, cy: y, r: radius });
  }

  function affine(section, r, p) {
    const svg = overlay(section);
    if (r[0] > 0.05) ring(svg, r[2] + 0.5, r[3] + 0.5, 9);
    const row = Array.from(r.slice(8));
    const plot = cleared(section.querySelector(".diagram"));
    const [left, right, top, bottom] = [64, 630, 14, 112];
    const most = Math.max(...row, 0.05);
    const x = (k) => left + ((right - left) * k) / row.length;
    const y = (error) => bottom - ((bottom - top) * error) / most;
    for (const share of [0, 0.5, 1]) {
      draw(plot, "line", { class: "axis", x1: left, x2: right, y1: y(share * most), y2: y(share * most) });
      draw(plot, "text", { x: left - 8, y: y(share * most) + 4, "text-anchor": "end" }, number(share * most, 2));
    }
    // A line for each part of the row that is on the board.
    let path = "";
    row.forEach((error, k) => {
      if (error >= 0) path += `${row[k - 1] >= 0 ? "L" : "M"}${x(k).toFixed(1)} ${y(error).toFixed(1)}`;
    });
    draw(plot, "path", { class: "curve chosen", d: path || "M0 0" });
    const under = { x: (left + right) / 2, y: bottom + 26, "text-anchor": "middle" };
    draw(plot, "text", under, "error in texels along the row of the ring, left picture");
    const atPointer = r[5] >= 0 ? `${number(r[5])}, right ${number(r[6], 2)}` : "point at the board";
    return {
      readout: [
        ["Greatest error, ringed", `${number(r[0])} texels`],
        ["Mean error", `${number(r[1])} texels`],
        ["Greatest on the right", `${number(r[4], 2)} texels`],
        ["At the pointer", atPointer],
        ["Bound of one edge", `${number(r[7])} texels`],
      ],
      outputs: { 0: fixed(p[0], 1) },
    };
  }

  const FORMATS = ["16 bits", "24 bits", "float", "float, reversed"];

  function depth(section, r, p) {
    const [near, far, gap, alpha, beta, wrong, road, fight] = r;
    const count = (r.length - 8) / 5;
    const row = (k) => Array.from(r.slice(8 + k * count, 8 + (k + 1) * count));
    const depths = row(0);
    const svg = cleared(section.querySelector(".diagram"));
    const [left, right, top, bottom] = [70, 476, 16, 210];
    const log = Math.log10;
    const curves = [1, 2, 3, 4].map(row);
    const positive = curves.flat().filter((dz) => dz > 0);
    const low = Math.floor(log(Math.min(...positive, gap * near)));
    const high = Math.ceil(log(Math.max(...positive, gap * far)));
    const x = (z) => left + ((right - left) * log(z / near)) / log(far / near);
    const y = (dz) => bottom - ((bottom - top) * (log(dz) - low)) / (high - low);
    const power = (k) => `10${[...String(k)].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("")}`;
    for (let k = Math.ceil(log(near) - 1e-6); k <= log(far) + 1e-6; k++) {
      draw(svg, "line", { class: "axis", x1: x(10 ** k), x2: x(10 ** k), y1: top, y2: bottom });
      draw(svg, "text", { x: x(10 ** k), y: bottom + 19, "text-anchor": "middle" }, power(k));
    }
    const step = Math.max(1, Math.round((high - low) / 5));
    for (let k = low; k <= high; k += step) {
      draw(svg, "line", { class: "axis", x1: left, x2: right, y1: y(10 ** k), y2: y(10 ** k) });
      draw(svg, "text", { x: left - 8, y: y(10 ** k) + 4, "text-anchor": "end" }, power(k));
    }
    draw(svg, "text", { x: (left + right) / 2, y: bottom + 42, "text-anchor": "middle" }, "resolution dz over depth z");
    draw(svg, "line", { class: "edge", x1: x(near), y1: y(gap * near), x2: x(far), y2: y(gap * far) });
    if (fight > 0) draw(svg, "line", { class: "limit", x1: x(fight), x2: x(fight), y1: top, y2: bottom });
    const labels = [["road to ground", gap * far]];
    curves.forEach((curve, k) => {
      const points = curve.map((dz, i) => `${x(depths[i]).toFixed(1)},${y(dz).toFixed(1)}`).join(" ");
      draw(svg, "polyline", { class: k === Math.round(p[2]) ? "curve chosen" : "curve", points });
      labels.push([FORMATS[k], curve[count - 1]]);
    });
    // Labels keep a line's distance from each other.
    let last = -Infinity;
    const placed = labels.map(([name, dz]) => [name, y(dz)]).sort((a, b) => a[1] - b[1]);
    for (const [name, at] of placed) {
      last = Math.max(at + 4, last + 18);
      draw(svg, "text", { x: right + 8, y: last }, name);
    }
    return {
      readout: [
        ["α", number(alpha, 6)],
        ["β", number(beta, 6)],
        ["Road that is lost", `${number((100 * wrong) / Math.max(road, 1))} %`],
        ["They fight from depth", fight > 0 ? number(fight) : "nowhere"],
      ],
      outputs: { 0: number(near), 1: number(far), 3: number(gap) },
    };
  }

  const STEPS = [
    { names: ["x", "y", "z"], note: "In the world; the camera looks at the origin." },
    { names: ["xₑ", "yₑ", "zₑ"], note: "In the eye’s space: x right, y up, z forward." },
    { names: ["xₑ", "yₑ", "zₑ"], note: "x and y times cot ω, so that the sides are x = ±z, y = ±z." },
    { names: ["xₑ", "yₑ", "zₑ"], note: "Cut at z = A and z = B, before the division." },
    { names: ["xₛ", "yₛ", "zₛ"], note: "Divided by z, with depth α + β/z." },
    { names: ["xₛ", "yₛ", "zₛ"], note: "Cut at the sides ±1 of the window." },
    { names: ["column", "row", "zₛ"], note: "In pixels, rows downwards, to the nearest 1/256." },
  ];

  /** The vertices of each step. */
  function steps(r) {
    const found = [];
    for (let at = 6; at < r.length; ) {
      const count = r[at];
      const vertices = [];
      for (let k = 0; k < count; k++) {
        const [x, y, z, red, green, blue] = r.slice(at + 1 + 6 * k, at + 7 + 6 * k);
        const color = `rgb(${[red, green, blue].map((c) => Math.round(255 * c)).join(",")})`;
        vertices.push({ x, y, z, color });
      }
      found.push(vertices);
      at += 1 + 6 * count;
    }
    return found;
  }

  function pipeline(section, r, p) {
    const [alpha, beta, cotangent, fragments, near, far] = r;
    const step = Math.round(p[0]);
    const all = steps(r);
    const vertices = all[step];
    const svg = cleared(section.querySelector(".diagram"));
    const [width, height] = [Number(section.dataset.width), Number(section.dataset.height)];

    // A panel's middle, its scale, and the coordinates that it shows.
    const side = { left: 0, title: "from the side", of: (v) => [v.z, v.y], up: 1 };
    const front = { left: 320, title: step < 4 ? "from the eye" : "from the front", of: (v) => [v.x, v.y], up: 1 };
    const plane = (panel, range) => {
      const [x0, x1, y0, y1] = range;
      const scale = Math.min(290 / (x1 - x0), 250 / (y1 - y0));
      const [cx, cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
      panel.at = ([x, y]) => [panel.left + 160 + (x - cx) * scale, 158 - panel.up * (y - cy) * scale];
    };
    if (step === 0) {
      side.of = (v) => [-v.z, v.y];
      plane(side, [-5, 5, -3.2, 3.2]);
      plane(front, [-4, 4, -3.2, 3.2]);
    } else if (step === 1) {
      plane(side, [0, 9.5, -4, 4]);
      plane(front, [-5, 5, -4, 4]);
    } else if (step < 4) {
      plane(side, [0, 9.5, -6, 6]);
      plane(front, [-7, 7, -6, 6]);
    } else if (step < 6) {
      side.of = (v) => [2 * v.z, v.y];
      plane(side, [-0.6, 2.6, -1.7, 1.7]);
      plane(front, [-1.9, 1.9, -1.7, 1.7]);
    } else {
      side.up = front.up = -1;
      side.of = (v) => [v.z * width, v.y];
      plane(side, [-20, width + 20, -20, height + 20]);
      plane(front, [-20, width + 20, -20, height + 20]);
    }
    const line = (panel, name, ...points) => {
      const at = points.map((point) => panel.at(point).map((c) => c.toFixed(1)).join(",")).join(" ");
      draw(svg, "polyline", { class: name, points: at });
    };
    const box = (panel, x0, x1, y0, y1) =>
      line(panel, "edge", [x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]);
    const eye = (panel, point) => {
      const [x, y] = panel.at(point);
      draw(svg, "circle", { class: "limit", cx: x, cy: y, r: 4 });
      draw(svg, "text", { x: x - 4, y: y + 20 }, "eye");
    };
    for (const panel of [side, front]) draw(svg, "text", { x: panel.left + 14, y: 20 }, panel.title);
    if (step === 0) {
      line(side, "axis", [-5, 0], [5, 0]);
      line(front, "axis", [-4, 0], [4, 0]);
      line(front, "axis", [0, -3.2], [0, 3.2]);
      eye(side, [-4, 0.8]);
    } else if (step < 4) {
      const slope = step === 1 ? 1 / cotangent : 1;
      const aspect = width / height;
      line(side, "edge", [9.5, 9.5 * slope], [0, 0], [9.5, -9.5 * slope]);
      for (const [name, z] of [["A", near], ["B", far]]) {
        line(side, "limit", [z, z * slope], [z, -z * slope]);
        const [x, y] = side.at([z, -z * slope]);
        draw(svg, "text", { x: x - 4, y: Math.min(y + 16, 292) }, name);
        const across = step === 1 ? z * slope * aspect : z * slope;
        box(front, -across, across, -z * slope, z * slope);
      }
      eye(side, [0, 0]);
    } else if (step < 6) {
      box(side, 0, 2, -1, 1);
      box(front, -1, 1, -1, 1);
    } else {
      box(side, 0, width, 0, height);
      box(front, 0, width, 0, height);
    }
    const before = step === 3 || step === 5 ? all[step - 1] : [];
    for (const panel of [side, front]) {
      const points = (list) => list.map((v) => panel.at(panel.of(v)).map((c) => c.toFixed(1)).join(",")).join(" ");
      // Panels cover each other's shapes no more than they have to.
      const viewBox = `${panel.left} 0 320 300`;
      const clip = draw(svg, "svg", { x: panel.left, y: 0, width: 320, height: 300, viewBox });
      if (before.length) draw(clip, "polygon", { class: "before", points: points(before) });
      if (vertices.length) draw(clip, "polygon", { class: "shape", points: points(vertices) });
      for (const v of vertices) {
        const [x, y] = panel.at(panel.of(v));
        draw(clip, "circle", { cx: x, cy: y, r: 5, fill: v.color, stroke: "#0008" });
      }
    }
    draw(svg, "line", { class: "axis", x1: 320, x2: 320, y1: 12, y2: 288 });

    const table = section.querySelector("table");
    table.caption.textContent = STEPS[step].note;
    const cell = (row, name, textContent) => {
      return row.appendChild(Object.assign(document.createElement(name), { textContent }));
    };
    table.tHead.replaceChildren();
    table.tBodies[0].replaceChildren();
    const head = table.tHead.insertRow();
    for (const name of ["vertex", ...STEPS[step].names]) cell(head, "th", name);
    vertices.forEach((v, k) => {
      const row = table.tBodies[0].insertRow();
      const first = cell(row, "td", "");
      const dot = Object.assign(document.createElement("span"), { className: "dot" });
      dot.style.background = v.color;
      first.append(dot, String(k + 1));
      for (const c of [v.x, v.y, v.z]) cell(row, "td", fixed(c, 3));
    });
    return {
      readout: [
        ["α = B/(B−A)", number(alpha, 4)],
        ["β = −AB/(B−A)", number(beta, 4)],
        ["cot ω", number(cotangent, 4)],
        ["Vertices at this step", vertices.length ? String(vertices.length) : "none is left"],
        ["Pixels drawn", number(fragments, 6)],
      ],
      outputs: { 1: fixed(p[1]), 2: fixed(p[2]), 3: fixed(p[3]), 5: fixed(p[5]), 6: fixed(p[6]) },
    };
  }

  function mipmaps(section, r, p) {
    const svg = overlay(section);
    const seen = r[3] > 0;
    if (p[6] >= 0) ring(svg, p[6] + 0.5, p[7] + 0.5, 7);
    const probes = 2 ** Math.min(p[1], Math.ceil(Math.log2(Math.max(r[1] / Math.max(r[2], 1e-9), 1)) - 1e-3));
    return {
      readout: [
        ["Level λ there", seen ? fixed(r[0]) : p[6] < 0 ? "point at the floor" : "no floor there"],
        ["Texels of a pixel", seen ? `${number(r[1])} × ${number(r[2])}` : "–"],
        ["Probes for that", seen ? (p[0] > 2.5 ? String(probes) : "1") : "–"],
        ["Distance", seen ? number(r[3]) : "–"],
      ],
      outputs: { 2: fixed(p[2], 1), 3: fixed(p[3]) },
      unused: p[0] > 2.5 ? [] : p[0] > 1.5 ? [1] : [1, 2],
    };
  }

  function relief(section, r, p) {
    return {
      readout: [
        ["Triangles", number(r[0], 7)],
        ["Shift in a joint", `${fixed(Math.hypot(r[1], r[2]), 1)} texels`],
        ["Height found", fixed(r[3], 3)],
        ["Slant of the ray, k", fixed(r[4])],
      ],
      outputs: { 1: fixed(p[1], 3), 4: fixed(p[4]), 5: fixed(p[5]), 6: fixed(p[6]) },
      unused: p[0] > 4.5 && p[0] < 6.5 ? [] : [3],
    };
  }

  function projector(section, r, p) {
    const place = (x, y) => (Number.isFinite(x + y) ? `(${fixed(x)}, ${fixed(y)})` : "behind the projector");
    return {
      readout: [
        ["Floor’s middle", place(r[0], r[1])],
        ["Mean of its ends", place(r[2], r[3])],
        ["q of the ends", `${fixed(r[4])} and ${fixed(r[5])}`],
      ],
      outputs: { 1: fixed(p[1]) },
    };
  }

  function frames(section, r, p) {
    const svg = overlay(section);
    const [ox, oy] = r;
    [["x", 2], ["y", 4], ["z", 6]].forEach(([name, k]) => {
      draw(svg, "line", { class: "mark dark", x1: ox, y1: oy, x2: r[k], y2: r[k + 1] });
      draw(svg, "line", { class: `arrow ${name}`, x1: ox, y1: oy, x2: r[k], y2: r[k + 1] });
      const label = draw(svg, "text", { x: r[k] + 6, y: r[k + 1] + 4 }, name);
      label.style.fill = "#fff";
    });
    const axis = (k) => `(${[0, 1, 2].map((i) => fixed(r[11 + 3 * k + i])).join(", ")})`;
    return {
      readout: [
        ["x", axis(0)],
        ["y", axis(1)],
        ["z", axis(2)],
        ["The frame is", r[8] > 0 ? "right-handed" : "left-handed"],
        ["x of the triangle off by", `${number(r[9], 2)}°`],
        ["z of the triangle off by", `${number(r[10], 2)}°`],
      ],
      outputs: { 2: fixed(p[2]), 3: fixed(p[3]) },
      unused: p[4] > 0.5 ? [] : [5],
    };
  }

  function model(section, r, p) {
    return {
      readout: [
        ["Vertices", number(r[0], 8)],
        ["Triangles", number(r[1], 8)],
        ["Fragments", number(r[2], 8)],
        ["Texture coordinates", r[3] > 0.5 ? "yes" : "none"],
      ],
      outputs: { 2: fixed(p[2]), 3: fixed(p[3], 1) },
    };
  }

  return { affine, depth, pipeline, mipmaps, relief, projector, frames, model };
})();
