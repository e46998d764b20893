// The pictures of a torque computation: moments over speed, acceleration and load, laws and lubricants side by side.
// Nothing depends on time here, so these pictures have axes of their own and are drawn as SVG.

const LINE_COLOURS = ["#1f5fa8", "#c2571a", "#2f8f5b", "#8a4fae", "#8a7410", "#b0306a"];
const ZERO_CELSIUS = 273.15;

// A column over speed; columnOf asks for a time that there is not.
function overSpeed(run, name, scale = 1) {
  const column = run.columns.get(name);
  return column && column.values.some(isNumber) ? column.values.map((value) => (value === null ? null : value * scale)) : null;
}

function listOf(run, name) {
  return list(quantityOf(run, name).value).filter(isNumber);
}

// A plain table: heads, then rows of texts; the first column is a name.
function plainTable(heads, rows) {
  const row = (cells) => element("tr", {}, cells.map((cell) => element("td", {}, cell)));
  return element("div", { class: "wide" }, tableOfRows("numbers torque", heads, rows.map(row)));
}

// Results of a figure, a row each: its words for them and what they say.
function factTable(entries) {
  return plainTable(["", ""], entries.map((entry) => [entry.words, cellOf(entry)]));
}

function millimetres(value) {
  return isNumber(value) ? numberText(1e3 * value, 4) : "–";
}

function accelerationText(value) {
  return `${numberText(value, 6)} rad/s²`;
}

function shareOfRun(run, runs, title) {
  return runs.length > 1 ? `${run.short}: ${title}` : title;
}

// Where the tables hold that vary one thing.
function torquePlace(run) {
  const said = { "rad/s": (value) => speedText(value), N: (value) => engineeringText(value, "N", 4), degC: (value) => `${numberText(value - ZERO_CELSIUS, 4)} °C`, "mm^2/s": (value) => engineeringText(value, "m^2/s", 4) };
  return shownIn(run, "place").filter(({ value }) => value !== null).map(({ words, value }) => said[words](value)).join(", ");
}

// Speed and load of the tables.
function speedAndLoad(run) {
  return shownIn(run, "place").slice(0, 2).map(({ value }) => value);
}

// Accelerations, or loads, and the moments at each of them in N mm.
function momentRows(run, figure, first, before = []) {
  const [given, ...moments] = shownIn(run, figure);
  return list(given && given.quantity.value).map((at, row) => [first(at), ...before, ...moments.map(({ quantity }) => millimetres(quantity.value[row]))]);
}

// The two parts of the moment, as the law calls them: symbol and what makes it.
function momentParts(run) {
  const skf = String((inputOf(run, "bearing.moment.law") || {}).value) === "skf";
  return skf ? [["M_rr", "rolling"], ["M_sl", "sliding"]] : [["M0", "by the flow of the lubricant"], ["M1", "by the load"]];
}

// Accelerations that nobody asked for are examples.
function accelerationsAsked(run) {
  return ["given", "assumed"].includes((inputOf(run, "torque.accelerations") || {}).mark);
}

// The steady moment and its parts over speed.
function steadyPartsFigure(run, runs) {
  const speed = overSpeed(run, "speed");
  const [[m0, flow], [m1, load]] = momentParts(run);
  const part = (name, label, colour, dash) => ({ label, x: speed, y: overSpeed(run, name, 1e3) || [], colour, dash });
  const series = [
    { ...part("friction.moment", "M", INK), width: 2.25 },
    part("friction.speed_dependent", `${m0}, ${flow}`, LINE_COLOURS[0], "7 4"),
    part("friction.load_dependent", `${m1}, ${load}`, LINE_COLOURS[1], "7 4"),
  ];
  const [at, under] = speedAndLoad(run);
  return figure(shareOfRun(run, runs, "Steady friction moment and its parts"), `Under ${engineeringText(under, "N", 4)}.`, curves({ series, across: "speed of the inner race [rad/s]", above: IN_RPM, upright: "moment [N mm]", marks: at === null ? [] : [{ at, words: "tables" }], height: 320 }));
}

