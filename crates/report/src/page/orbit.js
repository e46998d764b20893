// The orbit of the rotor centre, with equal axes.

const ORBIT_MARGIN = { left: 58, right: 14, top: 14, bottom: 42 };

function orbitPath(run, ground) {
  const part = (name) => columnOf(run, name);
  const [x, y] = [part("rotor.x"), part("rotor.y")];
  const [raceX, raceY] = [part("bearing.inner_race.x"), part("bearing.inner_race.y")];
  if (!x || !y) return null;
  if (ground) return { x, y };
  if (!raceX || !raceY) return null;
  const minus = (left, right) => left.map((value, row) => (isNumber(value) && isNumber(right[row]) ? value - right[row] : null));
  return { x: minus(x, raceX), y: minus(y, raceY) };
}

function orbitReach(run, ground) {
  const path = orbitPath(run, ground);
  const clearance = isNumber(run.summary.clearance_radius_m) ? run.summary.clearance_radius_m : 0;
  let reach = clearance;
  if (path) for (const values of [path.x, path.y]) for (const value of values) reach = Math.max(reach, Math.abs(value || 0));
  return reach > 0 ? 1.08 * reach : 1e-3;
}

function niceStep(span, count) {
  const rough = span / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= rough) || 10 * power;
}

function orbitFigure(run, runs) {
  const holder = element("div", { class: "orbit" });
  const canvas = element("canvas");
  const readout = element("p", { class: "readout" }, " ");
  const reach = { false: Math.max(...runs.map((each) => orbitReach(each, false))), true: Math.max(...runs.map((each) => orbitReach(each, true))) };
  let ground = false;
  let view = { x: 0, y: 0, half: reach[ground] };
  let size = 500;
  let box = null;

  const frame = () => {
    const width = size - ORBIT_MARGIN.left - ORBIT_MARGIN.right;
    const scale = width / (2 * view.half);
    return {
      width,
      scale,
      left: ORBIT_MARGIN.left,
      top: ORBIT_MARGIN.top,
      toX: (x) => ORBIT_MARGIN.left + width / 2 + (x - view.x) * scale,
      toY: (y) => ORBIT_MARGIN.top + width / 2 - (y - view.y) * scale,
      fromX: (px) => view.x + (px - ORBIT_MARGIN.left - width / 2) / scale,
      fromY: (py) => view.y - (py - ORBIT_MARGIN.top - width / 2) / scale,
    };
  };

  const draw = () => {
    const most = document.documentElement.classList.contains("paper") ? 310 : 600;
    size = Math.max(280, Math.min(most, holder.clientWidth || 500));
    const pen = sizedCanvas(size, size + 40, canvas);
    const place = frame();
    drawOrbitAxes(pen, place, view);
    pen.save();
    pen.beginPath();
    pen.rect(place.left, place.top, place.width, place.width);
    pen.clip();
    drawOrbitPath(pen, place, run, ground);
    if (box) {
      pen.fillStyle = "rgba(31,95,168,0.12)";
      pen.fillRect(box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0);
    }
    pen.restore();
    drawTimeBar(pen, place, size);
  };

  const position = (event) => {
    const area = canvas.getBoundingClientRect();
    return [event.clientX - area.left, event.clientY - area.top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    const [x, y] = position(event);
    box = { x0: x, y0: y, x1: x, y1: y };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const [x, y] = position(event);
    if (box) {
      Object.assign(box, { x1: x, y1: y });
      draw();
    } else readout.textContent = orbitReadout(run, ground, frame(), x, y);
  });
  canvas.addEventListener("pointerup", () => {
    const place = frame();
    const half = box ? Math.max(Math.abs(box.x1 - box.x0), Math.abs(box.y1 - box.y0)) / 2 / place.scale : 0;
    if (half * place.scale > 3) view = { x: place.fromX((box.x0 + box.x1) / 2), y: place.fromY((box.y0 + box.y1) / 2), half };
    box = null;
    draw();
  });
  canvas.addEventListener("pointerleave", () => (readout.textContent = " "));
  const reset = () => {
    view = { x: 0, y: 0, half: reach[ground] };
    draw();
  };
  canvas.addEventListener("dblclick", reset);
  const choose = (toGround) => () => {
    ground = toGround;
    reset();
  };
  const choice = (words, toGround) =>
    element("label", {}, element("input", { type: "radio", name: "frame" + run.letter, checked: !toGround, onchange: choose(toGround) }), " " + words);
  const controls = element(
    "div",
    { class: "controls" },
    choice("relative to the inner race", false),
    choice("in the ground frame", true),
    element("button", { type: "button", onclick: reset }, "whole orbit"),
  );
  resizable.push(draw);
  timeline.listeners.push(draw);
  const why = orbitPath(run, false) ? null : notInThisRun(whyNoColumn(run, ["rotor.x", "rotor.y", "bearing.inner_race.x", "bearing.inner_race.y"]));
  const remarks = why ? [] : orbitRemarks(run).map((words) => element("p", { class: "small" }, words));
  fillElement(holder, {}, why ? [why] : [controls, canvas, remarks, readout]);
  const note = "Geometric centre of the rotor at the bearing plane. Drag a box to zoom, double-click to reset; a time zoom below shows its part of the orbit in colour.";
  return figure(runs.length > 1 ? run.short : "Orbit of the rotor centre", why ? null : note, holder);
}

