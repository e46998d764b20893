// The verdict: what an engineer wants to know before any picture.

// The warning of an energy ledger that misses too much.
const MISSED_BY_THE_LEDGER = "AB1006";

// A value with what it may be off below it: twice the standard deviation.
function bandValue([value, band], unit) {
  const whole = (text) => `${text} ${unit}`.trim();
  return [whole(value), band === null ? null : element("div", { class: "tile-band" }, `± ${whole(band)} (2σ)`)];
}

const NOT_IN_THIS_RUN = "not in this run";

// state: "good" or "bad" where there is a criterion, else nothing.
function tile(title, value, notes, state) {
  return element(
    "div",
    { class: state ? "tile " + state : "tile" },
    element("div", { class: "tile-title" }, title),
    element("div", { class: "tile-value" }, value),
    list(notes).flat().filter(Boolean).map((note) => element("div", { class: "tile-note" }, note)),
  );
}

// A run that ended early passes no criterion; it can only fail one.
function verdictState(run, bad) {
  if (bad) return "bad";
  return run.summary.complete === true ? "good" : null;
}

// The unperturbed run is the value; the members of a repeated run stand below it.
function meanNote(quantity) {
  const spread = quantity.spread;
  return spread && isNumber(spread.mean) ? `mean ${spreadText(quantity).mean} of ${spread.members}` : null;
}

// The worst of all members by a measure of their values; of a single run its own.
function worstOf(quantity, measure) {
  const { min, max } = quantity.spread || {};
  return Math.max(...[quantity.value, min, max].filter(isNumber).map(measure));
}

function quantityTile(run, title, name, note, state) {
  const quantity = quantityOf(run, name);
  if (!isNumber(quantity.value)) return tile(title, "–", ["not in this run: " + (quantity.why || "no reason given")]);
  const deviation = numberOf(run, name + "_deviation");
  const shown = () => {
    const [unit, scale] = readableUnit(Math.max(Math.abs(quantity.value), BAND * deviation), quantity.unit);
    return bandValue(bandParts(quantity.value / scale, (BAND * deviation) / scale), unit);
  };
  const radians = quantity.unit === "rad/s" ? `${numberText(quantity.value, 4)} rad/s` : null;
  return tile(title, deviation === null ? engineeringText(quantity.value, quantity.unit, 4) : shown(), [radians, meanNote(quantity), note && note(quantity.value)], state && state(quantity.value));
}

function stateTile(run) {
  const stop = run.summary.stop || {};
  const complete = run.summary.complete === true;
  // a rotor that still turns
  const word = stop.reason === "finished" && complete ? "complete" : stop.reason;
  const time = isNumber(stop.time_s) && systemOf(run).facts ? engineeringText(stop.time_s, "s", 4) : "";
  const reason = stop.text || stop.reason || run.summaryProblem || "the summary does not say";
  // how a run-out went stands with its pictures
  const last = reason.split(/(?<=\.) (?=[A-Z])/).at(-1);
  return tile("Run", complete ? word : "not complete", [[time, complete ? last : reason].filter(Boolean).join(": ")], verdictState(run, word !== "complete"));
}

function forceNote(run) {
  const peak = peakContact(run);
  const count = numberOf(run, "contact_count");
  const parts = [peak && `${engineeringText(peak.peak_time_s - releaseOf(run), "s", 4)} after ${countedFrom(run)}`, isNumber(count) && count + (count === 1 ? " contact" : " contacts")];
  return parts.filter(Boolean);
}

function pressureNote(run, pressure) {
  const limit = run.summary.hertz_pressure_limit_Pa;
  if (!isNumber(limit)) return "no limit is given for these balls";
  const where = pressure <= limit ? "below" : "ABOVE";
  const races = `${where} the limit of ${engineeringText(limit, "Pa", 4)}: ${percentText(pressure / limit)} of it`;
  const neighbours = numberOf(run, "peak_ball_ball_pressure");
  if (neighbours === null) return races;
  const share = numberOf(run, "hertz_pressure_share_of_limit");
  const apart = share > pressure / limit ? `, ${percentText(share)} of their limit` : "";
  return [races, `between balls ${engineeringText(neighbours, "Pa", 4)}${apart}`];
}