function accelerationFigures(run, runs) {
  const speed = overSpeed(run, "speed");
  const accelerations = tableOf(run, "by_acceleration")("acceleration");
  const part = (number, name) => overSpeed(run, `acceleration_${number}.${name}`, 1e3);
  const each = (name, label, dash) =>
    accelerations.map((acceleration, index) => ({ label: `${label} at ${accelerationText(acceleration)}`, x: speed, y: part(index + 1, name) || [], colour: LINE_COLOURS[index % LINE_COLOURS.length], dash }));
  const friction = { label: "steady friction M", x: speed, y: overSpeed(run, "friction.moment", 1e3) || [], colour: "#8995a0", dash: "2 3", width: 2.5 };
  const axes = { across: "speed of the inner race [rad/s]", above: IN_RPM, upright: "moment [N mm]" };
  const middle = accelerations.length - 1;
  const [[first, flow], [second, load]] = momentParts(run);
  const parts = [
    { label: `${first}, ${flow}`, x: speed, y: overSpeed(run, "friction.speed_dependent", 1e3) || [], colour: LINE_COLOURS[0] },
    { label: `${second}, ${load}`, x: speed, y: overSpeed(run, "friction.load_dependent", 1e3) || [], colour: LINE_COLOURS[1] },
    { label: `inertia at the inner race at ${accelerationText(accelerations[middle])}`, x: speed, y: part(middle + 1, "inner_race.inertia") || [], colour: LINE_COLOURS[2] },
    { label: "inertia at the outer race", x: speed, y: part(middle + 1, "outer_race.inertia") || [], colour: LINE_COLOURS[3] },
    { label: "pocket friction F at both races", x: speed, y: part(middle + 1, "loss") || [], colour: LINE_COLOURS[4], dash: "7 4" },
  ];
  const [m0, m1] = shownIn(run, "parts").map(({ value }) => millimetres(value));
  const heads = ["acceleration", ...[first, second, ...shownIn(run, "by_acceleration").slice(1).map(({ words }) => words)].map((words) => `${words} [N mm]`)];
  const rows = momentRows(run, "by_acceleration", accelerationText, [m0, m1]);
  return [
    figure(
      shareOfRun(run, runs, "Moments on both races while the race is brought to speed"),
      "Full lines: t_I, which resists the inner race. Dashed: t_O, which a torque arm on the outer race measures. In a steady run both equal the friction M; while the race speeds up the inertia of balls and cage adds to t_I and takes from t_O.",
      curves({ series: [...each("inner_race.moment", "t_I"), ...each("outer_race.moment", "t_O", "7 4"), friction], ...axes, height: 380 }),
    ),
    figure(shareOfRun(run, runs, "The parts of these moments"), `t_I = ${first} + ${second} + inertia at the inner race + pocket friction; t_O likewise with the inertia at the outer race.`, curves({ series: parts, ...axes, height: 280 })),
    figure(shareOfRun(run, runs, `At ${torquePlace(run)}`), null, plainTable(heads, rows)),
  ];
}

function torqueMomentSection(runs) {
  const examples = (run) => element("details", {}, element("summary", {}, `${run.prefix}While the race speeds up: examples, no acceleration was asked for (torque.accelerations)`), accelerationFigures(run, runs));
  return section("torque", "Moments over speed and acceleration", runs.map((run) => [steadyPartsFigure(run, runs), accelerationsAsked(run) ? accelerationFigures(run, runs) : examples(run)]));
}

function loadFigures(run, runs) {
  const speed = overSpeed(run, "speed");
  const loads = tableOf(run, "by_load")("load");
  const series = loads.map((load, index) => ({ label: engineeringText(load, "N", 4), x: speed, y: overSpeed(run, `load_${index + 1}.friction.moment`, 1e3) || [], colour: LINE_COLOURS[index % LINE_COLOURS.length] }));
  const rows = momentRows(run, "by_load", (load) => engineeringText(load, "N", 4));
  return [
    figure(shareOfRun(run, runs, "Steady friction M under each radial load"), null, curves({ series, across: "speed of the inner race [rad/s]", above: IN_RPM, upright: "moment [N mm]" })),
    figure(shareOfRun(run, runs, `At ${speedText(speedAndLoad(run)[0])}`), null, plainTable(["radial load", `${momentParts(run)[1][0]} [N mm]`, "M [N mm]"], rows)),
  ];
}

