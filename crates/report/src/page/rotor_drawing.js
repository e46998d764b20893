// The rotor to scale, with a row below it for each kind of what it carries and what stands around it: symbol and names, so that
// the rows are the legend too. Of shapes, curves over the rotor instead.

const STEEL_FILL = "#d5dde4";
const OTHER_FILLS = ["#e6d9c6", "#d9e3cf", "#e4d3dd"];
const NODE_DOT = "#22303c";
const LANE_ROW = 15;
const LANE_TEXT = 10.5;
const LANE_WORDS = 132;

const rect = (x, y, width, height, fill) => drawing("rect", { x, y, width, height, fill });

const housingFrame = (x, y, width, height) => drawing("rect", { x, y, width, height, rx: 3, fill: "#f4f6f8", stroke: "#aeb9c4" });

// Symbols about a point of the surface, above it with side 1 and below it with -1.
const SYMBOLS = {
  bearing: (x, y, side) => rect(x - 5, side > 0 ? y - 14 : y + 4, 10, 10, "#1f5fa8"),
  magnet: (x, y, side) => rect(x - 7, side > 0 ? y - 15 : y + 3, 14, 12, "#c2571a"),
  sensor: (x, y) => drawing("path", { d: `M${x} ${y - 2}l-4 -9h8Z`, fill: "#22303c" }),
  support: (x, y) => drawing("path", { d: `M${x} ${y}l-7 12h14Z`, fill: "#2f8f5b" }),
  seal: (x, y) => drawing("path", { d: `M${x - 7} ${y + 2}h14M${x - 7} ${y + 6}h14`, stroke: "#8a4fae", "stroke-width": 2 }),
  mass: (x, y) => rect(x - 4, y - 10, 8, 8, "#55677a"),
  unbalance: (x, y) => drawing("circle", { cx: x, cy: y - 6, r: 4, fill: "#b3261e" }),
  disk: (x, y) => rect(x - 3, y - 10, 6, 12, "#8fa3b5"),
  sleeve: (x, y) => drawing("rect", { x: x - 6, y: y - 8, width: 12, height: 8, fill: STEEL_FILL, stroke: "#7b8894", "stroke-dasharray": "3 2" }),
  place: (x, y) => drawing("path", { d: `M${x - 3} ${y - 8}l6 6m0 -6l-6 6`, stroke: INK }),
  housing: (x, y) => housingFrame(x - 7, y - 11, 14, 12),
};
const BOTH_SIDES = ["bearing", "magnet"];
const BELOW = ["support", "seal"];
// The drawing itself shows these as bodies, and of a named place there is nothing to see.
const NOT_ON_SURFACE = ["disk", "sleeve", "place", "housing"];

const DRAWN = "Another colour for each other material; dashed: sleeves; light blue: disks, sized by their mass where the file gives no diameter; dots on the axis: nodes; pale frames: housings with what stands on them.";

// Housings: name, and from where to where parts stand on them.
function housingsOf(run) {
  const [names, places] = ["name", "place"].map(tableOf(run, "housed"));
  return [...new Set(names)].map((name) => {
    const own = places.filter((_, k) => names[k] === name);
    return { words: wordsOf(name), from: Math.min(...own), to: Math.max(...own) };
  });
}

// What a rotor carries and what stands around it: kind, words of its row, colour of its names, places [{at, words}].
function rotorLanes(run, bearings) {
  const placed = (places, names) => places.map((at, k) => ({ at, words: wordsOf(names[k] || "") }));
  const named = (figure) => placed(...["place", "name"].map(tableOf(run, figure)));
  const piece = tableOf(run, "pieces");
  const middles = piece("start").map((from, k) => (from + piece("end")[k]) / 2);
  const masses = tableOf(run, "masses");
  const lanes = [
    ["bearing", "auxiliary bearings", "#1f5fa8", placed(tableOf(run, "bearings")("place"), bearings)],
    ["magnet", "magnets", "#a8480f", named("magnets")],
    ["sensor", "their sensors", INK, named("sensors")],
    ["housing", "housings", "#55677a", housingsOf(run).map(({ words, from, to }) => ({ at: (from + to) / 2, words }))],
    ["support", "supports", "#23744a", named("supports")],
    ["seal", "seals", "#8a4fae", named("seals")],
    ["unbalance", "unbalances", "#b3261e", named("unbalances")],
    ["disk", "disks", "#55677a", named("disks")],
    ["sleeve", "sleeves", "#55677a", placed(middles, piece("name")).filter((_, k) => !piece("carries")[k])],
    ["mass", "point masses", "#55677a", masses("place").map((at, k) => ({ at, words: engineeringText(masses("mass")[k], "kg", 3) }))],
  ];
  // a name that the row of a part has at the same place says nothing more, nor has a bearing there
  const said = (own) => lanes.some(([kind, , , places]) => places.some(({ at, words }) => at === own.at && (words === own.words || kind === "bearing")));
  lanes.push(["place", "named places", PALE_INK, named("named_places").filter((own) => !said(own))]);
  return lanes.filter(([, , , places]) => places.length);
}

