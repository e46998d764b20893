// Ball loads and slip as maps: time to the right, azimuth of the balls in the ground frame upwards, value as colour.

// The turn is cut at the top, so that the zone under the weight lies in the middle.
const MAP_BINS = 144;
const MAP_LOWEST_AZIMUTH = Math.PI / 2;
const MAP_TICKS = [[0, "up 90°"], [0.25, "left 180°"], [0.5, "down 270°"], [0.75, "right 0°"], [1, "up 90°"]];

const MAPS = [
  { part: "inner_load", title: "Load between ball and inner race", label: "load", unit: "N", load: "inner_load", slip: "inner_slip" },
  { part: "outer_load", title: "Load between ball and outer race", label: "load", unit: "N", load: "outer_load", slip: "outer_slip" },
  { part: "inner_angle", title: "Contact angle at the inner race, size", label: "angle", unit: "°", shade: "linear", race: 0 },
  { part: "outer_angle", title: "Contact angle at the outer race, size", label: "angle", unit: "°", shade: "linear", race: 1 },
  { part: "inner_slip", title: "Slip speed between ball and inner race, size", label: "slip", unit: "m/s" },
  { part: "outer_slip", title: "Slip speed between ball and outer race, size", label: "slip", unit: "m/s" },
];

const SHADES = {
  "square root": (share) => Math.sqrt(share),
  linear: (share) => share,
  "logarithmic, 4 decades": (share) => (share > 0 ? Math.max(0, 1 + Math.log10(share) / 4) : 0),
};

const mapState = { shade: "square root", skid: true, redraws: [] };

// A ball that carries at least a hundredth of the largest load counts as skidding where its slip exceeds twice the
// reference speed of the traction law: with the tanh law the friction there has reached 96 % of its limit.
const SKID_LOAD_SHARE = 0.01;

function skidLimit(runs) {
  for (const run of runs) {
    const input = inputOf(run, "bearing.traction.reference_speed");
    const match = input && /^\s*([0-9.eE+-]+)\s*m\/s\s*$/.exec(String(input.value));
    if (match && Number(match[1]) > 0) return { speed: 2 * Number(match[1]), source: "twice the reference speed of the traction law" };
  }
  return { speed: 0.2, source: "this report's own mark: the inputs name no reference speed of the traction law" };
}

function turnShare(azimuth) {
  const turns = (azimuth - MAP_LOWEST_AZIMUTH) / (2 * Math.PI);
  return turns - Math.floor(turns);
}

function between(values, row, share, periodic) {
  const [left, right] = [values[row], values[row + 1]];
  if (!isNumber(left) || !isNumber(right)) return left;
  let step = right - left;
  if (periodic) step -= 2 * Math.PI * Math.round(step / (2 * Math.PI));
  return left + share * step;
}

// Calls visit(column, ball index, azimuth, row, share) for every sample that falls into each picture column, or for
// one interpolated sample where the zoom is finer than the rows.
function visitSamples(run, balls, columns, visit) {
  const { time } = run;
  const width = (timeline.end - timeline.begin) / columns;
  let row = rowBefore(time, timeline.begin);
  for (let column = 0; column < columns; column++) {
    const begin = timeline.begin + column * width;
    const end = begin + width;
    if (end < time[0] || begin > time[time.length - 1]) continue;
    while (row + 1 < time.length && time[row] < begin) row += 1;
    const samples = [];
    for (let next = row; next < time.length && time[next] < end; next++) samples.push([next, 0]);
    if (!samples.length) {
      const middle = Math.min(time[time.length - 1], Math.max(time[0], begin + width / 2));
      const before = rowBefore(time, middle);
      const gap = time[before + 1] - time[before];
      samples.push([before, gap > 0 ? (middle - time[before]) / gap : 0]);
    }
    for (const [at, share] of samples) {
      balls.forEach((ball, index) => {
        const azimuth = ball.azimuth ? between(ball.azimuth, at, share, true) : null;
        visit(column, index, azimuth, at, share);
      });
    }
  }
}