function spinUpNote(run) {
  const half = numberOf(run, "inner_race_time_to_50_percent");
  return [half === null ? null : "50 % at " + engineeringText(half, "s", 4), "after the release"];
}

// Unbalance angles of the members of a run: it decides whether friction starts backward whirl.
function unbalanceAngles(run) {
  const members = run.summary.members_total || list(run.summary.members).length || 1;
  const varied = new Set(list(run.summary.drawn).map((draws) => (draws || {})["rotor.unbalance_angle"]));
  const random = String((inputOf(run, "repeat.unbalance_angle") || {}).value).includes("random");
  return random ? members : Math.max(1, varied.size);
}

const ANGLES_FOR_WHIRL = 8;

// Why a run in which no rotor whirled does not say that none will; none where it does.
function whirlNotSought(run) {
  const angles = unbalanceAngles(run);
  const few = angles < ANGLES_FOR_WHIRL ? `none seen from ${angles} unbalance ${angles === 1 ? "angle" : "angles"}; ${ANGLES_FOR_WHIRL} at least are needed (--repeat ${ANGLES_FOR_WHIRL})` : null;
  const { value, spread } = quantityOf(run, "inner_race_time_to_95_percent");
  const slips = "inner_race_time_to_95_percent" in run.quantities && (spread ? spread.members < (run.summary.members_total || list(run.summary.members).length) : !isNumber(value));
  return [few, slips ? "ends before the inner race reaches 95 % of the speed" : null].filter(Boolean);
}

function whirlTile(run) {
  const quantity = quantityOf(run, "whirl_direction");
  if (typeof quantity.value !== "string") return tile("Whirl", "–", ["not in this run: " + (quantity.why || "no reason given")]);
  const turns = quantityOf(run, "whirl_turns");
  const spin = Math.sign(numberOf(run, "rotor_final_speed")) || 1;
  const sense = turns.value * spin < 0 ? "backward" : "forward";
  const count = isNumber(turns.value) ? `${numberText(Math.abs(turns.value), 3)} net turns, ${sense}, in the inner race` : null;
  const back = worstOf(turns, (value) => -value * spin);
  const bad = quantity.value === "backward" || back >= 1;
  const unknown = bad ? [] : whirlNotSought(run);
  const rule = quantity.value === "none" && !unknown.length && !bad ? "below one turn there is no whirl" : null;
  const mean = meanNote(turns);
  const others = quantity.value !== "backward" && back >= 1 ? `BACKWARD in other members: ${numberText(back, 3)} turns in the worst` : null;
  const shown = unknown.length && quantity.value === "none" ? NOT_IN_THIS_RUN : others ? "backward" : quantity.value;
  return tile("Whirl", shown, [others, unknown, count, rule, mean && `${mean} members; counter-clockwise is positive`], unknown.length ? null : verdictState(run, bad));
}

function displacementTile(run) {
  if (!("max_rotor_displacement" in run.quantities)) return null;
  const clearance = run.summary.clearance_radius_m;
  const beside = isNumber(clearance) ? `clearance ${engineeringText(clearance, "m", 4)}` : null;
  return quantityTile(run, "Largest rotor displacement", "max_rotor_displacement", () => ["of its centre from the line of levitation", beside]);
}

// From when on the rotor rolls, and what comes again after that.
function rollingNote(run) {
  const start = numberOf(run, "run_out.start_time");
  if (start === null) return "it never loses only what laws of rolling say";
  const again = listOf(run, "run_out.return_end_times");
  const rolls = "rolls from " + engineeringText(start, "s", 3) + " on";
  if (!again.length) return rolls;
  const stretches = again.length === 1 ? "a stretch" : `${again.length} stretches`;
  return `${rolls}, but for ${stretches} ball by ball until ${engineeringText(lastNumber(again), "s", 3)}`;
}