let ruler = null;

function textWidth(words, size) {
  ruler = ruler || document.createElement("canvas").getContext("2d");
  ruler.font = FONT.replace("12px", `${size}px`);
  return ruler.measureText(words).width;
}

// The rows of a lane: names that would meet stand on further ones, and those at the right end before their symbol.
function laneRows(places, toX, width) {
  const ends = [];
  return places.map(({ at, words }) => ({ x: toX(at), words })).sort((one, other) => one.x - other.x).map(({ x, words }) => {
    const space = textWidth(words, LANE_TEXT);
    const before = x + 10 + space > width;
    const [from, to] = before ? [x - 10 - space, x + 8] : [x - 8, x + 10 + space];
    const free = ends.findIndex((end) => end <= from);
    const row = free < 0 ? ends.length : free;
    ends[row] = to + 4;
    return { x, words, row, anchor: before ? "end" : "start", text: before ? x - 10 : x + 10 };
  });
}

// Lanes from a height on: what is drawn, how high it is, and the places that lines lead to.
function drawnLanes(lanes, toX, top, width) {
  let y = top;
  const leads = [];
  const drawn = lanes.map(([kind, words, colour, places]) => {
    const names = laneRows(places, toX, width);
    const first = y;
    y += LANE_ROW * (1 + Math.max(...names.map(({ row }) => row))) + 3;
    return [
      SYMBOLS[kind](10, first + (BOTH_SIDES.includes(kind) ? 15 : BELOW.includes(kind) ? 0 : 11), 1),
      drawing("text", { x: 24, y: first + 10, "font-size": 11.5, fill: INK }, words),
      names.map(({ x, words: name, row, anchor, text }) => {
        const base = first + LANE_ROW * row;
        // a housing is no place
        const dot = kind === "housing" ? null : drawing("circle", { cx: x, cy: base + 6, r: 2.5, fill: colour });
        if (dot) leads.push([x, base + 6]);
        return [dot, drawing("text", { class: "lane-name", x: text, y: base + 10, "text-anchor": anchor, "font-size": LANE_TEXT, fill: colour }, name)];
      }),
    ];
  });
  return { drawn, leads, height: y - top };
}

