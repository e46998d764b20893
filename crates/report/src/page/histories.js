// The time histories: contact, speeds, pressure, residuals.

const RPM = 30 / Math.PI;

// One line for each run that has the column.
function lines(runs, name, scale, look) {
  return runs.flatMap((run) => {
    const values = scaledColumn(run, name, scale);
    if (!values) return [];
    const single = runs.length === 1;
    return [{ ...look, run, label: run.prefix + look.label, time: run.time, values, colour: single ? look.colour : run.colour }];
  });
}

// A figure of one time plot, with the reason for each run that has none of its columns.
function history(title, note, runs, names, series, options) {
  const missing = runs
    .filter((run) => names.some((name) => !columnOf(run, name)))
    .map((run) => notInThisRun(whyNoColumn(run, names), run));
  return figure(title, series.length ? note : null, series.length ? timePlot({ series, ...options }) : null, missing);
}

function contactSection(runs) {
  const force = lines(runs, "bearing.contact.force", 1, { label: "normal force [N]", colour: SERIES_COLOURS.rotor });
  const friction = lines(runs, "bearing.contact.friction_force", 1, {
    label: "friction force [N]",
    colour: SERIES_COLOURS.race,
    width: 1,
    dash: runs.length > 1 ? [4, 3] : undefined,
  });
  const peaks = runs.flatMap((run) => run.contacts.filter((contact) => isNumber(contact.peak_force_N)).map((contact) => ({ run, contact })));
  const marks = (pen, plot, ratio) => {
    for (const { run, contact } of peaks) {
      const x = plot.valToPos(contact.peak_time_s, "x", true);
      const y = plot.valToPos(contact.peak_force_N, "y", true);
      pen.beginPath();
      pen.arc(x, y, 2.5 * ratio, 0, 2 * Math.PI);
      pen.fillStyle = "#fff";
      pen.strokeStyle = runs.length > 1 ? run.colour : SERIES_COLOURS.rotor;
      pen.lineWidth = 1.25 * ratio;
      pen.fill();
      pen.stroke();
    }
  };
  const include = (begin, end) =>
    peaks.filter(({ contact }) => contact.peak_time_s >= begin && contact.peak_time_s <= end).map(({ contact }) => contact.peak_force_N);
  const slip = lines(runs, "bearing.contact.slip_speed", 1, { label: "slip speed [m/s]", colour: SERIES_COLOURS.race });
  return section(
    "contact",
    "Contact of rotor and inner race",
    history(
      "Contact force over time",
      "Circles: the peak of each contact, from dense output, so they may stand above the sampled line. Ticks at the bottom: contact starts.",
      runs,
      ["bearing.contact.force"],
      [...force, ...friction],
      { label: "force [N]", marks, include, ticks: runs, height: 290 },
    ),
    history(
      "Slip speed at the contact",
      "Surface speed of the race minus that of the rotor. It means sliding only while the contact is closed.",
      runs,
      ["bearing.contact.slip_speed"],
      slip,
      { label: "slip speed [m/s]", ticks: runs, height: 180 },
    ),
  );
}

// What turns with the balls: their cage, or without one their mean orbit.
function cageWord(runs) {
  return runs.every((run) => columnOf(run, "bearing.largest_ball_ball_force")) ? "balls' mean orbit" : "cage";
}

function speedSection(runs) {
  const several = runs.length > 1;
  const series = [
    ...lines(runs, "rotor.speed", RPM, { label: "rotor [rpm]", colour: SERIES_COLOURS.rotor, width: 1.25, dash: several ? [8, 4] : undefined }),
    ...lines(runs, "bearing.inner_race.speed", RPM, { label: "inner race [rpm]", colour: SERIES_COLOURS.race, width: several ? 1.75 : 1.5 }),
    ...lines(runs, "bearing.cage.speed", RPM, { label: `${cageWord(runs)} [rpm]`, colour: SERIES_COLOURS.cage, width: 1.5, dash: several ? [9, 3, 2, 3] : undefined }),
  ];
  const absent = [];
  for (const run of runs) {
    const race = columnOf(run, "bearing.inner_race.speed");
    const ratio = run.summary.rolling_cage_ratio;
    if (!race) continue;
    if (!isNumber(ratio)) {
      absent.push(notInThisRun("the rolling speed of the cage, because the summary gives no rolling cage ratio", run));
      continue;
    }
    series.push({
      label: run.prefix + `${cageWord(runs)} if rolling [rpm]`,
      time: run.time,
      values: race.map((speed) => (speed === null ? null : speed * ratio * RPM)),
      colour: several ? run.colour : SERIES_COLOURS.cage,
      width: 1,
      dash: [2, 3],
    });
  }
  const marks = instantMarks(instantsOf(runs));
  // Where no rotor slides its speed is not missing.
  const rotor = runs.some((run) => !isSpinUp(run)) ? ["rotor.speed"] : [];
  const names = [...rotor, "bearing.inner_race.speed", "bearing.cage.speed"];
  const full = runs.every(isSpinUp) ? "full speed" : "the rotor's speed at release";
  return section(
    "speeds",
    "Speeds",
    history(
      runs.some((run) => columnOf(run, "rotor.speed")) ? "Speeds of rotor, inner race and cage" : "Speeds of inner race and cage",
      `Dotted: the cage speed at which the balls would roll at the present race speed. Upright lines: first time at 50 % and 95 % of ${full}. Counter-clockwise is positive.`,
      runs,
      names,
      series,
      { label: "speed [rpm]", second: { label: "speed [rad/s]", factor: 1 / RPM }, marks, ticks: runs, height: 310 },
    ),
    absent,
  );
}