// The largest share of the limit in the run-out of any bearing: its index is the cube of it.
function shareInRunOut(run) {
  const names = Object.keys(run.quantities).filter((name) => name.endsWith("run_out.indentation_index"));
  return Math.cbrt(Math.max(0, ...names.map((name) => numberOf(run, name)).filter(isNumber)));
}

// Each pressure counts by the limit of what touches there; the share is the largest.
function pressureTile(run) {
  const share = numberOf(run, "hertz_pressure_share_of_limit");
  const worst = worstOf(quantityOf(run, "hertz_pressure_share_of_limit"), (value) => value);
  const later = shareInRunOut(run);
  const bad = worst > 1 || later > 1;
  const untouched = !bad && numberOf(run, "contact_count") === 0;
  const state = share === null || untouched ? null : verdictState(run, bad);
  const others = [worst > share ? `in the worst member ${percentText(worst)} of the limit` : null, later > share ? `in the run-out ${percentText(later)} of the limit` : null, untouched ? "the rotor touched nothing in this run" : null].filter(Boolean);
  return quantityTile(run, "Peak Hertz pressure", "peak_hertz_pressure", (pressure) => [pressureNote(run, pressure), others].flat(), () => state);
}

// Distances left along the shaft between it and seals, sensors and magnets, the smallest first; less than none where it rubs.
function distancesOf(run) {
  const [at, sizes, shape, gone] = ["clearance_positions", "clearances", "shape_positions", "largest_displacements"].map((name) => listAt(run, name));
  const all = wordsAt(run, "clearance_names").map((name, k) => ({ name, clearance: sizes[k], displacement: gone[shape.indexOf(at[k])] }));
  return all.filter((place) => isNumber(place.clearance) && isNumber(place.displacement)).sort((one, other) => one.clearance - one.displacement - other.clearance + other.displacement);
}

const RUB = "AB2030";

function warningsOf(run, code) {
  return list(run.summary.warnings).filter((warning) => warning && warning.code === code);
}

function distanceTile(run) {
  if (run.summary.system !== "machine") return null;
  const [least] = distancesOf(run);
  const rubs = warningsOf(run, RUB);
  const whose = list(run.summary.members).length > 1 ? " in the unperturbed run" : "";
  const distance = least ? `least distance${whose} ${engineeringText(least.clearance - least.displacement, "m", 3)} at ${wordsOf(least.name)}` : null;
  if (rubs.length) return tile("Clearances along the shaft", `rub: ${rubs.length} ${rubs.length === 1 ? "place" : "places"}`, [distance, `${RUB}: these contacts are not computed`], "bad");
  if (!least) return tile("Clearances along the shaft", NOT_IN_THIS_RUN, ["no seal, sensor or gap of a magnet is given (rotor.node.clearance)"]);
  const magnets = wordsAt(run, "magnet_names");
  const open = [
    distancesOf(run).every(({ name }) => magnets.includes(name)) ? "gaps of magnets alone: no seal or sensor is given (rotor.node.clearance)" : null,
    list(run.summary.members).length > 1 ? "of the unperturbed run alone" : null,
  ].filter(Boolean);
  return tile("Clearances along the shaft", engineeringText(least.clearance - least.displacement, "m", 3), [`least distance, at ${wordsOf(least.name)}`, open], open.length ? null : verdictState(run, false));
}

