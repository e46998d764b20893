// The pictures of a spin-up: moments, slip and loads, and the energy as estimated from the outer race.

function isSpinUp(run) {
  return run.summary.system === "spin_up";
}

// The share of a turn of speed at the start below which a slip is a quotient of two small numbers.
const SLIP_SPEED_SHARE = 0.01;

// The cage slip in percent, without the rows of the very start.
function slipLine(run, runs) {
  const slip = columnOf(run, "bearing.cage.slip");
  const speed = columnOf(run, "bearing.inner_race.speed");
  if (!slip || !speed || !largestOverBalls(run, "inner_slip")) return [];
  const most = speed.reduce((largest, value) => Math.max(largest, Math.abs(value || 0)), 0);
  const values = slip.map((value, row) => (isNumber(value) && Math.abs(speed[row] || 0) > SLIP_SPEED_SHARE * most ? 100 * value : null));
  return [{ label: run.prefix + "cage slip [%]", time: run.time, values, colour: runs.length > 1 ? run.colour : SERIES_COLOURS.cage, width: 1.5 }];
}

function momentSection(runs) {
  const several = runs.length > 1;
  const milli = 1e3;
  const names = ["bearing.inner_race.resisting_moment", "bearing.outer_race.moment"];
  const moment = (name, label, look) => lines(runs, name, milli, { label: label + " [N mm]", ...look });
  const byLaw = (run) => quantityOf(run, "law_moment_at_end");
  const law = runs.some((run) => isNumber(byLaw(run).value))
    ? moment("bearing.steady_moment", "friction moment M of the law", { colour: SERIES_COLOURS.limit, width: 1.5, dash: [7, 4] })
    : [];
  const drive = moment("drive.moment", "drive", { colour: SERIES_COLOURS.quiet, width: 1, dash: several ? [2, 3] : undefined });
  const noLaw = runs
    .filter((run) => !isNumber(byLaw(run).value))
    .map((run) => notInThisRun("a friction moment, because " + (byLaw(run).why || "none is given"), run));
  return section(
    "moments",
    "Moments on the races",
    history(
      "Moment on the inner race t_I, on the outer race t_O, and the friction moment M",
      "t_I resists the inner race; t_O is what a torque arm on the outer race measures. In a steady run without skidding both equal M. While the race speeds up t_I also accelerates balls and cage; balls that skid pass on no more than traction allows.",
      runs,
      names,
      [
        ...moment(names[0], "t_I inner race", { colour: SERIES_COLOURS.race, width: 1.25 }),
        ...moment(names[1], "t_O outer race", { colour: SERIES_COLOURS.rotor, width: 1.25, dash: several ? [9, 3, 2, 3] : undefined }),
        ...law,
      ],
      { label: "moment [N mm]", height: 310 },
    ),
    noLaw,
    history("Moment of the drive", "What the sliding rotor, the given torque or the given speed puts on the inner race.", runs, ["drive.moment"], drive, { label: "moment [N mm]", height: 170 }),
  );
}

function largestLine(runs, part, label, look) {
  return runs.flatMap((run) => {
    const values = largestOverBalls(run, part);
    return values ? [{ ...look, label: run.prefix + label, time: run.time, values, colour: runs.length > 1 ? run.colour : look.colour }] : [];
  });
}

// Whether and when the balls skid.
function ballsSkid(run) {
  return quantityOf(run, "balls_skid");
}

function slipSection(runs) {
  const slip = runs.flatMap((run) => slipLine(run, runs));
  const words = runs.filter((run) => typeof ballsSkid(run).value === "string").map((run) => `${run.prefix}Balls skid: ${ballsSkid(run).value}.`);
  const sliding = [
    ...largestLine(runs, "inner_slip", "inner race [m/s]", { colour: SERIES_COLOURS.race }),
    ...largestLine(runs, "outer_slip", "outer race [m/s]", { colour: SERIES_COLOURS.rotor, dash: runs.length > 1 ? [4, 3] : undefined }),
  ];
  const still = () => runs.filter((run) => !largestOverBalls(run, "inner_slip")).map((run) => notInThisRun("slip: the rolling fidelity takes the balls to roll", run));
  const loads = [
    ...lines(runs, "bearing.inner_race.largest_ball_load", 1, { label: "inner race [N]", colour: SERIES_COLOURS.race }),
    ...lines(runs, "bearing.outer_race.largest_ball_load", 1, { label: "outer race [N]", colour: SERIES_COLOURS.rotor, dash: runs.length > 1 ? [4, 3] : undefined }),
    ...lines(runs, "drive.radial_load", 1, { label: "radial load applied [N]", colour: SERIES_COLOURS.quiet, dash: [7, 4] }),
  ];
  return section(
    "slip",
    "Skidding",
    figure(
      "Slip of the cage",
      slip.length ? ["1 less the cage speed over the speed at which the balls would roll: 100 % at rest, 0 % where they roll.", ...words].join(" ") : null,
      slip.length ? timePlot({ series: slip, label: "slip [%]", include: () => [0], height: 200 }) : null,
      still(),
    ),
    figure("Fastest sliding of any ball", sliding.length ? "Loaded and unloaded balls alike; the maps below separate them." : null, sliding.length ? timePlot({ series: sliding, label: "slip speed [m/s]", height: 190 }) : null, still()),
    history("Largest ball load", "The outer race also carries the centrifugal force of the balls.", runs, ["bearing.inner_race.largest_ball_load"], loads, { label: "load [N]", height: 200 }),
  );
}

