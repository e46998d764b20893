// A flexible rotor on its auxiliary bearings: the rotor to scale, and its shape as time goes by.

const SHAPE_WAYS = [["y", "up [µm]"], ["x", "to the right [µm]"]];

// Runs that are bearings of the same machine share its rotor: the first of them draws it.
function machinesOf(runs) {
  const seen = new Map();
  for (const run of runs) {
    const key = `${run.directory}|${run.summary.title || ""}`;
    if (!seen.has(key)) seen.set(key, []);
    seen.get(key).push(run);
  }
  return [...seen.values()];
}

// Displacements of the shaft at its places, in µm: a list of columns for each way.
function shapeColumns(run) {
  const count = tableOf(run, "shape")("place").length;
  const of = (way) => Array.from({ length: count }, (_, k) => columnOf(run, `shape.${k + 1}.${way}`));
  return Object.fromEntries(SHAPE_WAYS.map(([way]) => [way, of(way)]));
}

// Where the shaft may move: the clearance of each bearing, counted from where it stands, and of seals, sensors and magnets.
function roomAlong(machine) {
  const [place, x, y] = ["place", "x", "y"].map(tableOf(machine[0], "bearings"));
  const bearings = machine.map((run, k) => ({ z: place[k], name: run.summary.name || "", clearance: run.summary.clearance_radius_m || 0, offset: { x: x[k] || 0, y: y[k] || 0 }, colour: run.colour }));
  const around = tableOf(machine[0], "clearances");
  return [...bearings, ...around("name").map((name, k) => ({ z: around("place")[k], name, clearance: around("clearance")[k], offset: { x: 0, y: 0 }, colour: "#8a4fae" }))];
}

// How near the shaft comes to what stands around it.
function reachFigure(machine) {
  const [place, displacement] = ["place", "displacement"].map(tableOf(machine[0], "shape"));
  const [at, gone] = [place.map((z) => 1e3 * z), displacement.map((value) => 1e6 * value)];
  const around = roomAlong(machine).map(({ z, name, clearance, colour }) => ({ label: name, x: [1e3 * z], y: [1e6 * clearance], colour, line: false, dots: true, radius: 5 }));
  return curves({ series: [{ label: "largest displacement", x: at, y: gone, colour: "#22303c", dots: true }, ...around], across: "z [mm]", upright: "distance [µm]", level: { at: 0, words: "line of levitation" }, height: 260 });
}

// The row below the axis that each name prints in so that none lies over its neighbour: bearings from the first row on, what else stands there
// from the second. Characters of 10.5 px are at most 6 px wide.
function rowsOfNames(rooms, bearings, toX) {
  const ends = [];
  const rows = rooms.map(() => 0);
  const order = rooms.map((_, k) => k).sort((a, b) => toX(rooms[a].z) - toX(rooms[b].z));
  for (const k of order) {
    const [middle, half] = [toX(rooms[k].z), 3 * rooms[k].name.length];
    let row = k < bearings ? 0 : 1;
    while (ends[row] > middle - half) row += 1;
    [rows[k], ends[row]] = [row, middle + half + 6];
  }
  return rows;
}

function shapeDrawing(machine, shapes, row, width) {
  const run = machine[0];
  const z = tableOf(run, "shape")("place");
  const rooms = roomAlong(machine);
  const reach = 1.25e6 * Math.max(...rooms.map((room) => room.clearance + Math.hypot(room.offset.x, room.offset.y)), 1e-6);
  const margin = { left: 74, right: 24, top: 12, between: 22, bottom: 58 };
  const tall = 150;
  const [first, last] = [z[0], z[z.length - 1]];
  const toX = (at) => margin.left + ((at - first) / (last - first || 1)) * (width - margin.left - margin.right);
  const nameRows = rowsOfNames(rooms, machine.length, toX);
  margin.bottom += 12 * Math.max(0, ...nameRows.map((nameRow) => nameRow - 1));
  const height = margin.top + 2 * tall + margin.between + margin.bottom;
  const panels = SHAPE_WAYS.map(([way, words], panel) => {
    const top = margin.top + panel * (tall + margin.between);
    const toY = (value) => top + tall / 2 - (Math.max(-1.2 * reach, Math.min(1.2 * reach, value)) / reach) * (tall / 2);
    const steps = axisSteps(-reach, reach, 4).filter((value) => Math.abs(value) <= reach);
    const grid = steps.map((value) => [
      drawing("line", { x1: margin.left, x2: width - margin.right, y1: toY(value), y2: toY(value), stroke: value === 0 ? "#8995a0" : "#e2e6ea", "stroke-dasharray": value === 0 ? "10 3 2 3" : null }),
      drawing("text", { x: margin.left - 6, y: toY(value) + 4, "text-anchor": "end", "font-size": 11, fill: INK }, numberText(value, 4)),
    ]);
    const walls = rooms.map((room) => [1, -1].map((side) => {
      const y = toY(1e6 * (room.offset[way] + side * room.clearance));
      return drawing("line", { x1: toX(room.z) - 12, x2: toX(room.z) + 12, y1: y, y2: y, stroke: room.colour, "stroke-width": 3 }, drawing("title", {}, `${room.name}: clearance`));
    }));
    const points = z.map((at, k) => [toX(at), shapes[way][k] && isNumber(shapes[way][k][row]) ? toY(1e6 * shapes[way][k][row]) : null]).filter(([, y]) => y !== null);
    const line = drawing("path", { d: points.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join(""), fill: "none", stroke: "#22303c", "stroke-width": 2.2 });
    const dots = points.map(([x, y]) => drawing("circle", { cx: x, cy: y, r: 2, fill: "#22303c" }));
    return [grid, walls, line, dots, drawing("text", { x: 14, y: top + tall / 2, "font-size": 11, fill: INK, transform: `rotate(-90 14 ${top + tall / 2})`, "text-anchor": "middle" }, words)];
  });
  const below = height - margin.bottom + 14;
  const axis = axisSteps(first * 1e3, last * 1e3, Math.max(3, width / 110)).map((mm) => drawing("text", { x: toX(mm / 1e3), y: below, "text-anchor": "middle", "font-size": 11, fill: INK }, numberText(mm, 4)));
  // bearings above what else stands there: a magnet often has the name of the bearing beside it
  const names = rooms.map((room, k) => drawing("text", { x: toX(room.z), y: below + 26 + 12 * nameRows[k], "text-anchor": "middle", "font-size": 10.5, fill: room.colour }, room.name));
  return drawing("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img" }, panels, axis, names, drawing("text", { x: 4, y: below, "font-size": 11, fill: INK }, "z [mm]"));
}