function drawOrbitAxes(pen, place, view) {
  const [unit, scale] = view.half < 2e-3 ? ["µm", 1e-6] : ["mm", 1e-3];
  const step = niceStep((2 * view.half) / scale, 8) * scale;
  pen.lineWidth = 1;
  pen.fillStyle = INK;
  pen.strokeStyle = RULE;
  const { left, top, width } = place;
  const ticks = (centre) => {
    const marks = [];
    for (let n = Math.ceil((centre - view.half) / step); n <= Math.floor((centre + view.half) / step); n++) marks.push(n * step);
    return marks;
  };
  const number = (value) => numberText(Number((value / scale).toPrecision(10)), 6);
  for (const x of ticks(view.x)) {
    strokeLine(pen, place.toX(x), top, place.toX(x), top + width);
    penWords(pen, number(x), place.toX(x), top + width + 5, "center", "top");
  }
  penWords(pen, `x, to the right [${unit}]`, left + width / 2, top + width + 22, "center", "top");
  for (const y of ticks(view.y)) {
    strokeLine(pen, left, place.toY(y), left + width, place.toY(y));
    penWords(pen, number(y), left - 6, place.toY(y), "right");
  }
  pen.save();
  pen.translate(12, top + width / 2);
  pen.rotate(-Math.PI / 2);
  penWords(pen, `y, up [${unit}]`, 0, 0, "center");
  pen.restore();
  pen.strokeStyle = PALE_INK;
  pen.strokeRect(left, top, width, width);
}

const GROUND_KEY = [["inner race centre", "#b98a5e"], ["outer race centre", "#4b5a66"], ["clearance circle at the end of the time shown", INK]];

function drawOrbitKey(pen, place) {
  GROUND_KEY.forEach(([words, colour], index) => {
    const [x, y] = [place.left + 10, place.top + 14 + 16 * index];
    pen.strokeStyle = colour;
    pen.lineWidth = 1.5;
    pen.setLineDash(index === 2 ? [5, 4] : []);
    strokeLine(pen, x, y, x + 20, y);
    pen.fillStyle = INK;
    penWords(pen, words, x + 26, y);
  });
  pen.setLineDash([]);
}

function drawCircle(pen, place, x, y, radius, dash) {
  pen.beginPath();
  pen.setLineDash(dash);
  pen.arc(place.toX(x), place.toY(y), radius * place.scale, 0, 2 * Math.PI);
  pen.strokeStyle = INK;
  pen.lineWidth = 1.25;
  pen.stroke();
  pen.setLineDash([]);
}

