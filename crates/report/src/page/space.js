// Bearings in space: ball loads of their rows at an instant, motion of the rotor along its axis, contact angles against the ends of the grooves.

// Contact angles at which the grooves of the inner and the outer race end, deg; null where the height of the shoulder is not given.
const grooveEnds = (run) => anglesNamed(run, "groove ends");

function anglesNamed(run, name) {
  const [angles] = shownIn(run, "space").filter(({ words }) => words === name).map(({ quantity }) => list(quantity.value));
  return angles && angles.length ? angles.map((angle) => (180 / Math.PI) * angle) : null;
}

function grooveNote(runs, race) {
  const ends = [...new Set(runs.map(grooveEnds).map((own) => (own ? numberText(own[race], 3) : null)))];
  const given = ends.filter(Boolean);
  const words = "The ball's contact is blank without load. ";
  return words + (given.length ? `Red mark on the scale: the groove ends at ${given.join(", ")} deg. A contact ellipse is cut off before its middle is there.` : "Where the grooves end is not known: bearing.shoulder_height is not given.");
}

// Room beside a drawing for the words of its sides.
const SIDE_WORDS = 34;

// Loads of the balls of one row around the bearing, outwards from the pitch circle: inner race to the left of each ball, outer to the right.
function loadDrawing(row, at, largest, size) {
  const [middle, centre, pitch, room] = [size / 2, size / 2 + SIDE_WORDS, 0.22 * size, 0.2 * size];
  const scale = room / largest;
  const point = (azimuth, radius) => [centre + radius * Math.cos(azimuth), middle - radius * Math.sin(azimuth)];
  const steps = axisSteps(0, largest, 3).filter((load) => load > 0 && load <= 1.001 * largest);
  const circles = [0, ...steps].map((load) => drawing("circle", { cx: centre, cy: middle, r: pitch + scale * load, fill: "none", stroke: load ? RULE : "#8995a0" }));
  const words = steps.map((load) => axisText(...point(Math.PI / 4, pitch + scale * load + 3), "start", `${numberText(load, 3)} N`, { "font-size": 10.5, fill: PALE_INK }));
  const sides = [["right 0°", 0, "start"], ["up 90°", 0.5 * Math.PI, "middle"], ["left 180°", Math.PI, "end"], ["down 270°", 1.5 * Math.PI, "middle"]].map(([name, azimuth, anchor]) => {
    const [x, y] = point(azimuth, pitch + room + 8);
    return axisText(x, y + 4 + (anchor === "middle" ? -5 * Math.sin(azimuth) : 0), anchor, name, { "font-size": 10.5, fill: PALE_INK });
  });
  const balls = ballsOf(row).map((ball, index) => {
    const azimuth = ball.azimuth && ball.azimuth[at];
    if (!isNumber(azimuth)) return null;
    const bars = [["inner_load", 1, SERIES_COLOURS.race], ["outer_load", -1, SERIES_COLOURS.rotor]].map(([part, side, stroke]) => {
      const load = (ball[part] && ball[part][at]) || 0;
      // 3 px to either side of the ball
      const turned = azimuth + (side * 3) / pitch;
      const [x1, y1] = point(turned, pitch);
      const [x2, y2] = point(turned, pitch + scale * load);
      return load > 0 ? drawing("line", { x1, y1, x2, y2, stroke, "stroke-width": 4 }, drawing("title", {}, `${ball.name}: ${numberText(load, 4)} N`)) : null;
    });
    const [cx, cy] = point(azimuth, pitch);
    return [bars, drawing("circle", { cx, cy, r: index ? 3 : 4.5, fill: index ? "#22303c" : "#ffffff", stroke: "#22303c", "stroke-width": 1.5 })];
  });
  const width = size + 2 * SIDE_WORDS;
  return drawing("svg", { width, height: size, viewBox: `0 0 ${width} ${size}`, role: "img" }, circles, words, sides, balls);
}

const RACES = ["inner", "outer"];
const RACE_COLOURS = [SERIES_COLOURS.race, SERIES_COLOURS.rotor];