function shapeFigure(machine) {
  const run = machine[0];
  const shapes = shapeColumns(run);
  const holder = element("div", { class: "curves" });
  // the first contact says more than the rest above the bearings
  const contacts = machine.flatMap((each) => each.contacts).map((contact) => contact.peak_time_s).filter(isNumber);
  const instant = contacts.length ? Math.min(...contacts) : 0;
  const draw = (row) => holder.replaceChildren(shapeDrawing(machine, shapes, row, holder.clientWidth || 900));
  return [timeSlider(run, instant, draw), holder];
}

const AXIS_COLOURS = ["#1f5fa8", "#6d9fd3", "#c2571a", "#e0a03c", "#2f8f5b", "#8fc4a6", "#8a4fae", "#b48fcc"];

// A figure of the columns over time whose names match, what their groups say in words; none where the run has none.
function columnsFigure(run, pattern, { title, note, label, words, marks = [], factor = 1 }) {
  const names = [...run.columns.keys()].filter((name) => pattern.test(name));
  if (!names.length) return null;
  const colour = (place) => AXIS_COLOURS[(names.length > 2 ? place : 2 * place) % AXIS_COLOURS.length];
  const series = names.map((name, place) => ({ label: words(...name.match(pattern).slice(1)), time: run.time, values: columnOf(run, name).map((value) => factor * value), colour: colour(place), width: 1 }));
  return figure(title, note, timePlot({ series, label, marks, ticks: [run], height: 220 }));
}

// Control currents of the magnets' axes, acceleration of the base, motion of the housings.
function besidesOf(run) {
  const release = instantMarks(instantsOf([run]).filter(({ words }) => words === "release"));
  return [
    columnsFigure(run, /^base\.acceleration_([xy])$/, { title: "Acceleration of the base", note: "At the rows of the history; displacements are relative to the base.", label: "acceleration [m/s²]", words: (axis) => `${axis} [m/s²]` }),
    columnsFigure(run, /^housing\.(.*)\.([xy])$/, { title: "Motion of the housings", note: "Displacement from where each rests with the levitated rotor.", label: "displacement [µm]", words: (housing, axis) => `${wordsOf(housing)}, ${axis} [µm]`, marks: release, factor: 1e6 }),
    columnsFigure(run, /^magnet\.(.*)\.current_([12])$/, { title: "Control currents", note: "Of each axis of the magnets, without bias; after the loss of power what is left of them.", label: "current [A]", words: (magnet, axis) => `${wordsOf(magnet)}, axis ${axis} [A]`, marks: release }),
  ];
}

function machineSection(runs) {
  const machines = machinesOf(runs);
  const of = (machine) => (machines.length > 1 ? `${machine[0].name}: ` : "");
  return section(
    "machine",
    "The rotor on its bearings",
    machines.map((machine) => [
      figure(`${of(machine)}Rotor to scale`, DRAWN, rotorPicture(machine[0], [], machine.map((run) => run.summary.name || ""))),
      columnOf(machine[0], "shape.1.x") ? figure(`${of(machine)}Shape of the shaft over time`, "Displacement of the shaft's axis from the line of levitation, at the rows of the history. Bars: clearance of each auxiliary bearing about where it stands at rest; violet: clearances of seals, sensors and magnets, where housings rest.", shapeFigure(machine)) : null,
      ...besidesOf(machine[0]),
      tableOf(machine[0], "shape")("displacement").length ? figure(`${of(machine)}Largest displacement along the shaft`, "Largest distance of the shaft's axis from the line of levitation in the whole run; dots: the clearances. A bearing's race moves with the rotor; beyond any other dot the rotor touches what stands there. What belongs to a housing moves with it: how far it was from the shaft stands in node.*.least_distance.", reachFigure(machine)) : null,
    ]),
  );
}

function rotorFacts(run) {
  return shownIn(run, "rotor_line").map(({ words, value, quantity }) => `${words} ${siText(value, quantity.unit)}`).join(", ");
}

// Of several bearings the rotor stands once, above them.
function bentLine(run) {
  const line = machineLine(run);
  return element("p", { class: "machine" }, [run.whole ? null : rotorFacts(run), line ? line.textContent : null].filter(Boolean).join(" · "));
}

register("machine", {
  ...dropPage,
  line: bentLine,
  rotor: (run) => element("p", { class: "machine" }, rotorFacts(run)),
  sections: (runs) => [[9, machineSection, runs], [61.5, spaceSection, inSpace(runs)], ...dropPage.sections(runs)].filter(([, , some]) => some.length),
});