// What bearing and laws are made for: the warning of each, and its words.
const RANGES = [
  ["AB1015", "above the limiting speed"],
  ["AB2314", "above the limiting speed while coasting down"],
  ["AB1096", "load beyond the axial preload"],
  ["AB1002", "Hertz pressure above its limit"],
  ["AB1070", "pressure between balls above its limit"],
  ["AB1005", "force above the static load rating"],
  ["AB1029", "static load above the rating"],
  ["AB1018", "friction law out of its range"],
  ["AB1031", "traction law of the lubricant out of its range"],
  ["AB1035", "film temperatures beyond their law"],
  ["AB1004", "contact damping out of its range"],
  ["AB1097", "hard stop of the mount hit"],
  ["AB1001", "rotor bends: taken as rigid"],
  ["AB2031", "too few modes for impacts"],
  ["AB2033", "shaft thicker than the bore"],
  ["AB2336", "contact of rotor and race beyond the law of its width"],
  ["AB2301", "contact of rotor and race so hot that steel changes"],
  ["AB1017", "balls must skid"],
];

function rangeTile(run) {
  const beyond = RANGES.filter(([code]) => warningsOf(run, code).length);
  return tile("Bearing and laws", beyond.length ? `${beyond.length} beyond range` : "in range", beyond.map(([code, words]) => `${words} (${code})`), verdictState(run, beyond.length > 0));
}

// A radial model: what acts along the shaft is in no result.
function axialTile(run) {
  const share = numberOf(run, "axial_gravity_share");
  return tile("Axial motion", NOT_IN_THIS_RUN, [share > 0 ? `${percentText(share, 2)} of g acts along the shaft` : null, "thrust, axial clearance and drop onto the faces are not computed"]);
}

// Of a machine once, whatever its bearings are.
function machineTiles(run) {
  return [
    stateTile(run),
    distanceTile(run),
    rangeTile(run),
    axialTile(run),
    asksForRunOut(run) ? quantityTile(run, "Stands after", "run_out.stop_time", () => rollingNote(run)) : null,
    quantityTile(
      run,
      "Energy residual",
      "energy_residual",
      () => "share of the energies that the ledger leaves unexplained",
      () => residualState(run),
    ),
  ];
}

function verdict(run) {
  return element(
    "div",
    { class: "tiles" },
    quantityTile(run, "Peak contact force", "peak_contact_force", () => forceNote(run)),
    pressureTile(run),
    quantityTile(run, "Inner race at 95 % speed", "inner_race_time_to_95_percent", () => spinUpNote(run)),
    whirlTile(run),
    displacementTile(run),
  );
}

// What may be missed depends on the accuracy asked: the run knows.
function residualState(run) {
  return verdictState(run, list(run.summary.warnings).filter(Boolean).some((warning) => warning.code === MISSED_BY_THE_LEDGER));
}

// Rotor, speed, bearing, clearance and friction in one line, as far as the inputs state it.
function machineLine(run) {
  const given = (path) => {
    const input = inputOf(run, path);
    return input && String(input.value) !== "not given" ? inputText(input.value) : null;
  };
  const speed = given("rotor.speed");
  const mass = given("rotor.mass");
  const clearance = given("contact.radial_air_clearance");
  const friction = given("contact.friction_coefficient");
  const fidelity = given("bearing.fidelity");
  const bearing = given("bearing.name") || (inputOf(run, "bearing.ball_count") ? "bearing without a name" : null);
  const planes = given("rotor.planes");
  const assumed = (path) => (inputOf(run, path).mark === "assumed" ? " (assumed)" : "");
  const facts = [
    mass && `rotor ${mass}`,
    speed && (/^0 /.test(speed) ? "from rest" : speed),
    bearing && bearing + (planes && !run.summary.name ? ` × ${planes} ${planes === "1" ? "plane" : "planes"}` : ""),
    clearance && `radial air clearance ${clearance}${assumed("contact.radial_air_clearance")}`,
    friction && `friction coefficient ${friction}${assumed("contact.friction_coefficient")}`,
    fidelity && `${fidelity} fidelity`,
  ].filter(Boolean);
  return facts.length ? element("p", { class: "machine" }, facts.join(" · ")) : null;
}

