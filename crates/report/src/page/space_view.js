// A bearing in space seen from beside its axis: rings, balls by their loads, the shaft; displacements and tilts enlarged.

const VIEW = { width: 560, height: 400, points: 48, reach: 0.14, at: [0.6, 0.35] };

// Lengths of the drawing, m; null where one is not known.
function viewLengths(run) {
  const of = (path) => lengthOf((inputOf(run, path) || {}).value);
  const [pitch, ball, bore, spacing] = ["bearing.pitch_diameter", "bearing.ball_diameter", "contact.bore_diameter", "bearing.row_spacing"].map(of);
  return [pitch, ball, bore].every(isNumber) ? { pitch: pitch / 2, ball: ball / 2, bore: bore / 2, spacing: isNumber(spacing) ? spacing : 1.6 * ball } : null;
}

// Displacement and tilt of a part at a row of the run, in the order of its columns; 0 where it has none.
function motionOf(run, part, at) {
  const value = (name) => {
    const column = columnOf(run, name);
    return column && isNumber(column[at]) ? column[at] : 0;
  };
  const along = part === "rotor" ? "rotor.z" : `${part}.z`;
  return { centre: [value(`${part}.x`), value(`${part}.y`), value(along)], tilt: [value(`${part}.tilt_x`), value(`${part}.tilt_y`)] };
}

// A point of a part that is displaced and tilted by so many times what it is: c + r + θ × r.
function placed({ centre: [x, y, z], tilt: [a, b] }, [rx, ry, rz], times) {
  return [rx + times * (x + b * rz), ry + times * (y - a * rz), rz + times * (z + a * ry - b * rx)];
}

// The enlargement at which the largest displacement of rotor and rings is a share of the pitch radius, in steps.
function enlargement(run, pitch) {
  const sizes = ["rotor.x", "rotor.y", "rotor.z", "bearing.inner_race.z"].map((name) => columnOf(run, name)).filter(Boolean);
  const most = sizes.reduce((largest, column) => column.reduce((own, value) => Math.max(own, Math.abs(value || 0)), largest), 0);
  if (!most) return 1;
  const wanted = (VIEW.reach * pitch) / most;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return Math.max(1, [5, 2, 1].find((step) => step * power <= wanted) * power);
}

function spaceView(run, runs) {
  const lengths = viewLengths(run);
  if (!lengths) return null;
  const { pitch, ball, bore, spacing } = lengths;
  const rows = rowsOf(run);
  const half = 0.5 * (rows.length - 1) * spacing + 1.2 * ball;
  const upright = Math.abs(Number.parseFloat((inputOf(run, "gravity.axial") || {}).value)) > 0;
  const times = enlargement(run, pitch);
  const scale = (0.36 * VIEW.height) / Math.max(pitch + ball, half);
  const angles = [...VIEW.at];
  const holder = element("div", {});
  let shown = 0;

  // Screen place and depth of a point; a shaft that stands has its end upwards.
  const seen = ([x, y, z]) => {
    const [along, up, beside] = upright ? [x, z, -y] : [z, y, -x];
    const [turn, tilt] = angles;
    const right = Math.cos(turn) * along + Math.sin(turn) * beside;
    const depth = Math.cos(turn) * beside - Math.sin(turn) * along;
    return [VIEW.width / 2 + scale * right, VIEW.height / 2 - scale * (Math.cos(tilt) * up - Math.sin(tilt) * depth), Math.sin(tilt) * up + Math.cos(tilt) * depth];
  };
  const circle = (part, radius, z) => Array.from({ length: VIEW.points + 1 }, (_, k) => {
    const azimuth = (2 * Math.PI * k) / VIEW.points;
    return seen(placed(part, [radius * Math.cos(azimuth), radius * Math.sin(azimuth), z], times));
  });
  const path = (points, stroke, more = {}) => drawing("polyline", { points: points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" "), fill: "none", stroke, "stroke-width": 1.3, ...more });
  const ring = (part, radius, stroke) => [-half, half].map((z) => path(circle(part, radius, z), stroke));
  const shaft = (part) => {
    const ends = [-1.6 * half, 1.6 * half].map((z) => circle(part, bore - 0.02 * pitch, z));
    const edges = [0, 6, 12, 18, 24, 30, 36, 42].map((k) => path([ends[0][k], ends[1][k]], SERIES_COLOURS.rotor, { "stroke-width": 0.8 }));
    return [...ends.map((end) => path(end, SERIES_COLOURS.rotor)), ...edges];
  };
  const draw = (at) => {
    shown = at;
    const [rotor, inner, outer] = ["rotor", "bearing.inner_race", "bearing.outer_race"].map((part) => motionOf(run, part, at));
    const between = { centre: inner.centre.map((value, k) => (value + outer.centre[k]) / 2), tilt: inner.tilt.map((value, k) => (value + outer.tilt[k]) / 2) };
    const loads = ballsOf(run).map((own) => (own.outer_load && own.outer_load[at]) || 0);
    const largest = Math.max(...loads, 0);
    const balls = rows.flatMap((row, k) => ballsOf(row).map((own) => {
      const azimuth = own.azimuth && own.azimuth[at];
      if (!isNumber(azimuth)) return null;
      const load = (own.outer_load && own.outer_load[at]) || 0;
      const [x, y, depth] = seen(placed(between, [pitch * Math.cos(azimuth), pitch * Math.sin(azimuth), (k - 0.5 * (rows.length - 1)) * spacing], times));
      return { x, y, depth, load, name: own.name };
    })).filter(Boolean);
    // the farthest first
    const spheres = balls.sort((a, b) => b.depth - a.depth).map(({ x, y, load, name }) => drawing("circle", { cx: x, cy: y, r: scale * ball, fill: load > 0 ? lineColour(load / largest) : "#ffffff", stroke: "#22303c" }, drawing("title", {}, `${name}: ${numberText(load, 4)} N`)));
    const svg = drawing("svg", { width: VIEW.width, height: VIEW.height, viewBox: `0 0 ${VIEW.width} ${VIEW.height}`, role: "img", style: "touch-action: none; cursor: grab" }, ring(outer, pitch + ball, SERIES_COLOURS.cage), spheres, ring(inner, pitch - ball, SERIES_COLOURS.race), shaft(rotor));
    holder.replaceChildren(svg);
  };
  holder.addEventListener("pointerdown", (down) => {
    const [turn, tilt] = angles;
    const move = (event) => {
      angles[0] = turn + (event.clientX - down.clientX) / 120;
      angles[1] = Math.max(-1.5, Math.min(1.5, tilt + (event.clientY - down.clientY) / 120));
      draw(shown);
    };
    const end = () => {
      window.removeEventListener("pointermove", move);
      window.removeEventListener("pointerup", end);
    };
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", end);
  });
  const peak = axialPeak(run) || (peakContact(run) || {}).peak_time_s || run.time[0];
  const key = [["shaft", SERIES_COLOURS.rotor], ["inner ring", SERIES_COLOURS.race], ["outer rings", SERIES_COLOURS.cage]].map(([words, colour]) => element("span", { class: "curve-key" }, curveSample({ colour, width: 3 }), words));
  const note = `Rings, balls and shaft; displacements and tilts ${numberText(times, 3)} times enlarged. Balls are the darker the more the outer race carries of them, white without load. Drag to turn the view.`;
  return figure(shareOfRun(run, runs, "The bearing in space"), note, timeSlider(run, peak, draw, true), holder, element("p", { class: "curve-keys" }, key));
}