// How far the contact ellipse of a ball reaches in the groove of a race, deg; null where it carries nothing.
function ellipseReach(ball, race, at, halves) {
  const [load, angle] = ["load", "angle"].map((part) => (ball[`${RACES[race]}_${part}`] || [])[at]);
  return load > 0 && isNumber(angle) ? [-1, 1].map((side) => angle + side * halves[race] * Math.cbrt(load)) : null;
}

const GROOVE_HEIGHT = 190;

// Contact ellipses of one row in their grooves unrolled: azimuth to the right, angle in the groove upwards; inner race to the left of each ball.
function ellipseDrawing(row, at, { halves, ends, low, high }) {
  const [left, top, width, height] = [SIDE_WORDS + 12, 8, LOADS_SIZE - 8, GROOVE_HEIGHT - 46];
  const y = (angle) => top + (height * (high - angle)) / (high - low);
  const frame = drawing("rect", { x: left, y: top, width, height, fill: "none", stroke: RULE });
  const angles = axisSteps(low, high, 4).filter((angle) => angle >= low && angle <= high);
  const upright = angles.map((angle) => [drawing("line", { x1: left, x2: left + width, y1: y(angle), y2: y(angle), stroke: RULE, "stroke-width": 0.5 }), axisText(left - 5, y(angle) + 4, "end", `${numberText(angle, 3)}°`, { "font-size": 10.5, fill: PALE_INK })]);
  const across = MAP_TICKS.map(([share, words]) => axisText(left + share * width, top + height + 14, "middle", words, { "font-size": 10.5, fill: PALE_INK }));
  const shoulders = (ends || []).flatMap((end, race) => [-end, end].filter((angle) => angle > low && angle < high).map((angle) => drawing("line", { x1: left, x2: left + width, y1: y(angle), y2: y(angle), stroke: SERIES_COLOURS.limit, "stroke-width": 1.5, "stroke-dasharray": race ? "2 3" : "7 4" }, drawing("title", {}, `shoulder of the ${RACES[race]} race`))));
  const balls = ballsOf(row).flatMap((ball) =>
    RACES.map((_, race) => {
      const reach = ellipseReach(ball, race, at, halves);
      if (!reach || !isNumber((ball.azimuth || [])[at])) return null;
      const x = left + turnShare(ball.azimuth[at]) * width + (race ? 3 : -3);
      return drawing("line", { x1: x, x2: x, y1: y(reach[0]), y2: y(reach[1]), stroke: RACE_COLOURS[race], "stroke-width": 4 }, drawing("title", {}, `${ball.name}, ${RACES[race]} race: ${reach.map((angle) => numberText(angle, 3)).join(" to ")}°`));
    }),
  );
  const size = { width: LOADS_SIZE + 2 * SIDE_WORDS, height: GROOVE_HEIGHT };
  return drawing("svg", { ...size, viewBox: `0 0 ${size.width} ${size.height}`, role: "img", style: "display:block" }, upright, across, frame, shoulders, balls);
}

// Angles between which all ellipses of a run lie, with the shoulders where they are known; null without ellipses.
function ellipseScale(run) {
  const halves = anglesNamed(run, "ellipses");
  if (!halves) return null;
  const ends = grooveEnds(run);
  let [low, high] = [0, 0];
  for (const ball of ballsOf(run))
    for (let at = 0; at < run.time.length; at++)
      for (const race of [0, 1]) {
        const reach = ellipseReach(ball, race, at, halves);
        if (reach) [low, high] = [Math.min(low, reach[0]), Math.max(high, reach[1])];
      }
  const near = (ends || []).flatMap((end) => [-end, end]).filter((angle) => angle > 1.4 * low - 5 && angle < 1.4 * high + 5);
  return { halves, ends, low: Math.min(low, ...near) - 1, high: Math.max(high, ...near) + 1 };
}

// What the most loaded ball of a row carries, and under which angles.
function mostLoaded(row, at) {
  const balls = ballsOf(row).filter((ball) => ball.outer_load && isNumber(ball.outer_load[at]));
  const most = balls.reduce((best, ball) => (best && best.outer_load[at] >= ball.outer_load[at] ? best : ball), null);
  const carried = balls.filter((ball) => ball.outer_load[at] > 0 && ball.inner_load[at] > 0).length;
  if (!most || !carried) return "no ball is pressed by both races";
  const angle = (part) => (most[part] && isNumber(most[part][at]) ? `${numberText(most[part][at], 3)}°` : "–");
  return `${carried} of ${balls.length} balls are pressed; most ${most.name}: inner ${numberText(most.inner_load[at], 4)} N at ${angle("inner_angle")}, outer ${numberText(most.outer_load[at], 4)} N at ${angle("outer_angle")}`;
}

