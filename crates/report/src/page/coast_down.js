// The pictures of a coast-down with heat: temperatures with their limits, clearance and ball loads, heat made, taken and stored.

const NODE_COLOURS = { rotor: "#1f5fa8", inner_race: "#c2571a", balls: "#8a4fae", cage: "#2f8f5b", lubricant: "#8a7410", outer_race: "#b0306a", housing: "#5d6b78", rotor_core: "#6d9bd1", mount: "#a8895c" };

// Hours of a long coast-down, minutes of a shorter one, else seconds.
function longTime(run) {
  const last = lastNumber(run.time);
  if (last >= 7200) return { factor: 1 / 3600, words: "time since the start [h]" };
  if (last >= 600) return { factor: 1 / 60, words: "time since the start [min]" };
  return { factor: 1, words: "time since the start [s]" };
}

function overTime(run, name, look, scale = 1, offset = 0) {
  const values = columnOf(run, name);
  if (!values) return [];
  const { factor } = longTime(run);
  return [{ ...look, x: run.time.map((time) => time * factor), y: values.map((value) => (isNumber(value) ? scale * value + offset : value)) }];
}

function nodesOf(run) {
  return Object.keys(NODE_COLOURS).filter((node) => columnOf(run, `${node}.temperature`));
}

function limitMarks(run) {
  const { factor } = longTime(run);
  return instantsOf([run]).map(({ instant, ...mark }) => ({ ...mark, at: instant * factor })).sort((one, other) => one.at - other.at);
}

function temperatureFigures(run, runs) {
  const celsius = (node) => overTime(run, `${node}.temperature`, { label: wordsOf(node), colour: NODE_COLOURS[node] }, 1, -ZERO_CELSIUS);
  const limit = inputOf(run, "heat.race_limit");
  const note = `Bodies of one temperature each, of one bearing with its part of the rotor and its housing. Limits: races ${limit ? inputText(limit.value) : "as given"}; cage and lubricant as given. The rises are right within a factor of two where conductances were not given.`;
  const across = longTime(run).words;
  return [
    figure(shareOfRun(run, runs, "Temperatures"), note, curves({ series: nodesOf(run).flatMap(celsius), across, upright: "temperature [°C]", marks: limitMarks(run), height: 330 })),
    figure(shareOfRun(run, runs, "Speed"), null, curves({ series: overTime(run, "rotor.speed", { colour: SERIES_COLOURS.rotor }), across, upright: "speed [rad/s]", right: { label: "speed [rpm]", factor: RPM }, height: 200 })),
  ];
}

function temperatureSection(runs) {
  return section("temperatures", "Temperatures", runs.map((run) => temperatureFigures(run, runs)));
}

function closingFigures(run, runs) {
  const across = longTime(run).words;
  return [
    figure(shareOfRun(run, runs, "Diametral clearance of the bearing"), "Rings and balls grow with their temperatures; below 0 the balls are preloaded.", curves({ series: overTime(run, "bearing.clearance", { colour: SERIES_COLOURS.race }, 1e6), across, upright: "clearance [µm]", level: { at: 0, words: "closed" }, height: 220 })),
    figure(shareOfRun(run, runs, "Load of the most loaded ball"), null, curves({ series: overTime(run, "bearing.largest_ball_load", { colour: SERIES_COLOURS.rotor }), across, upright: "load [N]", height: 200 })),
    figure(shareOfRun(run, runs, "Rate at which a disturbance of the temperatures grows"), "The speed of that instant held. Above 0 each kelvin makes more heat than it takes away: the bearing runs away.", curves({ series: overTime(run, "heat.growth_rate", { colour: SERIES_COLOURS.cage }), across, upright: "rate [1/s]", level: { at: 0, words: "runs away above" }, height: 200 })),
  ];
}

function closingSection(runs) {
  return section("closing", "Clearance", runs.map((run) => closingFigures(run, runs)));
}

function takenFigure(run, runs, note) {
  const held = tableOf(run, "held")("time");
  const of = lastNumber(held) >= 7200 ? { factor: 1 / 3600, words: "time since the start, held [h]" } : { factor: 1, words: "time since the start, held [s]" };
  const taken = nodesOf(run)
    .map((node) => ({ label: wordsOf(node), colour: NODE_COLOURS[node], x: held.map((time) => time * of.factor), y: listOf(run, `${node}_powers_to_take`) }))
    .filter(({ y }) => y.length);
  const title = shareOfRun(run, runs, "Heat that must be taken away");
  return taken.length ? figure(title, note, curves({ series: taken, across: of.words, upright: "power [W]", height: 240 })) : figure(title, null, notInThisRun("no node reaches its limit", run));
}

function heatFigures(run, runs) {
  const across = longTime(run).words;
  const moments = [
    ["speed_dependent", "M0, by speed and viscosity", HEAT_COLOURS.steady_moment],
    ["load_dependent", numberOf(run, "windows") === null ? "M1, by load" : "M1, by load, and all that slides", HEAT_COLOURS.ball_slip],
    ["windage", "gas, brake", SERIES_COLOURS.quiet],
  ];
  const spent = moments.flatMap(([name, label, colour]) => (name === "windage" && !numberOf(run, "windage_heat") ? [] : overTime(run, `${name}.moment`, { label, colour }, 1e3)));
  return [
    figure(shareOfRun(run, runs, "Heat made in all bearings"), null, curves({ series: overTime(run, "heat.power", { colour: SERIES_COLOURS.race }), across, upright: "power [W]", height: 220 })),
    figure(shareOfRun(run, runs, "Moments that brake"), "Of all bearings.", curves({ series: spent, across, upright: "moment [N mm]", height: 220 })),
    takenFigure(run, runs, "To hold every node at its limit from the moment it gets there, all bearings together: what a coolant must take from the node itself."),
    heatFlowFigure(run, runs, "All equal bearings together; what the gas takes leaves with it."),
  ];
}