// Where the spread of a repeated run comes from, or null for a single one.
function spreadOrigin(run) {
  const repeated = Object.values(run.quantities).some((quantity) => quantity && quantity.spread);
  if (!repeated) return null;
  const [position, angle] = ["repeat.rotor_position_deviation", "repeat.ball_angle_deviation"].map((path) => inputOf(run, path));
  const by = [position && inputText(position.value), angle && inputText(angle.value)].filter(Boolean).join(" and ");
  const varied = [...new Set(list(run.summary.drawn).flatMap((draws) => Object.keys(draws || {})))];
  if (varied.length) return `spread of members with sampled ${varied.join(", ")}, and starts perturbed by ${by || "tiny amounts"} (see repeat.*)`;
  return `spread of starts perturbed by ${by || "tiny amounts"} (see repeat.*): shows numerical chaos, not tolerances of the machine`;
}

// How severe a warning is: 0 what destroys, 1 results of another machine, 3 what is left out or assumed; summaries of the first format
// have numbers, or none.
const ASSUMED = "AB1013";
const SEVERITIES = ["destroys", "invalid", "uncertain", "note"];
const OF_FIRST_FORMAT = [1, 2, 3, 3];

function severityRank({ severity, graveness }) {
  return SEVERITIES.includes(severity) ? SEVERITIES.indexOf(severity) : OF_FIRST_FORMAT[graveness] ?? 2;
}

function isSevere(warning) {
  return severityRank(warning) <= 1;
}

// The assumptions on which results hang most, first the most: what sets the speed-up and the first impact before what only forms them.
const TELLING_INPUTS = [
  "contact.friction_coefficient", "bearing.moment.f0", "bearing.moment.viscosity", "identify.viscosity", "contact.radial_air_clearance", "bearing.traction.maximum",
  "mount.damping", "mount.stiffness", "contact.stiffness", "rotor.unbalance_eccentricity", "bearing.operating_diametral_clearance", "bearing.inner_groove_curvature",
  "bearing.outer_groove_curvature", "bearing.cage_mass", "bearing.moment.lubrication", "rig.load.radial_load", "rig.shaft.inertia", "identify.moment_per_kelvin",
];

// The assumed inputs of runs, the most telling first: path, value, note.
function assumedInputs(runs) {
  const found = new Map();
  for (const run of runs) {
    for (const input of list(run.summary.inputs)) if (input && input.mark === "assumed" && !found.has(input.path)) found.set(input.path, input);
  }
  const rank = ({ path }) => {
    const at = TELLING_INPUTS.findIndex((telling) => path.endsWith(telling));
    return at < 0 ? TELLING_INPUTS.length : at;
  };
  return [...found.values()].sort((one, other) => rank(one) - rank(other));
}

const ASSUMED_SHOWN = 3;

function assumedItem(runs) {
  const all = assumedInputs(runs);
  if (!all.length) return null;
  const words = (input) => [element("code", {}, input.path), ` = ${inputText(input.value)}`];
  const shown = all.slice(0, ASSUMED_SHOWN).flatMap((input, index) => [index ? "; " : "", ...words(input)]);
  const rest = all.slice(ASSUMED_SHOWN);
  return element(
    "li",
    {},
    element("code", {}, ASSUMED),
    ` ${all.length} ${all.length === 1 ? "input is" : "inputs are"} assumed, not measured. Most telling: `,
    shown,
    ".",
    rest.length ? element("details", {}, element("summary", {}, `${rest.length} more`), element("p", { class: "small" }, rest.flatMap((input, index) => [index ? "; " : "", ...words(input)]))) : null,
  );
}