const LOADS_SIZE = 330;
const SCALES = [1, 1.5, 2, 3, 4, 6, 8, 10];

function loadFigure(run, runs) {
  const rows = rowsOf(run);
  const holder = element("div", { class: "rows" });
  const all = ballsOf(run);
  const ellipses = ellipseScale(run);
  const draw = (at) => {
    const most = all.reduce((largest, ball) => Math.max(largest, ball.inner_load[at] || 0, ball.outer_load[at] || 0), 0);
    // in steps, so that the scale rarely changes while time runs
    const power = 10 ** Math.floor(Math.log10(most || 1));
    const largest = SCALES.map((scale) => scale * power).find((scale) => scale >= most);
    const drawings = rows.map((row) => element("div", {}, element("p", { class: "run-label" }, rows.length > 1 ? `row ${row.row}${row.row > 1 ? ", towards the end of the shaft" : ", towards the start of the shaft"}` : "the row"), loadDrawing(row, at, largest, LOADS_SIZE), ellipses && ellipseDrawing(row, at, ellipses), element("p", { class: "small" }, mostLoaded(row, at))));
    holder.replaceChildren(...drawings);
  };
  const peak = axialPeak(run) || (peakContact(run) || {}).peak_time_s || run.time[0];
  const key = RACES.map((race, k) => [`${race} race`, RACE_COLOURS[k]]).map(([words, colour]) => element("span", { class: "curve-key" }, curveSample({ colour, width: 4 }), words));
  const note = "Load of every ball at its azimuth, outwards from the pitch circle; all rows to one scale; the white ball is the first of its row. Below: how far the contact ellipses reach along their grooves, angles positive towards the end of the shaft; red: the edges of the shoulders, inner race long dashes, outer race short ones, where bearing.shoulder_height is given. Move the pointer over a time plot, or the slider.";
  return figure(shareOfRun(run, runs, "Ball loads around the rows, and contact ellipses"), note, timeSlider(run, peak, draw, true), holder, element("p", { class: "curve-keys" }, key));
}

// The instant of the largest force on the faces, or null.
function axialPeak(run) {
  const force = columnOf(run, "bearing.contact.axial_force");
  const row = force ? force.reduce((best, value, at) => ((value || 0) > (force[best] || 0) ? at : best), 0) : 0;
  return force && force[row] > 0 ? run.time[row] : null;
}

// Gaps between shoulders and faces, towards the start and the end, m; null where there is no shoulder.
function faceGaps(run) {
  return ["contact.gap_to_start", "contact.gap_to_end"].map((path) => lengthOf((inputOf(run, path) || {}).value));
}

const both = (left, right, join) => left.map((value, row) => (isNumber(value) && isNumber(right[row]) ? join(value, right[row]) : null));