function drawTrace(pen, place, x, y, colour) {
  pen.beginPath();
  let down = false;
  x.forEach((value, row) => {
    if (!isNumber(value) || !isNumber(y[row])) down = false;
    else if (down) pen.lineTo(place.toX(value), place.toY(y[row]));
    else {
      pen.moveTo(place.toX(value), place.toY(y[row]));
      down = true;
    }
  });
  pen.strokeStyle = colour;
  pen.lineWidth = 0.75;
  pen.stroke();
}

function drawOrbitPath(pen, place, run, ground) {
  const path = orbitPath(run, ground);
  if (!path) return;
  const clearance = run.summary.clearance_radius_m;
  const zoomed = timeline.begin > timeline.first || timeline.end < timeline.last;
  if (zoomed) drawTrace(pen, place, path.x, path.y, "#e3e7ea");
  if (ground) {
    const others = ["bearing.inner_race", "bearing.outer_race"].map((name) => [columnOf(run, name + ".x"), columnOf(run, name + ".y")]);
    others.forEach(([x, y], index) => x && y && drawTrace(pen, place, x, y, GROUND_KEY[index][1]));
    const [x, y] = others[0];
    const row = rowBefore(run.time, timeline.end);
    if (isNumber(clearance) && x && y) drawCircle(pen, place, x[row] || 0, y[row] || 0, clearance, [5, 4]);
    drawOrbitKey(pen, place);
  } else if (isNumber(clearance)) drawCircle(pen, place, 0, 0, clearance, []);
  pen.lineWidth = 1.1;
  pen.lineCap = "round";
  const span = timeline.end - timeline.begin;
  for (let row = 0; row + 1 < run.time.length; row++) {
    if (run.time[row + 1] < timeline.begin || run.time[row] > timeline.end) continue;
    const corners = [path.x[row], path.y[row], path.x[row + 1], path.y[row + 1]];
    if (!corners.every(isNumber)) continue;
    pen.strokeStyle = lineColour((run.time[row] - timeline.begin) / span);
    strokeLine(pen, place.toX(corners[0]), place.toY(corners[1]), place.toX(corners[2]), place.toY(corners[3]));
  }
  const marks = orbitMarks(run).filter((mark) => mark.sure);
  for (const { instant, fill } of marks) {
    const [x, y] = [valueAt(run.time, path.x, instant), valueAt(run.time, path.y, instant)];
    if (isNumber(x) && isNumber(y)) drawDot(pen, place.toX(x), place.toY(y), fill);
  }
  drawMarkKey(pen, place, marks);
}

// The instants worth a mark, and whether the rows around them are close enough to place it.
function orbitMarks(run) {
  const first = run.contacts[0];
  const peak = peakContact(run);
  const marks = [];
  if (first) marks.push({ words: "first contact", instant: first.start_s, fill: "#ffffff" });
  if (peak) marks.push({ words: "peak force", instant: peak.peak_time_s, fill: SERIES_COLOURS.limit });
  return marks.map((mark) => ({ ...mark, sure: rowsAround(run.time, mark.instant) }));
}

function orbitRemarks(run) {
  const unsure = orbitMarks(run).filter((mark) => !mark.sure);
  const places = unsure.map(({ words, instant }) => `${words} at ${timeline.text(instant)}`).join(", ");
  return [coarseRowsNote(run), unsure.length ? `rows too coarse for marks: ${places}.` : null].filter(Boolean);
}

function drawDot(pen, x, y, fill) {
  pen.strokeStyle = INK;
  pen.fillStyle = fill;
  pen.lineWidth = 1.25;
  pen.beginPath();
  pen.arc(x, y, 4.5, 0, 2 * Math.PI);
  pen.fill();
  pen.stroke();
}

// The words stand in the lower corners, which an orbit inside its clearance circle leaves free; in small pictures, where it lies low,
// in the upper ones.
function drawMarkKey(pen, place, marks) {
  marks.forEach(({ words, fill }, index) => {
    const [side, edge] = index ? [-1, place.left + place.width] : [1, place.left];
    const [x, y] = [edge + 13 * side, place.width < 350 ? place.top + 13 : place.top + place.width - 13];
    drawDot(pen, x, y, fill);
    pen.fillStyle = INK;
    penWords(pen, words, x + 10 * side, y, index ? "right" : "left");
  });
}

