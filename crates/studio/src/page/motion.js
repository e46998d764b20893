// The motion of a finished run: one time cursor over orbits, balls, forces, speeds, energies and the shape of the shaft.

const LINE_COLOURS = ["#1f5fa8", "#c2571a", "#2f8f5b", "#8a4fae", "#8a7410", "#b0306a", "#5d6b78"];
const PLOT = { width: 640, height: 150, left: 78, right: 10, top: 8, bottom: 20 };

// Curves over time with a line at the cursor; a click or drag in it moves the cursor.
function timePlot({ title, unit, lines }, time, choose) {
  const own = lines.filter(({ values }) => values && values.some((value) => value !== 0));
  if (!own.length) return null;
  const all = own.flatMap(({ values }) => [Math.min(...values), Math.max(...values)]);
  const [least, high] = [Math.min(0, ...all), Math.max(0, ...all)];
  // what rounding leaves of zero is zero
  const low = -least < 1e-6 * high ? 0 : least;
  const [first, last] = [time[0], time[time.length - 1]];
  const x = (instant) => PLOT.left + ((instant - first) / (last - first || 1)) * (PLOT.width - PLOT.left - PLOT.right);
  const y = (value) => PLOT.top + (1 - (value - low) / (high - low || 1)) * (PLOT.height - PLOT.top - PLOT.bottom);
  const text = (left, top, line, anchor) => svg("text", { x: left, y: top, "text-anchor": anchor, "font-size": 11, fill: "#22303c" }, line);
  const path = ({ values }, k) => svg("path", { d: values.map((value, row) => `${row ? "L" : "M"}${x(time[row]).toFixed(1)} ${y(value).toFixed(1)}`).join(""), fill: "none", stroke: LINE_COLOURS[k % LINE_COLOURS.length], "stroke-width": 1.3, "stroke-dasharray": k % 2 ? "5 3" : null });
  const cursor = svg("line", { y1: PLOT.top, y2: PLOT.height - PLOT.bottom, stroke: "#b3261e", "stroke-width": 1.2 });
  const frame = [low, high].map((value) => [svg("line", { x1: PLOT.left, x2: PLOT.width - PLOT.right, y1: y(value), y2: y(value), stroke: "#dfe4e8" }), text(PLOT.left - 5, y(value) + 4, FIGURES.text(value, unit), "end")]);
  const picture = svg("svg", { viewBox: `0 0 ${PLOT.width} ${PLOT.height}`, role: "img", "aria-label": title }, frame, own.map(path), cursor, text(PLOT.left, PLOT.height - 4, FIGURES.text(first, "s"), "start"), text(PLOT.width - PLOT.right, PLOT.height - 4, FIGURES.text(last, "s"), "end"));
  const pick = (event) => {
    const box = picture.getBoundingClientRect();
    const share = (((event.clientX - box.left) / box.width) * PLOT.width - PLOT.left) / (PLOT.width - PLOT.left - PLOT.right);
    choose(Math.round(Math.min(1, Math.max(0, share)) * (time.length - 1)));
  };
  picture.addEventListener("pointerdown", pick);
  picture.addEventListener("pointermove", (event) => event.buttons && pick(event));
  const readings = own.map(({ name }, k) => [name, el("b", {}), LINE_COLOURS[k % LINE_COLOURS.length]]);
  const legend = el("p", { class: "readings" }, readings.map(([name, value, colour]) => el("span", {}, swatch(colour), `${words(name).replaceAll(".", " ")} `, value)));
  const open = state.layout[`motion:${title}`] !== false;
  return {
    node: el("details", { class: "pane", open, ontoggle: (event) => keepLayout({ [`motion:${title}`]: event.target.open }) }, el("summary", {}, title), el("div", { class: "paper plot" }, picture), legend),
    show(row) {
      cursor.setAttribute("x1", x(time[row]));
      cursor.setAttribute("x2", x(time[row]));
      readings.forEach(([, value], k) => (value.textContent = FIGURES.text(own[k].values[row], unit)));
    },
  };
}

function swatch(colour) {
  return svg("svg", { width: 12, height: 12, viewBox: "0 0 12 12", class: "swatch" }, svg("rect", { width: 12, height: 12, rx: 2, fill: colour }));
}