function mapGrid(run, map, columns, skid) {
  const balls = ballsOf(run);
  const byAzimuth = balls.every((ball) => ball.azimuth);
  const bins = byAzimuth ? MAP_BINS : balls.length;
  const half = byAzimuth ? Math.ceil(MAP_BINS / balls.length / 2) : 0;
  const values = new Float32Array(columns * bins).fill(-1);
  const marked = new Uint8Array(columns * bins);
  visitSamples(run, balls, columns, (column, index, azimuth, row, share) => {
    const ball = balls[index];
    if (!ball[map.part] || (byAzimuth && !isNumber(azimuth))) return;
    const value = between(ball[map.part], row, share, false);
    if (!isNumber(value)) return;
    const slips = map.slip && ball[map.slip] && ball[map.load][row] > skid.load && Math.abs(ball[map.slip][row]) > skid.speed;
    const centre = byAzimuth ? Math.floor(turnShare(azimuth) * bins) : index;
    for (let step = -half; step <= half; step++) {
      const bin = column * bins + ((centre + step + bins) % bins);
      values[bin] = Math.max(values[bin], Math.abs(value));
      if (slips) marked[bin] = 1;
    }
  });
  return { balls, byAzimuth, bins, values, marked };
}

function paintGrid(grid, columns, scale, showSkid) {
  const sheet = element("canvas", { width: columns, height: grid.bins });
  const pen = sheet.getContext("2d");
  const image = pen.createImageData(columns, grid.bins);
  for (let column = 0; column < columns; column++) {
    for (let bin = 0; bin < grid.bins; bin++) {
      const value = grid.values[column * grid.bins + bin];
      if (value < 0) continue;
      const colour = mapColour(scale.share(value));
      const marked = showSkid && grid.marked[column * grid.bins + bin];
      const at = 4 * ((grid.bins - 1 - bin) * columns + column);
      for (let part = 0; part < 3; part++) image.data[at + part] = marked ? 0.4 * colour[part] + 0.6 * SKID[part] : colour[part];
      image.data[at + 3] = 255;
    }
  }
  pen.putImageData(image, 0, 0);
  return sheet;
}

// Loads that hardly change over time and balls need no map.
const EVEN = 0.02;

// Smallest and largest size over all balls and times, and whether they agree but for a few percent.
function rangeOf(run, part) {
  let [low, high] = [Infinity, 0];
  for (const ball of ballsOf(run)) {
    for (const value of ball[part] || []) {
      if (!isNumber(value)) continue;
      low = Math.min(low, Math.abs(value));
      high = Math.max(high, Math.abs(value));
    }
  }
  return { low, high, even: high > 0 && high - low <= EVEN * high };
}

// What stands for a map of even values: one line.
function evenLine(run, map, { low, high }) {
  const [unit, scale] = readableUnit(high, map.unit);
  const range = high - low > 1e-3 * high ? `between ${numberText(low / scale, 4)} and ${numberText(high / scale, 4)} ${unit}` : `${numberText(high / scale, 4)} ${unit}`;
  return element("p", {}, `${run.prefix}Even: every ball carries ${range} all the time.`);
}

function largestOf(runs, part) {
  let most = 0;
  for (const run of runs) for (const ball of ballsOf(run)) for (const value of ball[part] || []) most = Math.max(most, Math.abs(value || 0));
  return most;
}

// From which value to which the colours of a map go: from 0, or of angles from the smallest; up to the end of the groove where it is known.
function scaleOf(runs, map, end) {
  const shading = () => map.shade || mapState.shade;
  const values = map.race === undefined ? [] : runs.flatMap(ballsOf).flatMap((ball) => ball[map.part] || []).filter(isNumber).map(Math.abs);
  const low = values.length ? Math.floor(values.reduce((least, value) => Math.min(least, value))) : 0;
  const largest = Math.max(largestOf(runs, map.part), end || 0);
  return { low, largest, end, logarithmic: () => shading().startsWith("log"), share: (value) => SHADES[shading()](largest > low ? Math.max(0, value - low) / (largest - low) : 0) };
}

function colourBar(pen, left, top, height, { low, largest, end, logarithmic, share }, map) {
  paintRamp(pen, left, top, 11, height, (part) => `rgb(${mapColour(part).join(",")})`, true);
  pen.fillStyle = INK;
  const candidates = [largest];
  const span = largest - low;
  if (low > 0) candidates.push(...axisSteps(low, largest, 6));
  else for (let power = Math.floor(Math.log10(span || 1)); power >= Math.log10(span || 1) - 5; power--) for (const digit of [5, 2, 1]) candidates.push(digit * 10 ** power);
  const taken = [top + height];
  if (logarithmic()) taken.pop();
  else penWords(pen, numberText(low, 3), left + 15, top + height);
  for (const value of candidates.filter((each) => each <= largest)) {
    const y = top + height * (1 - share(value));
    if (y > top + height || taken.some((other) => Math.abs(other - y) < 14)) continue;
    taken.push(y);
    penWords(pen, numberText(Number(value.toPrecision(3)), 3), left + 15, y);
  }
  penWords(pen, `${map.label} [${map.unit}]`, left - 4, top - 12, "left", "alphabetic");
  if (!isNumber(end)) return;
  pen.strokeStyle = SERIES_COLOURS.limit;
  pen.lineWidth = 2.5;
  strokeLine(pen, left - 4, top + height * (1 - share(end)), left + 15, top + height * (1 - share(end)));
}