function axialFigures(run, runs) {
  const [rotor, inner, outer] = ["rotor.z", "bearing.inner_race.z", "bearing.outer_race.z"].map((name) => columnOf(run, name));
  if (!rotor || !inner) return notInThisRun(whyNoColumn(run, ["rotor.z", "bearing.inner_race.z"]), run);
  const [start, end] = faceGaps(run);
  const microns = (values) => values.map((value) => (value === null ? null : 1e6 * value));
  const limit = (gap, words) => (isNumber(gap) ? [{ label: words, time: run.time, values: microns(inner.map((value) => (value === null ? null : value + gap))), colour: SERIES_COLOURS.limit, width: 1, dash: [6, 4] }] : []);
  const series = [
    { label: "rotor [µm]", time: run.time, values: microns(rotor), colour: SERIES_COLOURS.rotor, width: 1.5 },
    { label: "inner ring [µm]", time: run.time, values: microns(inner), colour: SERIES_COLOURS.race },
    ...(outer ? [{ label: "outer rings [µm]", time: run.time, values: microns(outer), colour: SERIES_COLOURS.cage }] : []),
    ...limit(end, "rotor on the face, moved to the end [µm]"),
    ...limit(isNumber(start) ? -start : null, "rotor on the face, moved to the start [µm]"),
  ];
  const force = columnOf(run, "bearing.contact.axial_force");
  const bore = columnOf(run, "bearing.contact.force");
  const forces = [
    ...(bore ? [{ label: "bore [N]", time: run.time, values: bore, colour: SERIES_COLOURS.quiet, width: 1 }] : []),
    ...(force ? [{ label: "faces [N]", time: run.time, values: force, colour: SERIES_COLOURS.race, width: 1.5 }] : []),
  ];
  const marks = instantMarks(instantsOf([{ ...run, prefix: "" }]));
  const gaps = [start, end].some(isNumber) ? "Dashed: where its shoulders meet the faces of the inner ring, without tilt." : "No shoulder stands in the way of the rotor.";
  return [
    figure(shareOfRun(run, runs, "Motion along the axis"), `Displacements towards the end of the shaft. ${gaps}`, timePlot({ series, label: "displacement [µm]", marks, height: 260 })),
    forces.length ? figure(shareOfRun(run, runs, "Axial and radial force on the rotor"), "Sizes: of the faces along the axis, of the bore across it.", timePlot({ series: forces, label: "force [N]", marks, ticks: [run], height: 220 })) : null,
    axialOrbit(run, runs, [start, end]),
  ];
}

// Parts of an orbit, so that time is seen in its colour.
const ORBIT_PARTS = 24;

function axialOrbit(run, runs, [start, end]) {
  const path = orbitPath(run, false);
  const [rotor, inner] = ["rotor.z", "bearing.inner_race.z"].map((name) => columnOf(run, name));
  if (!path) return null;
  const radial = both(path.x, path.y, (x, y) => 1e6 * Math.hypot(x, y));
  const axial = both(rotor, inner, (z, ring) => 1e6 * (z - ring));
  const clearance = isNumber(run.summary.clearance_radius_m) ? 1e6 * run.summary.clearance_radius_m : null;
  const rows = Math.max(2, Math.ceil(run.time.length / ORBIT_PARTS));
  const parts = Array.from({ length: Math.ceil((run.time.length - 1) / rows) }, (_, k) => [k * rows, Math.min(run.time.length, (k + 1) * rows + 1)]);
  const pieces = parts.map(([from, to], k) => ({ x: radial.slice(from, to), y: axial.slice(from, to), colour: lineColour(k / Math.max(1, parts.length - 1)), width: 1.2, gaps: true }));
  const known = (values) => values.filter(isNumber);
  const [low, high] = [Math.min(...known(axial), isNumber(start) ? -1e6 * start : 0), Math.max(...known(axial), isNumber(end) ? 1e6 * end : 0)];
  const far = Math.max(...known(radial), clearance || 0);
  const wall = (x, y, label) => ({ label, x, y, colour: SERIES_COLOURS.limit, dash: "6 4", width: 1.5 });
  const walls = [
    ...(clearance ? [wall([clearance, clearance], [low, high], "bore")] : []),
    ...[[start, -1], [end, 1]].filter(([gap]) => isNumber(gap)).map(([gap, side], k) => wall([0, far], [1e6 * side * gap, 1e6 * side * gap], k ? null : "faces")),
  ];
  const [first, last] = [parts[0], parts.at(-1)].map((_, k) => `${timeline.text(run.time[k ? run.time.length - 1 : 0])}`);
  const keys = [{ label: first, x: [], y: [], colour: lineColour(0), width: 3 }, { label: last, x: [], y: [], colour: lineColour(1), width: 3 }];
  return figure(
    shareOfRun(run, runs, "Axial against radial displacement"),
    `Rotor relative to the inner ring over the whole run, from ${first} (pale) to ${last} (dark); dashed: the clearance of the bore and the gaps to the faces.`,
    curves({ series: [...pieces, ...walls, ...keys], across: "radial displacement [µm]", upright: "axial displacement, to the end [µm]", height: 340 }),
  );
}

function spaceSection(runs) {
  return section(
    "space",
    "Bearings in space",
    runs.map((run) => [ballsOf(run).some((ball) => ball.azimuth) ? [loadFigure(run, runs), spaceView(run, runs)] : null, axialFigures(run, runs)]),
  );
}