function warmthSection(runs) {
  return section("heat", "Heat", runs.map((run) => heatFigures(run, runs)));
}

function hottest(run) {
  const peaks = nodesOf(run).map((node) => ({ node, peak: numberOf(run, `peak_${node}_temperature`) })).filter(({ peak }) => peak !== null);
  return peaks.sort((one, other) => other.peak - one.peak)[0];
}

function coastDownVerdict(run) {
  const most = hottest(run);
  const passed = nodesOf(run).filter((node) => numberOf(run, `${node}_limit_time`) !== null);
  const clearance = numberOf(run, "smallest_clearance");
  const growth = numberOf(run, "peak_growth_rate");
  return element(
    "div",
    { class: "tiles" },
    stateTile(run),
    tilesOf(run, "machine_tile"),
    most ? tile("Hottest", `${numberText(most.peak - ZERO_CELSIUS, 3)} °C`, [wordsOf(most.node), passed.length ? `limit passed: ${passed.map(wordsOf).join(", ")}` : "every node below its limit"], verdictState(run, passed.length > 0)) : null,
    tile("Smallest clearance", engineeringText(clearance, "m", 3), [growth > 0 && clearance < 0 ? "runs away" : clearance < 0 ? "preloaded by warmth" : "open"], growth <= 0 && clearance < 0 ? null : verdictState(run, clearance < 0)),
    tilesOf(run),
  );
}

function coastDownLine(run) {
  const given = (path) => {
    const input = inputOf(run, path);
    return input && String(input.value) !== "not given" ? inputText(input.value).replace("^2", "²") : null;
  };
  // of bearings with names each has its own
  const named = list(run.summary.inputs).map(({ path }) => /^auxiliary_bearing\.[^.]+\.(?=planes$)/.exec(path)?.[0]).filter(Boolean);
  const parts = named.length ? named : [""];
  const rows = (part) => Number(given("rotor.planes") || 1) * Number(given(`${part}planes`) || 1);
  const bearings = parts.map((part) => `${rows(part)} × ${given(`${part}bearing.name`) || "bearing without a name"}`);
  const ofFirst = (path) => given(path) || given(parts[0] + path);
  const facts = [`rotor ${given("rotor.mass")}, ${given("rotor.polar_inertia")}`, `from ${given("rotor.speed")}`, bearings.join(", "), ofFirst("heat.atmosphere") && `in ${ofFirst("heat.atmosphere")}`, ofFirst("heat.feedback") && `follows: ${ofFirst("heat.feedback")}`];
  return element("p", { class: "machine" }, facts.filter(Boolean).join(" · "));
}

// The coast-down that followed a drop, as a run of its own with its own times; null where there is none.
function coastDownOf(run) {
  const own = Object.entries(run.quantities).filter(([name]) => name.startsWith(COAST_DOWN));
  const quantities = Object.fromEntries(own.map(([name, quantity]) => [name.slice(COAST_DOWN.length), quantity]));
  const course = "over_time.";
  const lists = Object.entries(quantities).filter(([name, { value }]) => name.startsWith(course) && Array.isArray(value) && value.length);
  const columns = new Map(lists.map(([name, { value, unit }]) => [name.slice(course.length), { name: name.slice(course.length), unit, values: value }]));
  return columns.has("time") ? { ...run, quantities, columns, time: columns.get("time").values } : null;
}

function asksForCoastDown(run) {
  return Object.keys(run.quantities).some((name) => name.startsWith(COAST_DOWN));
}

function coastDownFigures(run, runs) {
  const slow = coastDownOf(run);
  const way = element("p", {}, run.prefix ? run.letter + ": " : null, (run.summary.stop || {}).text || "");
  if (!slow) {
    const absent = Object.entries(run.quantities).find(([name, { why }]) => name.startsWith(COAST_DOWN) && why);
    return [notInThisRun(absent ? absent[1].why : "there is no coast-down", run)];
  }
  return [way, ...temperatureFigures(slow, runs), ...closingFigures(slow, runs), ...heatFigures(slow, runs)];
}

function coastDownSection(runs) {
  const lead = element("p", { class: "lead" }, "Until it stands: ball-by-ball intervals of the motion, and quasi-steady steps between them. Times count from the release.");
  return section("coast-down", "Coast-down until standstill", lead, runs.map((run) => coastDownFigures(run, runs)));
}

// How warm the bodies of a bearing become while it is computed ball by ball or rolling.
function warmingSection(runs) {
  const note = "To hold every node of a bearing at its limit from the moment it gets there, by the heats of this run: what a coolant must take from the node itself.";
  const figures = (run) => [
    temperatureFigures(run, runs)[0],
    columnOf(run, "bearing.clearance") ? closingFigures(run, runs)[0] : null,
    columnOf(run, "heat.growth_rate") ? closingFigures(run, runs)[2] : null,
    takenFigure(run, runs, note),
    heatFlowFigure(run, runs, "Of one bearing."),
  ];
  return section("warming", "Temperatures during the run", runs.map(figures));
}

const WARM_SECTIONS = (runs) => [[82, warmingSection, runs.filter((run) => nodesOf(run).length)], [83, coastDownSection, runs.filter(asksForCoastDown)]];

register("coast_down", {
  line: coastDownLine,
  verdict: coastDownVerdict,
  time: null,
  facts: false,
  sections: (runs) => [[20, temperatureSection, runs], [21, closingSection, runs], [22, warmthSection, runs], ...LIMIT_SECTIONS(runs)],
});