function torqueLoadSection(runs) {
  return section("loads", "Radial load", runs.map((run) => loadFigures(run, runs)));
}

// The laws of a comparison, in its order: words, beginning of their columns, and the moments M0, M1 and M of each.
function comparedLaws(run) {
  const all = shownIn(run, "by_law");
  return [...new Set(all.map(({ words }) => words))].map((words) => ({ words, name: `law_${words.replace(/ /g, "_")}`, moments: all.filter((entry) => entry.words === words) }));
}

function lawFigures(run, runs) {
  const speed = overSpeed(run, "speed");
  const laws = comparedLaws(run);
  const known = laws.filter(({ name }) => overSpeed(run, `${name}.friction.moment`));
  // Palmgren's two forms differ by less than a line: dashes let both be seen.
  const dashes = [null, "7 4", null, "2 3"];
  const series = known.map(({ name, words }, index) => ({ label: words, x: speed, y: overSpeed(run, `${name}.friction.moment`, 1e3), colour: LINE_COLOURS[index % LINE_COLOURS.length], dash: dashes[index % dashes.length], width: index % 2 ? 2.5 : 1.75 }));
  const rows = laws.map(({ words, moments }) => {
    const { why } = moments.at(-1).quantity;
    return [words, ...moments.map(({ value }) => millimetres(value)), why ? element("span", { class: "absent" }, why) : ""];
  });
  return [
    figure(shareOfRun(run, runs, "Steady friction M by several laws"), "The same bearing, load and lubricant.", series.length ? curves({ series, across: "speed of the inner race [rad/s]", above: IN_RPM, upright: "moment [N mm]" }) : notInThisRun("a law that has constants for this bearing", run)),
    figure(shareOfRun(run, runs, `At ${torquePlace(run)}`), null, plainTable(["law", "M0, or M_rr of SKF [N mm]", "M1, or M_sl of SKF [N mm]", "M [N mm]", ""], rows)),
  ];
}

function torqueLawSection(runs) {
  return section("laws", "Laws of the friction moment", runs.map((run) => lawFigures(run, runs)));
}

function lubricantsOf(run) {
  const numbers = Object.keys(run.quantities).map((name) => /^lubricant_(\d+)$/.exec(name)).filter(Boolean);
  return numbers.map(([name], index) => ({ name, words: String(quantityOf(run, name).value), colour: LINE_COLOURS[index % LINE_COLOURS.length] }));
}

function lubricantFigures(run, runs) {
  const lubricants = lubricantsOf(run);
  const over = (end, scale) => lubricants.filter(({ name }) => listOf(run, `${name}_temperatures`).length).map(({ name, words, colour }) => ({ label: words, colour, dots: true, x: listOf(run, `${name}_temperatures`).map((kelvin) => kelvin - ZERO_CELSIUS), y: listOf(run, `${name}_${end}`).map((value) => scale * value) }));
  const across = "temperature of the lubricant [°C]";
  const moments = over("friction_moments", 1e3);
  const speed = overSpeed(run, "speed");
  const running = lubricants.filter(({ name }) => overSpeed(run, `${name}.friction.moment`)).map(({ name, words, colour }) => ({ label: words, colour, x: speed, y: overSpeed(run, `${name}.friction.moment`, 1e3) }));
  const temperatures = [...new Set(lubricants.flatMap(({ name }) => listOf(run, `${name}_temperatures`)))].sort((one, other) => one - other);
  const cell = (name, temperature) => {
    const row = listOf(run, `${name}_temperatures`).indexOf(temperature);
    return row < 0 ? "–" : millimetres(listOf(run, `${name}_friction_moments`)[row]);
  };
  const rows = lubricants.map(({ name, words }) => {
    const viscosity = numberOf(run, `${name}_viscosity`);
    const why = quantityOf(run, `${name}_friction_moment`).why;
    return [words, viscosity === null ? element("span", { class: "absent" }, why || "–") : numberText(1e6 * viscosity, 4), millimetres(numberOf(run, `${name}_friction_moment`)), ...temperatures.map((temperature) => cell(name, temperature))];
  });
  const heads = ["lubricant", "ν, running [mm²/s]", "M, running [N mm]", ...temperatures.map((temperature) => `${numberText(temperature - ZERO_CELSIUS, 4)} °C`)];
  const [turning, under] = speedAndLoad(run);
  const at = `at ${speedText(turning)} under ${engineeringText(under, "N", 4)}`;
  return [
    moments.length ? figure(shareOfRun(run, runs, "Steady friction M over temperature, " + at), "Each lubricant where its viscosity is known.", curves({ series: moments, across, upright: "moment [N mm]" })) : null,
    moments.length ? figure(shareOfRun(run, runs, "Viscosity over temperature"), "A straight line in the axes of ASTM D341 through two points.", curves({ series: over("viscosities", 1e6), across, upright: "viscosity [mm²/s]", logarithmic: true, height: 240 })) : null,
    running.length ? figure(shareOfRun(run, runs, "Steady friction M over speed, at the running temperature"), null, curves({ series: running, across: "speed of the inner race [rad/s]", above: IN_RPM, upright: "moment [N mm]" })) : null,
    figure(shareOfRun(run, runs, "M [N mm] by lubricant and temperature, " + at), null, plainTable(heads, rows)),
  ];
}

