// The time histories: contact, speeds, pressure, residuals.

const RPM = 30 / Math.PI;

// One line for each run that has the column.
function lines(runs, name, scale, look) {
  return runs.flatMap((run) => {
    const values = scaledColumn(run, name, scale);
    if (!values) return [];
    const single = runs.length === 1;
    return [{ ...look, label: run.prefix + look.label, time: run.time, values, colour: single ? look.colour : run.colour }];
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

const INSTANTS = [
  ["inner_race_time_to_50_percent", "race 50 %", "race"],
  ["inner_race_time_to_95_percent", "race 95 %", "race"],
  ["cage_time_to_95_percent_of_rolling", "cage 95 % of rolling", "cage"],
];

function speedSection(runs) {
  const several = runs.length > 1;
  const series = [
    ...lines(runs, "rotor.speed", RPM, { label: "rotor [rpm]", colour: SERIES_COLOURS.rotor, width: 1.25, dash: several ? [8, 4] : undefined }),
    ...lines(runs, "bearing.inner_race.speed", RPM, { label: "inner race [rpm]", colour: SERIES_COLOURS.race, width: several ? 1.75 : 1.5 }),
    ...lines(runs, "bearing.cage.speed", RPM, { label: "cage [rpm]", colour: SERIES_COLOURS.cage, width: 1.5, dash: several ? [9, 3, 2, 3] : undefined }),
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
      label: run.prefix + "cage if rolling [rpm]",
      time: run.time,
      values: race.map((speed) => (speed === null ? null : speed * ratio * RPM)),
      colour: several ? run.colour : SERIES_COLOURS.cage,
      width: 1,
      dash: [2, 3],
    });
  }
  const marks = (pen, plot, ratio) => {
    // With more than two runs the words would cover the curves: one instant each, the others are in the table.
    const shown = INSTANTS.filter(([name]) => runs.length <= 2 || name === "inner_race_time_to_95_percent");
    const known = runs.flatMap((run) =>
      shown.map(([name, words, part]) => ({ instant: numberOf(run, name), words: run.prefix + words, colour: several ? run.colour : SERIES_COLOURS[part] })),
    );
    instantMarks(pen, plot, ratio, known.filter((mark) => mark.instant !== null));
  };
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

function pocketFigure(runs) {
  const series = runs.flatMap((run) => {
    const values = largestOverBalls(run, "pocket_force");
    if (!values) return [];
    return [{ label: run.prefix + "largest pocket force [N]", time: run.time, values, colour: runs.length > 1 ? run.colour : SERIES_COLOURS.cage }];
  });
  const missing = runs
    .filter((run) => !largestOverBalls(run, "pocket_force"))
    .map((run) => notInThisRun("this run has no cage pocket forces (only the planar fidelity with pocket contact gives them)", run));
  const plot = series.length ? timePlot({ series, label: "force [N]", ticks: runs, height: 190 }) : null;
  return figure("Cage pockets", plot ? runs.every(isSpinUp) ? "Largest force between a ball and its cage pocket." : "Largest force between a ball and its cage pocket; pocket impacts are what makes late details of a drop irreproducible." : null, plot, missing);
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