function pressureSection(runs) {
  const series = [
    ...lines(runs, "bearing.inner_pressure", 1e-6, { label: "inner race [MPa]", colour: SERIES_COLOURS.race }),
    ...lines(runs, "bearing.outer_pressure", 1e-6, { label: "outer race [MPa]", colour: SERIES_COLOURS.rotor, dash: runs.length > 1 ? [4, 3] : undefined }),
  ];
  const limits = [...new Set(runs.map((run) => run.summary.hertz_pressure_limit_Pa).filter(isNumber))];
  const marks = (pen, plot, ratio) => {
    for (const limit of limits) levelMark(pen, plot, ratio, limit / 1e6, "limit " + engineeringText(limit, "Pa", 4), SERIES_COLOURS.limit);
  };
  const absent = runs
    .filter((run) => !isNumber(run.summary.hertz_pressure_limit_Pa))
    .map((run) => notInThisRun("a pressure limit, because none is given for these balls", run));
  return section(
    "pressure",
    "Hertz pressure",
    history(
      "Largest Hertz pressure of all balls",
      "It is the ball load under the contact, not the rotor force, that meets the static limit of the balls.",
      runs,
      ["bearing.inner_pressure", "bearing.outer_pressure"],
      series,
      { label: "pressure [MPa]", marks, include: () => limits.map((limit) => limit / 1e6), ticks: runs, height: 260 },
    ),
    absent,
  );
}

// Forces that keep the balls apart: pockets and land of a cage, or the next ball.
const SEPARATION_FORCES = [
  ["bearing.cage.largest_pocket_force", "largest pocket force [N]", "cage"],
  ["bearing.cage.land_force", "land force [N]", "race"],
  ["bearing.largest_ball_ball_force", "largest force between balls [N]", "cage"],
];

function separationFigures(runs) {
  const several = runs.length > 1;
  const of = (run) => SEPARATION_FORCES.filter(([name]) => columnOf(run, name));
  const series = runs.flatMap((run) =>
    of(run).map(([name, words, part], index) => ({
      label: run.prefix + words,
      time: run.time,
      values: columnOf(run, name),
      colour: several ? run.colour : SERIES_COLOURS[part],
      width: 1,
      dash: several && index ? [4, 3] : undefined,
    })),
  );
  if (!series.length) return [cagePlaceFigure(runs), filmFigure(runs)];
  const missing = runs.filter((run) => !of(run).length).map((run) => notInThisRun("this run has no forces on a cage or between balls (only the planar fidelity gives them)", run));
  const note = "Forces in the rows of the history; peaks between rows are in the table. " + (runs.every(isSpinUp) ? "They are chaotic." : "Such impacts are what makes late details of a drop irreproducible.");
  const plot = series.length ? timePlot({ series, label: "force [N]", ticks: runs, height: 190 }) : null;
  return [figure("What keeps the balls apart", plot ? note : null, plot, missing), cagePlaceFigure(runs), filmFigure(runs)];
}