function mapCanvas(run, runs, map, limit) {
  const holder = element("div", { class: "map" });
  const canvas = element("canvas");
  const readout = element("p", { class: "readout" }, " ");
  const ends = map.race === undefined ? null : grooveEnds(run);
  const scale = scaleOf(runs, map, ends && ends[map.race]);
  const place = { left: AXIS_WIDTH, top: 26, height: 176, width: 0 };
  let grid = null;
  const draw = () => {
    const width = holder.clientWidth || 600;
    place.height = document.documentElement.classList.contains("paper") ? 100 : 176;
    place.width = Math.max(50, width - 2 * AXIS_WIDTH);
    const pen = sizedCanvas(width, place.top + place.height + 38, canvas);
    const columns = Math.round(place.width);
    grid = mapGrid(run, map, columns, { speed: limit.speed, load: SKID_LOAD_SHARE * scale.largest });
    pen.imageSmoothingEnabled = false;
    pen.drawImage(paintGrid(grid, columns, scale, mapState.skid), place.left, place.top, place.width, place.height);
    drawMapAxes(pen, place, grid);
    colourBar(pen, place.left + place.width + 20, place.top, place.height, scale, map);
  };
  canvas.addEventListener("pointermove", (event) => {
    const area = canvas.getBoundingClientRect();
    timeline.point(timeline.begin + ((event.clientX - area.left - place.left) / place.width) * (timeline.end - timeline.begin));
    readout.textContent = mapReadout(run, grid, place, event.clientX - area.left, event.clientY - area.top);
  });
  canvas.addEventListener("pointerleave", () => (readout.textContent = " "));
  canvas.addEventListener("dblclick", () => timeline.all());
  resizable.push(draw);
  timeline.listeners.push(draw);
  mapState.redraws.push(draw);
  return fillElement(holder, {}, [canvas, readout]);
}

function drawMapAxes(pen, place, grid) {
  const { left, top, width, height } = place;
  pen.strokeStyle = PALE_INK;
  pen.lineWidth = 0.75;
  pen.strokeRect(left, top, width, height);
  pen.fillStyle = INK;
  const step = Math.max(1, Math.ceil((14 * grid.bins) / height));
  const ticks = grid.byAzimuth ? MAP_TICKS : grid.balls.flatMap((ball, index) => (index % step ? [] : [[(index + 0.5) / grid.bins, ball.name]]));
  for (const [share, words] of ticks) {
    const y = top + height * (1 - share);
    penWords(pen, words, left - 7, y, "right");
    strokeLine(pen, left - 4, y, left, y);
  }
  const spacing = niceStep((timeline.end - timeline.begin) / timeline.unit[1], Math.max(2, width / 90)) * timeline.unit[1];
  for (let n = Math.ceil(timeline.begin / spacing - 1e-9); n * spacing <= timeline.end * (1 + 1e-9); n++) {
    const x = left + (width * (n * spacing - timeline.begin)) / (timeline.end - timeline.begin);
    penWords(pen, numberText(Number(((n * spacing) / timeline.unit[1]).toPrecision(10)), 6), x, top + height + 6, "center", "top");
    strokeLine(pen, x, top + height, x, top + height + 4);
  }
  penWords(pen, `${timeline.words} [${timeline.unit[0]}]`, left + width / 2, top + height + 22, "center", "top");
}

function mapReadout(run, grid, place, px, py) {
  const [across, upwards] = [(px - place.left) / place.width, 1 - (py - place.top) / place.height];
  if (!grid || across < 0 || across > 1 || upwards < 0 || upwards > 1) return " ";
  const instant = timeline.begin + across * (timeline.end - timeline.begin);
  if (instant < run.time[0] || instant > run.time[run.time.length - 1]) return " ";
  const row = rowBefore(run.time, instant);
  let ball = grid.balls[Math.min(grid.balls.length - 1, Math.floor(upwards * grid.balls.length))];
  if (grid.byAzimuth) {
    const distance = (each) => Math.abs(turnShare(each.azimuth[row] + Math.PI + MAP_LOWEST_AZIMUTH - (MAP_LOWEST_AZIMUTH + 2 * Math.PI * upwards)) - 0.5);
    ball = grid.balls.reduce((best, each) => (distance(each) < distance(best) ? each : best));
  }
  const parts = [timeline.text(run.time[row]), ball.name];
  if (ball.azimuth) parts.push("azimuth " + numberText((((ball.azimuth[row] * 180) / Math.PI) % 360 + 360) % 360, 4) + "°");
  const named = { inner_load: ["inner load", "N"], outer_load: ["outer load", "N"], inner_slip: ["inner slip", "m/s"], outer_slip: ["outer slip", "m/s"], inner_angle: ["inner angle", "deg"], outer_angle: ["outer angle", "deg"] };
  for (const [part, [words, unit]] of Object.entries(named)) if (ball[part]) parts.push(words + " " + numberText(ball[part][row], 4) + " " + unit);
  return parts.join(", ");
}