function torqueLubricantSection(runs) {
  return section("lubricants", "Lubricants", runs.map((run) => lubricantFigures(run, runs)));
}

// The verdict of a torque computation; accelerations that nobody asked for are examples, and no headline.
function torqueVerdict(run) {
  const accelerations = tableOf(run, "by_acceleration")("acceleration");
  const fastest = accelerations.reduce((best, value, row) => (Math.abs(value) > Math.abs(accelerations[best]) ? row : best), 0);
  const [m0, m1, whole] = shownIn(run, "parts").map(({ value }) => value);
  const [[first, flow], [second, load]] = momentParts(run);
  const share = (part) => (part === null || !(whole > 0) ? null : `${percentText(part / whole, 3)} of M`);
  const [, inner, outer, , onInner, onOuter] = shownIn(run, "by_acceleration").map(({ quantity }) => engineeringText(list(quantity.value)[fastest], "N m", 4));
  const accelerated = (title, moment, inertia) => tile(title, moment, [`at ${accelerationText(accelerations[fastest])}; ${inertia} of it inertia`]);
  return element(
    "div",
    { class: "tiles" },
    stateTile(run),
    tile("Friction M", engineeringText(whole, "N m", 4), [`at ${torquePlace(run)}`]),
    tile(`${first}, ${flow}`, engineeringText(m0, "N m", 4), [share(m0)]),
    tile(`${second}, ${load}`, engineeringText(m1, "N m", 4), [share(m1)]),
    accelerationsAsked(run) ? [accelerated("Inner race t_I", onInner, inner), accelerated("Outer race t_O", onOuter, outer)] : null,
  );
}

// Which bearing, under which law, in one line.
function torqueLine(run) {
  const given = (path) => {
    const input = inputOf(run, path);
    return input && String(input.value) !== "not given" ? inputText(input.value) : null;
  };
  const law = given("bearing.moment.law");
  const loss = given("bearing.acceleration_loss.kind");
  const facts = [
    given("bearing.name") || "bearing without a name",
    law && (law === "none" ? "no friction moment" : `friction moment: ${law}`),
    given("bearing.moment.lubrication"),
    loss && (loss === "none" ? "no pocket friction F" : `pocket friction F: ${loss}`),
  ].filter(Boolean);
  return element("p", { class: "machine" }, facts.join(" · "));
}

register("torque", {
  line: torqueLine,
  verdict: torqueVerdict,
  time: null,
  facts: false,
  sections: (runs) => {
    const some = (known) => runs.filter((run) => known(run).length);
    return [[20, torqueMomentSection, runs], [21, torqueLoadSection, runs.filter((run) => tableOf(run, "by_load")("load").length > 1)], [22, torqueLawSection, some(comparedLaws)], [23, torqueLubricantSection, some(lubricantsOf)]].filter(([, , part]) => part.length);
  },
});