function signedBars(entries, colours, reference) {
  const known = entries.map(({ words, value }, index) => ({ words, amount: value, colour: SERIES_COLOURS[colours[index] || "quiet"] }));
  const largest = Math.max(1e-300, ...known.map((form) => Math.abs(form.amount || 0)));
  return known.map(({ words, amount, colour }) => {
    const share = reference ? (amount - reference) / Math.abs(reference) : null;
    const beside = reference === null ? "" : share === 0 ? "" : (share > 0 ? "+" : "") + percentText(share, 3);
    // A negative energy is hatched: a loss that would make energy must not look like one.
    const fill = amount < 0 ? `repeating-linear-gradient(45deg, ${colour} 0 3px, #fff 3px 7px)` : colour;
    const bar = amount === null ? null : element("div", { style: `width:${(100 * Math.abs(amount)) / largest}%;background:${fill}` });
    return element(
      "tr",
      {},
      element("td", { class: "name" }, words),
      element("td", { class: "bar" }, bar),
      element("td", {}, engineeringText(amount, "J", 5)),
      element("td", {}, amount === null ? "–" : beside),
    );
  });
}

function outerRaceFigure(run, runs) {
  const title = (runs.length > 1 ? run.short + ": " : "") + "What the bearing dissipated, as estimated from the moment on the outer race";
  const [forms, terms] = ["outer_race_energy", "path_terms"].map((name) => shownIn(run, name));
  const truth = forms.length ? forms[0].value : null;
  if (truth === null) return figure(title, null, notInThisRun("the summary holds no energy of the outer race"));
  const still = exceeds(run, ballsSkid(run));
  const head = (words, last) => element("tr", { class: "head" }, element("th", { colspan: 3 }, words), element("td", {}, last));
  return figure(
    title,
    "t_O moment on the outer race, Ω speed of the inner race, Ω₀ at the end, L angular momentum of balls and cage, KE + U their energy, s ball over track radius. The corrected form knows nothing of skidding: then the path term is needed, which takes the speed of the cage.",
    element("table", { class: "bars" }, element("tbody", {}, head("Energy dissipated in the bearing", "off the truth"), signedBars(forms, ["cage", "limit", "race", "rotor"], truth)), element("tbody", {}, head("Path term", ""), signedBars(terms, ["rotor"], null))),
    forms.some(({ value }) => value < 0) ? element("p", {}, "Hatched: negative. A bearing cannot dissipate less than nothing; the formula has left its range.") : null,
    still ? element("p", {}, "Here the balls still skid at the end: the corrected and the printed form and both bounds of the path term take them to roll by then.") : null,
  );
}

function outerRaceSection(runs) {
  return section("outer-race", "Energy by the outer race", runs.filter(isSpinUp).map((run) => outerRaceFigure(run, runs)));
}

// The verdict of a spin-up.
function spinUpVerdict(run) {
  return element("div", { class: "tiles" }, stateTile(run), tilesOf(run));
}

// What turns which bearing, in one line.
function spinUpLine(run) {
  const given = (path) => {
    const input = inputOf(run, path);
    return input && String(input.value) !== "not given" ? inputText(input.value).replace("^2", "²") : null;
  };
  const kind = given("drive.kind");
  const drive = {
    "sliding rotor": `rotor at ${given("drive.rotor_speed")}, ${given("drive.rotor_spin")}, sliding with friction coefficient ${given("drive.friction_coefficient")}`,
    torque: `torque ${given("drive.torque") || "over time"}`,
    speed: `speed ${given("drive.final_speed") ? "up to " + given("drive.final_speed") : "over time"}` + (given("drive.acceleration") ? ` at ${given("drive.acceleration")}` : given("drive.final_speed") ? " as a step" : ""),
  }[kind];
  const law = given("bearing.moment.law");
  const facts = [
    given("bearing.name") || "bearing without a name",
    drive,
    `radial load ${given("drive.radial_load") || "over time"}`,
    given("bearing.fidelity") && `${given("bearing.fidelity")} fidelity`,
    law && (law === "none" ? "no friction moment" : `friction moment: ${law}`),
  ].filter(Boolean);
  return element("p", { class: "machine" }, facts.join(" · "));
}

register("spin_up", {
  line: spinUpLine,
  verdict: spinUpVerdict,
  time: "time since the start",
  facts: true,
  sections: (runs) => [[50, speedSection, runs], [55, momentSection, runs], [56, slipSection, runs], [60, mapSection, runs], [61, pressureSection, runs], [70, outerRaceSection, runs], [80, energySection, runs], ...LIMIT_SECTIONS(runs), ...WARM_SECTIONS(runs)].filter(([, , some]) => some.length),
});