function mapControls() {
  const redraw = () => mapState.redraws.forEach((draw) => draw());
  const choice = (name) => element("option", { value: name, selected: name === mapState.shade }, name);
  const onShade = (event) => {
    mapState.shade = event.target.value;
    redraw();
  };
  const onSkid = (event) => {
    mapState.skid = event.target.checked;
    redraw();
  };
  return element(
    "div",
    { class: "controls" },
    element("label", {}, "colour scale ", element("select", { onchange: onShade }, Object.keys(SHADES).map(choice))),
    element("label", {}, element("input", { type: "checkbox", checked: true, onchange: onSkid }), " mark skidding balls"),
  );
}

function mapSection(bearings) {
  const runs = bearings.flatMap(rowsOf);
  const limit = skidLimit(runs);
  const has = (run, map) => run.time && ballsOf(run).some((ball) => ball[map.part]);
  const maps = MAPS.filter((map) => runs.some((run) => has(run, map)));
  const figures = maps.map((map) => {
    const drawn = runs.filter((run) => has(run, map));
    // only bearings in space have contact angles
    const missing = runs.filter((run) => !drawn.includes(run) && map.race === undefined);
    const notes = [];
    if (drawn.some((run) => !ballsOf(run).every((ball) => ball.azimuth))) notes.push("This fidelity gives no ball positions: one row a ball.");
    if (map.slip && drawn.some((run) => ballsOf(run).some((ball) => ball[map.slip])))
      notes.push(`Red: balls with more than ${percentText(SKID_LOAD_SHARE)} of the largest load that slip faster than ${engineeringText(limit.speed, "m/s", 3)} (${limit.source}).`);
    if (map.race !== undefined) notes.push(grooveNote(drawn, map.race));
    const even = new Map(drawn.map((run) => [run, rangeOf(run, map.part)]).filter(([, range]) => range.even && map.load));
    if (drawn.length === even.size) return figure(map.title, null, drawn.map((run) => evenLine(run, map, even.get(run))), missing.map((run) => notInThisRun(`its history has no ${map.part.replace("_", " ")} of the balls`, run)));
    const canvases = drawn.map((run) => [runs.length > 1 ? element("p", { class: "run-label" }, element("span", { class: "swatch", style: "background:" + run.colour }), run.short) : null, mapCanvas(run, drawn, map, limit)]);
    const why = missing.map((run) =>
      notInThisRun(run.time ? `its history has no ${map.part.replace("_", " ")} of the balls (the rolling fidelity gives loads only)` : "it has no time history", run),
    );
    return figure(map.title, notes.join(" "), canvases, why);
  });
  const absent = MAPS.filter((map) => !maps.includes(map)).filter((map) => map.race === undefined).map((map) => map.title.replace(", size", "").toLowerCase());
  const left = runs.every((run) => !run.withBalls);
  const lack = left ? element("p", { class: "lead" }, "Maps of the single balls are on the pages of the single runs: so many runs together would not fit into one page.") : absent.length ? element("p", { class: "small" }, `Not in ${runs.length > 1 ? "these runs" : "this run"}: ${absent.join(", ")}${ballsOf(runs[0]).length ? " (the rolling fidelity takes the balls to roll)" : ""}.`) : null;
  const drawn = runs.filter((run) => run.time && ballsOf(run).length && maps.some((map) => has(run, map) && !(map.load && rangeOf(run, map.part).even)));
  const note = element(
    "p",
    { class: "lead" },
    "Azimuth is that of the ball seen from the ground, counter-clockwise from the right; where a column of the picture holds several instants, the largest value is shown.",
  );
  return section("balls", "Ball loads and slip", [drawn.some((run) => ballsOf(run).some((ball) => ball.azimuth)) ? note : null, drawn.length ? mapControls() : null], figures, lack, separationFigures(bearings));
}