// How far the cage is off the centre of the ring that guides it, with the clearance of its land.
function cagePlaceFigure(runs) {
  const word = (run, path) => (inputOf(run, path) || {}).value;
  const free = runs.filter((run) => columnOf(run, "bearing.cage.x"));
  if (!free.length) return null;
  const ring = (run) => (word(run, "bearing.cage.guidance") === "inner land" ? "inner" : "outer");
  const centre = (run, axis, row) => (columnOf(run, `bearing.${ring(run)}_race.${axis}`) || [])[row] || 0;
  const series = free.map((run) => {
    const [x, y] = [columnOf(run, "bearing.cage.x"), columnOf(run, "bearing.cage.y")];
    const values = x.map((value, row) => (isNumber(value) ? 1e6 * Math.hypot(value - centre(run, "x", row), y[row] - centre(run, "y", row)) : null));
    return { label: run.prefix + "cage off centre [µm]", time: run.time, values, colour: runs.length > 1 ? run.colour : SERIES_COLOURS.cage, width: 1 };
  });
  const clearances = [...new Set(free.map((run) => lengthOf(word(run, "bearing.cage.land_radial_clearance"))).filter(isNumber))];
  const marks = (pen, plot, ratio) => {
    for (const clearance of clearances) levelMark(pen, plot, ratio, 1e6 * clearance, "land", SERIES_COLOURS.quiet);
  };
  const include = () => clearances.map((clearance) => 1e6 * clearance);
  return figure("Place of the cage", "Distance of the cage's centre from that of the ring that guides it. Above the line cage and land are pressed together.", timePlot({ series, label: "distance [µm]", marks, include, ticks: runs, height: 190 }));
}

// A length as inputs write it, in m.
function lengthOf(text) {
  const match = /^\s*([-+.\deE]+)\s*(m|mm|um|µm)\s*$/.exec(String(text || ""));
  return match ? Number(match[1]) * { m: 1, mm: 1e-3, um: 1e-6, "µm": 1e-6 }[match[2]] : null;
}

// The thinnest film of all loaded balls at each race; nothing where no ball carries load.
function filmFigure(runs) {
  const thinnest = (run, part) => {
    const columns = ballsOf(run).map((ball) => ball[part]).filter(Boolean);
    if (!columns.length) return null;
    return run.time.map((_, row) => {
      const loaded = columns.map((values) => values[row]).filter((value) => isNumber(value) && value > 0);
      return loaded.length ? 1e6 * Math.min(...loaded) : null;
    });
  };
  const several = runs.length > 1;
  const series = runs.flatMap((run) =>
    [["inner_film", "inner race [µm]", "race"], ["outer_film", "outer race [µm]", "rotor"]].flatMap(([part, words, colour], index) => {
      const values = thinnest(run, part);
      return values ? [{ label: run.prefix + words, time: run.time, values, colour: several ? run.colour : SERIES_COLOURS[colour], width: 1, dash: several && index ? [4, 3] : undefined }] : [];
    }),
  );
  if (!series.length) return null;
  const roughness = [...new Set(runs.map((run) => lengthOf((inputOf(run, "bearing.traction.composite_roughness") || {}).value)).filter(isNumber))];
  const marks = (pen, plot, ratio) => {
    for (const height of roughness) levelMark(pen, plot, ratio, 1e6 * height, "roughness: λ = 1", SERIES_COLOURS.limit);
  };
  return figure("Thinnest oil film", "Central film of the loaded ball that has the thinnest one. Below the line asperities carry load.", timePlot({ series, label: "film [µm]", marks, include: () => [0, ...roughness.map((height) => 1e6 * height)], ticks: runs, height: 210 }));
}

// The unit in which the largest value of a column over all runs reads best; without prefixed units a power of ten.
function axisUnit(runs, name, unit) {
  const most = runs.flatMap((run) => columnOf(run, name) || []).reduce((largest, value) => Math.max(largest, Math.abs(value || 0)), 0);
  if (!(most > 0)) return [unit, 1];
  if (PREFIXED[unit] && most >= PREFIXED[unit].at(-1)[1]) return readableUnit(most, unit);
  const exponent = 3 * Math.floor(Math.log10(most) / 3);
  return [exponent === 0 ? unit : `${powerOfTen(exponent)} ${unit}`, 10 ** exponent];
}

function residualFigures(runs) {
  const [energyUnit, energyScale] = axisUnit(runs, "energy.residual", "J");
  const [momentumUnit, momentumScale] = axisUnit(runs, "angular_momentum.residual", "N m s");
  const energy = lines(runs, "energy.residual", 1 / energyScale, { label: `energy residual [${energyUnit}]`, colour: SERIES_COLOURS.rotor });
  const momentum = lines(runs, "angular_momentum.residual", 1 / momentumScale, {
    label: `angular momentum residual [${momentumUnit}]`,
    colour: SERIES_COLOURS.race,
  });
  return [
    history("Energy residual", "Sources minus change of stored energy minus heats: what the time integration lost or made.", runs, ["energy.residual"], energy, {
      label: `[${energyUnit}]`,
      height: 170,
    }),
    history("Angular momentum residual", "Change of angular momentum minus the impulse of all outer moments.", runs, ["angular_momentum.residual"], momentum, {
      label: `[${momentumUnit}]`,
      height: 170,
    }),
  ];
}