function drawTimeBar(pen, place, size) {
  const top = size + 4;
  paintRamp(pen, place.left, top, place.width, 9, lineColour, false);
  pen.fillStyle = INK;
  penWords(pen, timeline.text(timeline.begin), place.left, top + 14, "left", "top");
  penWords(pen, timeline.words, place.left + place.width / 2, top + 14, "center", "top");
  penWords(pen, timeline.text(timeline.end), place.left + place.width, top + 14, "right", "top");
}

function orbitReadout(run, ground, place, px, py) {
  const path = orbitPath(run, ground);
  let best = null;
  let nearest = 20 * 20;
  run.time.forEach((instant, row) => {
    if (instant < timeline.begin || instant > timeline.end || !isNumber(path.x[row]) || !isNumber(path.y[row])) return;
    const distance = (place.toX(path.x[row]) - px) ** 2 + (place.toY(path.y[row]) - py) ** 2;
    if (distance < nearest) [nearest, best] = [distance, row];
  });
  if (best === null) return " ";
  const [x, y] = [path.x[best], path.y[best]];
  const clearance = run.summary.clearance_radius_m;
  const radius = Math.hypot(x, y);
  const share = !ground && isNumber(clearance) && clearance > 0 ? ` = ${percentText(radius / clearance)} of the clearance` : "";
  return `${timeline.text(run.time[best])}: x ${engineeringText(x, "m", 4)}, y ${engineeringText(y, "m", 4)}, distance ${engineeringText(radius, "m", 4)}${share}`;
}

// As many as stand beside the orbit on paper.
const CONTACTS_PRINTED = 24;

function contactTable(run) {
  if (!run.contacts.length) return notInThisRun("a list of contacts; none happened, or the summary does not hold them", run);
  const lasting = (contact) => (isNumber(contact.end_s) ? contact.end_s - contact.start_s : null);
  const parts = [
    ["start", (contact) => contact.start_s, "s", 6],
    ["lasts", lasting, "s", 5, "still closed"],
    ["peak force", (contact) => contact.peak_force_N, "N", 5],
    ["peak at", (contact) => contact.peak_time_s, "s", 6],
  ].map(([words, value, unit, digits, absent]) => ({ words, value, absent: absent || "–", scale: columnScale(run.contacts.map(value), unit, digits) }));
  const cell = (part, contact) => (isNumber(part.value(contact)) ? part.scale.text(part.value(contact)) : part.absent);
  const row = (contact, index) =>
    element("tr", { class: index >= CONTACTS_PRINTED ? "screen-only" : null }, element("td", {}, index + 1), parts.map((part) => element("td", {}, cell(part, contact))));
  const heads = ["", ...parts.map((part) => `${part.words} [${part.scale.name}]`)];
  const more = run.contacts.length - CONTACTS_PRINTED;
  return figure(
    run.prefix + "Contacts",
    run.contacts.length + (run.contacts.length === 1 ? " contact" : " contacts") + ` of rotor and inner race, in order of ${timeline.words}.`,
    element("div", { class: "scroll" }, tableOfRows("numbers contacts", heads, run.contacts.map(row))),
    more > 0 ? element("p", { class: "print-only" }, `and ${more} more, in summary.json`) : null,
  );
}

function orbitSection(runs) {
  const single = runs.length === 1;
  const figures = runs.map((run) => orbitFigure(run, runs));
  return section("orbit", "Orbit", element("div", { class: "columns" }, figures, single ? contactTable(runs[0]) : null));
}

const dropPage = {
  line: machineLine,
  shared: machineTiles,
  verdict,
  time: "time after release",
  touches: true,
  facts: true,
  sections: (runs) => [[9.5, firstContactsSection, runs], [10, orbitSection, runs], [10.5, orderSection, runs], [11, contactSection, runs], [50, speedSection, runs], [60, mapSection, runs], [61, pressureSection, runs], [80, energySection, runs], ...LIMIT_SECTIONS(runs), ...WARM_SECTIONS(runs)].filter(([, , some]) => some.length),
};

register("drop", { ...dropPage });