// Each warning once, the most severe first; with several runs or bearings it names those that have it.
function warningBox(runs) {
  const found = new Map();
  const add = (run, code, text, warning = {}) => {
    // a text that begins with the name of a bearing says the same of each
    const bearing = list(run.bearingNames).find((name) => text.startsWith(`${name}: `));
    if (bearing && run.summary.name !== bearing) return;
    const plain = bearing ? text.slice(bearing.length + 2) : text;
    // what differs in its numbers alone stands in one entry, with the text of each
    const key = `${code} ${plain.replace(/[\d.,]+/g, "#")}`;
    if (!found.has(key)) found.set(key, { code, severity: warning.severity, graveness: warning.graveness, texts: new Map() });
    const { texts } = found.get(key);
    if (!texts.has(plain)) texts.set(plain, new Set());
    texts.get(plain).add(ofOneRun(runs) ? bearing || "" : run.letter);
  };
  for (const run of runs) {
    if (run.summaryProblem) add(run, "", run.summaryProblem);
    for (const warning of list(run.summary.warnings).filter(Boolean)) if (warning.code !== ASSUMED) add(run, warning.code || "", warning.text || String(warning), warning);
  }
  const assumed = assumedItem(runs);
  if (!found.size && !assumed) return null;
  const who = (names) => {
    const known = [...names].filter(Boolean);
    if (!known.length) return null;
    const letters = !ofOneRun(runs);
    const words = !letters ? known.join(", ") : known.length === runs.length ? "all runs" : (known.length > 1 ? "runs " : "run ") + known.join(", ");
    return element("strong", {}, words + ": ");
  };
  const parts = (texts) => [...texts].flatMap(([text, names], index) => [index ? " " : null, who(names), text]);
  const ranked = [...found.values()].sort((one, other) => severityRank(one) - severityRank(other));
  const items = ranked.map((warning) => element("li", { class: isSevere(warning) ? "grave" : null }, warning.code ? element("code", {}, warning.code) : null, " ", parts(warning.texts)));
  return element("div", { class: "warnings" }, element("strong", {}, ranked.length ? "Warnings, the most severe first" : "What is assumed"), element("ul", {}, items, assumed));
}

// Whether runs of different kinds were put side by side.
function differentSystems(runs) {
  return new Set(runs.map((run) => run.summary.system)).size > 1;
}

// Whether all are the bearings of one run.
function ofOneRun(runs) {
  return runs.every((run) => run.directory === runs[0].directory);
}

function header(runs) {
  const single = runs.length === 1 ? runs[0] : null;
  const parts = [element("h1", {}, ofOneRun(runs) ? runs[0].summary.title || runs[0].name : `Comparison of ${machinesOf(runs).length} runs`)];
  if (differentSystems(runs)) parts.push(element("div", { class: "warnings" }, element("strong", {}, "These runs cannot be compared: "), `they are of different kinds (${[...new Set(runs.map((run) => run.summary.system))].join(", ")}). Each is shown with its own pictures; quantities of one name may mean different things.`));
  // what all bearings of a machine share stands once, before what each has of its own
  for (const bearings of machinesOf(runs)) {
    const [first] = bearings;
    const several = bearings.length > 1;
    const machine = first.whole || first;
    const own = systemOf(first);
    const released = releaseOf(first) > 0 ? `released at ${engineeringText(releaseOf(first), "s", 4)} of the run` : null;
    const facts = [first.summary.system, first.directory, released, first.summary.version && "auxbear " + first.summary.version];
    const swatch = (run) => (single ? null : element("span", { class: "swatch", style: "background:" + run.colour }));
    const about = element("p", { class: "subtitle" }, several ? null : swatch(first), several || single ? null : element("strong", {}, first.label + "  "), facts.filter(Boolean).join(" · "));
    const shared = own.shared ? element("div", { class: "tiles" }, own.shared(machine)) : null;
    const each = bearings.map((run) => [several ? element("p", { class: "subtitle" }, swatch(run), element("strong", {}, run.label)) : null, several ? own.line(run) : null, own.verdict(run)]);
    const origin = spreadOrigin(first);
    parts.push(several ? [own.rotor ? own.rotor(first) : null, about] : single ? [own.line(first), about] : [about, own.line(first)], shared, limitTiles(machine), each, origin ? element("p", { class: "small" }, "Large numbers: the unperturbed run. Below them: " + origin + ".") : null);
  }
  parts.push(warningBox(runs));
  return element("header", {}, parts);
}