// The axis of the shaft at an instant, to the right and upwards, in the scale of its largest displacement.
function shapePlot({ place, x, y }) {
  if (!Array.isArray(place) || !x.length) return null;
  const most = [...x, ...y].reduce((largest, values) => values.reduce((inner, value) => Math.max(inner, Math.abs(value)), largest), 1e-12);
  const [first, last] = [place[0], place[place.length - 1]];
  const toX = (z) => 20 + ((z - first) / (last - first || 1)) * 600;
  const line = (colour) => svg("path", { fill: "none", stroke: colour, "stroke-width": 2 });
  const [across, upright] = [line(LINE_COLOURS[1]), line(LINE_COLOURS[0])];
  const picture = svg("svg", { viewBox: "0 0 640 130", role: "img", "aria-label": "Shape of the shaft" }, svg("line", { x1: 10, x2: 630, y1: 62, y2: 62, stroke: "#8995a0", "stroke-dasharray": "10 3 2 3" }), across, upright, svg("text", { x: 10, y: 124, "font-size": 11, fill: "#22303c" }, `displacement of the axis, at most ${FIGURES.text(most, "m")}; blue: upwards, orange: to the right`));
  const draw = (values, row) => values.map((column, k) => `${k ? "L" : "M"}${toX(place[k]).toFixed(1)} ${(62 - (column[row] / most) * 52).toFixed(1)}`).join("");
  return {
    node: el("details", { class: "pane", open: state.layout["motion:shape"] !== false, ontoggle: (event) => keepLayout({ "motion:shape": event.target.open }) }, el("summary", {}, "Shape of the shaft"), el("div", { class: "paper plot" }, picture)),
    show(row) {
      across.setAttribute("d", draw(x, row));
      upright.setAttribute("d", draw(y, row));
    },
  };
}

// Rows of an orbit that are drawn before the cursor.
const TRAIL = 600;

async function motionView(directory) {
  const found = await ask(`/api/motion?run=${encodeURIComponent(directory)}`);
  if (found.none) return el("p", { class: "absent hint" }, "Nothing moves in this run.");
  const { time, bearings } = found;
  let row = 0;
  let playing = 0;
  const slider = el("input", { type: "range", min: 0, max: time.length - 1, step: 1, "aria-label": "Instant", oninput: () => show(Number(slider.value)) });
  slider.value = 0;
  const instant = el("output", {});
  const play = button("Play", () => (playing ? stop() : start()), { class: "first" });
  const figures = bearings.map((bearing) => el("figure", {}, el("figcaption", {}), el("canvas", { role: "img", "aria-label": `Orbit and balls ${bearing.name}` })));
  const plots = [...found.plots.map((plot) => timePlot(plot, time, (to) => show(to))), shapePlot(found.shape)].filter(Boolean);
  function stop() {
    cancelAnimationFrame(playing);
    playing = 0;
    play.textContent = "Play";
  }
  function start() {
    play.textContent = "Pause";
    if (row >= time.length - 1) row = 0;
    let last = performance.now();
    // the whole run in 20 s
    const step = (now) => {
      const rows = ((now - last) / 20000) * time.length;
      if (rows >= 1) {
        last = now;
        show(Math.min(time.length - 1, row + Math.floor(rows)));
      }
      if (row >= time.length - 1 || !slider.isConnected) stop();
      else playing = requestAnimationFrame(step);
    };
    playing = requestAnimationFrame(step);
  }
  function show(to) {
    row = to;
    slider.value = row;
    instant.textContent = FIGURES.text(time[row], "s");
    bearings.forEach((bearing, k) => {
      const [caption, canvas] = figures[k].children;
      const force = bearing.force ? bearing.force[row] : 0;
      caption.textContent = `${words(bearing.name || "orbit and balls")}: contact force ${FIGURES.text(force, "N")}`;
      drawOrbit(canvas, { clearance: bearing.clearance, path: bearing.path.slice(Math.max(0, row - TRAIL), row + 1), force, balls: bearing.balls.map(({ azimuth, load }) => [azimuth[row], load[row]]) });
    });
    plots.forEach((plot) => plot.show(row));
  }
  const most = bearings[0].force ? bearings[0].force.indexOf(Math.max(...bearings[0].force)) : 0;
  const node = el("div", { class: "motion" }, el("div", { class: "cursor" }, play, slider, instant), found.every > 1 ? el("p", { class: "hint" }, `Every ${found.every} rows of the history: peaks between them stand in the results.`) : null, el("div", { class: "motion-body" }, el("div", { class: "live" }, figures), el("div", { class: "plots" }, plots.map((plot) => plot.node))));
  // canvases know their width once they are in the page
  requestAnimationFrame(() => show(Math.max(0, most)));
  return node;
}