// The rotor; curves drawn over it [{values (a node each), colour, dash, label}], else what it carries and what stands around it.
function rotorDrawing(run, overlays, bearings, width) {
  const lanes = overlays.length ? [] : rotorLanes(run, bearings);
  const margin = { left: lanes.length ? LANE_WORDS : 58, right: 24, top: 30, bottom: 36 };
  const z = tableOf(run, "nodes")("place");
  const piece = tableOf(run, "pieces");
  const [starts, ends, outer, outerEnd, inner, innerEnd, carries, materials] = ["start", "end", "outer start", "outer end", "inner start", "inner end", "carries", "material"].map(piece);
  const [diskAt, masses, given, widths, diskNames] = ["place", "mass", "diameter", "width", "name"].map(tableOf(run, "disks"));
  const [first, last] = [z[0], z[z.length - 1]];
  const length = last - first || 1;
  const thickest = Math.max(...outer, ...outerEnd);
  const heaviest = Math.max(...masses, 0);
  // a disk of which only the mass is known is drawn by its mass, no larger than twice the shaft
  const diameters = diskAt.map((_, k) => given[k] || thickest * (1.15 + 0.85 * Math.cbrt(masses[k] / heaviest)));
  const highest = Math.max(thickest, ...diameters);
  const scale = (width - margin.left - margin.right) / length;
  // to scale unless the rotor is a needle or a plate
  const tall = Math.min(Math.max(highest * scale, 70), 420);
  const upright = tall / highest;
  const middle = margin.top + tall / 2;
  const below = margin.top + tall + 22;
  const toX = (at) => margin.left + (at - first) * scale;
  const toY = (radius) => middle - radius * upright;
  const kinds = [...new Set(materials)];
  const fill = (k) => (kinds.indexOf(materials[k]) <= 0 ? STEEL_FILL : OTHER_FILLS[(kinds.indexOf(materials[k]) - 1) % OTHER_FILLS.length]);
  const half = (k, side) => {
    const points = [[starts[k], outer[k]], [ends[k], outerEnd[k]], [ends[k], innerEnd[k]], [starts[k], inner[k]]];
    return drawing("polygon", { points: points.map(([at, d]) => `${toX(at).toFixed(1)},${toY((side * d) / 2).toFixed(1)}`).join(" "), fill: fill(k), stroke: "#7b8894", "stroke-width": 0.8, "stroke-dasharray": carries[k] ? null : "3 2" });
  };
  const bodies = starts.map((_, k) => [half(k, 1), half(k, -1)]);
  const disks = diskAt.map((at, k) => {
    const thick = Math.max((widths[k] || 0) * scale, 5);
    const tip = toY(diameters[k] / 2);
    return drawing("rect", { x: toX(at) - thick / 2, y: tip, width: thick, height: 2 * (middle - tip), fill: "#8fa3b5", "fill-opacity": 0.55, stroke: "#55677a", "stroke-width": 0.8 }, drawing("title", {}, `${diskNames[k] || ""}: ${engineeringText(masses[k], "kg", 4)}`));
  });
  const surface = (at) => {
    let most = 0;
    starts.forEach((from, k) => {
      if (at < from - 1e-9 || at > ends[k] + 1e-9) return;
      const share = (at - from) / (ends[k] - from);
      most = Math.max(most, outer[k] + (outerEnd[k] - outer[k]) * share);
    });
    return most / 2;
  };
  const { drawn, leads, height: laned } = drawnLanes(lanes, toX, below, width - 4);
  const around = lanes.filter(([kind]) => !NOT_ON_SURFACE.includes(kind)).map(([kind, , , places]) => places.map(({ at }) => {
    const [over, under] = [1, -1].map((side) => SYMBOLS[kind](toX(at), toY(side * surface(at)), side));
    return [BELOW.includes(kind) ? null : over, BELOW.includes(kind) || BOTH_SIDES.includes(kind) ? under : null];
  }));
  const height = below + laned + margin.bottom;
  const nodes = z.map((at) => drawing("circle", { cx: toX(at), cy: middle, r: z.length > 80 ? 1 : 1.7, fill: NODE_DOT }));
  const stretched = Math.abs(upright / scale - 1) > 0.05 ? `, diameters ${numberText(upright / scale, 2)} times as large` : "";
  const axis = [
    drawing("line", { x1: margin.left - 14, x2: width - margin.right + 10, y1: middle, y2: middle, stroke: "#8995a0", "stroke-dasharray": "10 3 2 3" }),
    axisSteps(first * 1e3, last * 1e3, Math.max(3, width / 110)).map((mm) => [drawing("line", { x1: toX(mm / 1e3), x2: toX(mm / 1e3), y1: height - 30, y2: height - 25, stroke: "#8995a0" }), drawing("text", { x: toX(mm / 1e3), y: height - 12, "text-anchor": "middle", "font-size": 11, fill: INK }, numberText(mm, 6))]),
    drawing("line", { x1: toX(first), x2: toX(last), y1: height - 30, y2: height - 30, stroke: "#8995a0" }),
    drawing("text", { x: 4, y: height - 12, "font-size": 11, fill: INK }, "z [mm]"),
    lanes.length ? drawing("text", { x: width - margin.right, y: 12, "text-anchor": "end", "font-size": 11, fill: PALE_INK }, `drawn to scale${stretched}`) : null,
  ];
  const lines = overlays.map(({ values, colour, dash }) => {
    const largest = Math.max(...values.map(Math.abs)) || 1;
    const path = values.map((value, k) => `${k ? "L" : "M"}${toX(z[k]).toFixed(1)} ${(middle - (value / largest) * (tall / 2) * 0.95).toFixed(1)}`);
    return drawing("path", { d: path.join(""), fill: "none", stroke: colour, "stroke-width": 2, "stroke-dasharray": dash || null });
  });
  const frames = lanes.length ? housingsOf(run).map(({ from, to }) => housingFrame(toX(from) - 16, margin.top - 8, (to - from) * scale + 32, tall + 16)) : [];
  const led = leads.map(([x, y]) => drawing("line", { x1: x, x2: x, y1: middle, y2: y, stroke: "#c9d0d7", "stroke-width": 0.8 }));
  return drawing("svg", { class: "rotor", width, height, viewBox: `0 0 ${width} ${height}`, role: "img" }, frames, led, axis, bodies, disks, around, nodes, lines, drawn);
}

function rotorPicture(run, overlays, bearings = []) {
  const holder = element("div", { class: "curves" });
  resizable.push(() => holder.replaceChildren(rotorDrawing(run, overlays, bearings, holder.clientWidth || 900)));
  const keys = overlays.filter(({ label }) => label).map((line) => element("span", { class: "curve-key" }, curveSample(line), line.label));
  return [holder, element("p", { class: "curve-keys" }, keys)];
}
