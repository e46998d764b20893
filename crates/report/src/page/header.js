// The verdict: what an engineer wants to know before any picture.

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

// Warnings that a run ends too soon for a verdict.
function tooSoon(run) {
  return TOO_SOON.filter((code) => warningsOf(run, code).length);
}

// A run that ended early, or too soon, passes no criterion; it can only fail one.
function verdictState(run, bad) {
  if (bad) return "bad";
  return run.summary.complete === true && !tooSoon(run).length ? "good" : null;
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

// Tiles of the results that their tables give one, each with the notes of its title. A bound is a number, the code of a warning or the words "BAD / GOOD"; the worst
// member is judged, and a rotor that touched nothing is not.
function tilesOf(run, figure = "tile", more = {}) {
  const all = Object.values(run.quantities);
  if (figure === "tile" && all.length && !all.some(({ shown }) => shown)) return tile("Results", "–", ["of an older version, whose scenario cannot be read any more: see Quantities"]);
  const own = ({ name }) => figure !== "tile" || !name.startsWith(COAST_DOWN);
  const notes = shownIn(run, "note").map(({ words, quantity }) => ({ of: words.split(": ")[0], words: words.slice(words.indexOf(": ") + 2), quantity }));
  return shownIn(run, figure).filter(own).map(({ name, words: title, quantity }) => resultTile(run, { title, name, quantity, notes: notes.filter(({ of }) => of === title), more: more[title], untouched: figure === "tile" && systemOf(run).touches && !run.contacts.length }));
}

function exceeds(run, quantity) {
  const { bound } = quantity.shown;
  if (bound === undefined || quantity.value === null) return null;
  if (typeof quantity.value === "string") {
    const [bad, good] = bound.split(" / ");
    return quantity.value === bad ? true : quantity.value === good ? false : null;
  }
  return Number.isNaN(Number(bound)) ? warningsOf(run, bound).length > 0 : worstOf(quantity, Math.abs) > Number(bound);
}

function noteText(run, { words, quantity }) {
  const last = Array.isArray(quantity.value) ? lastNumber(quantity.value) : quantity.value;
  if (last === null || (Array.isArray(quantity.value) && !quantity.value.length)) return quantity.shown.bound ? `${words}: ${quantity.why}` : null;
  const worst = quantity.shown.bound && worstOf(quantity, Math.abs) > Math.abs(last) ? `, ${numberIn(words, worstOf(quantity, Math.abs), quantity.unit, 3)} in the worst member` : "";
  return `${words.replace(/ \[.*\]$/, "")} ${isNumber(last) ? numberIn(words, last, quantity.unit, 4) : last}${worst}`;
}

function resultTile(run, { title, name, quantity, notes, more, untouched }) {
  const shownTitle = title.replace(/ \[.*\]$/, "");
  const said = [...list(more), ...notes.map((note) => noteText(run, note))];
  if (quantity.value === null) return tile(shownTitle, "–", [`${NOT_IN_THIS_RUN}: ${quantity.why || "no reason given"}`, said]);
  const deviation = numberOf(run, name + "_deviation");
  const shown = () => {
    const [own, factor] = askedUnit(title) || [];
    const [unit, scale] = own ? [own, 1 / factor] : readableUnit(Math.max(Math.abs(quantity.value), BAND * deviation), quantity.unit);
    return bandValue(bandParts(quantity.value / scale, (BAND * deviation) / scale), unit);
  };
  const plain = () => (isNumber(quantity.value) ? numberIn(title, quantity.value, quantity.unit, 4) : quantity.value);
  const radians = quantity.unit === "rad/s" && isNumber(quantity.value) ? `${numberText(quantity.value, 4)} rad/s` : null;
  const after = "instants_after_release" in quantity.shown ? `after ${countedFrom(run)}` : null;
  const judged = [quantity, ...notes.map((note) => note.quantity)].map((one) => exceeds(run, one)).filter((bad) => bad !== null);
  const state = judged.length && !(untouched && !judged.includes(true)) ? verdictState(run, judged.includes(true)) : null;
  return tile(shownTitle, deviation === null ? plain() : shown(), [radians, meanNote(quantity), after, said], state);
}

function stateTile(run) {
  const stop = run.summary.stop || {};
  const complete = run.summary.complete === true;
  // a rotor that still turns
  const word = stop.reason === "finished" && complete ? "complete" : stop.reason;
  const time = isNumber(stop.time_s) && systemOf(run).facts ? engineeringText(stop.time_s, "s", 4) : "";
  const reason = stop.text || stop.reason || run.summaryProblem || "the summary does not say";
  // how a coast-down went stands with its pictures
  const last = reason.split(/(?<=\.) (?=[A-Z])/).at(-1);
  const soon = tooSoon(run);
  const note = soon.length ? `ends too soon for a verdict (${soon.join(", ")})` : null;
  return tile("Run", complete ? word : "not complete", [[time, complete ? last : reason].filter(Boolean).join(": "), note].filter(Boolean), verdictState(run, word !== "complete"));
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
  const few = angles < ANGLES_FOR_WHIRL ? `no backward whirl seen from ${angles} unbalance ${angles === 1 ? "angle" : "angles"}; ${ANGLES_FOR_WHIRL} at least are needed (--repeat ${ANGLES_FOR_WHIRL})` : null;
  const { value, spread } = quantityOf(run, "slips_at_end");
  const slips = (spread ? spread.largest : value) > 0;
  return [few, slips ? "ends while the rotor slips on a race or bushing that is below 95 % of its speed" : null].filter(Boolean);
}

function whirlTile(run) {
  const quantity = quantityOf(run, "whirl_direction");
  if (typeof quantity.value !== "string") return tile("Whirl", "–", ["not in this run: " + (quantity.why || "no reason given")]);
  const turns = quantityOf(run, "whirl_turns");
  const against = quantityOf(run, "backward_whirl_turns");
  const sense = Math.abs(turns.value) === against.value ? "backward" : "forward";
  const count = isNumber(turns.value) ? `${numberText(Math.abs(turns.value), 3)} turns in succession, ${sense}, in the inner race` : null;
  const back = isNumber(against.value) ? worstOf(against, (value) => value) : 0;
  const bad = quantity.value === "backward" || back >= 1;
  const unknown = bad ? [] : whirlNotSought(run);
  const rule = quantity.value === "none" && !unknown.length && !bad ? "below one turn there is no whirl" : null;
  const mean = meanNote(turns);
  const others = quantity.value !== "backward" && back >= 1 ? `BACKWARD in other members: ${numberText(back, 3)} turns in the worst` : null;
  const shown = unknown.length && quantity.value === "none" ? NOT_IN_THIS_RUN : others ? "backward" : quantity.value;
  return tile("Whirl", shown, [others, unknown, count, rule, mean && `${mean} members; counter-clockwise is positive`], unknown.length ? null : verdictState(run, bad));
}

// Distances left along the shaft between it and seals, sensors and magnets, the smallest first; less than none where it rubs.
function distancesOf(run) {
  const around = tableOf(run, "clearances");
  const all = around("name").map((name, k) => ({ name, clearance: around("clearance")[k], displacement: around("displacement")[k] }));
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
  const magnets = tableOf(run, "magnets")("name");
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
  ["AB2412", "contact over the shoulder of its groove"],
  ["AB2416", "shoulder and face so hot that steel changes"],
  ["AB2413", "nothing stops the rotor along its axis"],
  ["AB2421", "the rotor leaves its bearings along its axis"],
  ["AB2420", "thrust on the open side of a row"],
  ["AB2422", "coast-down without a friction moment"],
];

function rangeTile(run) {
  const beyond = RANGES.filter(([code]) => warningsOf(run, code).length);
  return tile("Bearing and laws", beyond.length ? `${beyond.length} beyond range` : "in range", beyond.map(([code, words]) => `${words} (${code})`), verdictState(run, beyond.length > 0));
}

// A radial model: what acts along the shaft is in no result, but of bearings in space.
function axialTile(run) {
  const share = numberOf(run, "axial_gravity_share");
  const angles = shownIn(run, "axial");
  if (angles.length) {
    const texts = angles.map(({ words, value, quantity }) => `${words} ${engineeringText(value, quantity.unit, 3)}`);
    return tile("Axial motion", "computed", [share > 0 ? `${percentText(share, 2)} of g acts along the shaft` : null, `largest contact angles: ${texts.join(", ")}`]);
  }
  return tile("Axial motion", NOT_IN_THIS_RUN, [share > 0 ? `${percentText(share, 2)} of g acts along the shaft` : null, "thrust, axial clearance and drop onto the faces are not computed"]);
}

const NOT_HELD_AGAIN = "AB2082";

// Whether a rotor was held when it was levitated again.
function relevitationTile(run) {
  const [held, ...others] = shownIn(run, "relevitation");
  if (!held) return null;
  const notes = others.filter(({ value }) => value !== null).map(({ words, value, quantity }) => `${words} ${engineeringText(value, quantity.unit, 4)}`);
  return tile("Levitated again", held.quantity.value, [notes, held.quantity.value === null ? held.quantity.why : null], verdictState(run, warningsOf(run, NOT_HELD_AGAIN).length > 0));
}

// Of a machine once, whatever its bearings are.
function machineTiles(run) {
  return [
    stateTile(run),
    relevitationTile(run),
    distanceTile(run),
    rangeTile(run),
    axialTile(run),
    tilesOf(run, "machine_tile"),
  ];
}

function verdict(run) {
  const peak = peakContact(run);
  const late = peak && peak.peak_time_s - releaseOf(run);
  const when = peak && `${engineeringText(Math.abs(late), "s", 4)} ${late < 0 ? "before" : "after"} ${countedFrom(run)}`;
  return element("div", { class: "tiles" }, tilesOf(run, "tile", { "Peak contact force": [when] }), whirlTile(run));
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
  const bearing = given("bearing.name") || (inputOf(run, "bearing.ball_count") ? "bearing without a name" : given("bearing.type"));
  const planes = given(run.summary.name ? "planes" : "rotor.planes");
  const assumed = (path) => (inputOf(run, path).mark === "assumed" ? " (assumed)" : "");
  const facts = [
    mass && `rotor ${mass}`,
    speed && (/^0 /.test(speed) ? "from rest" : speed),
    bearing && bearing + (planes && !(run.summary.name && planes === "1") ? ` × ${planes} ${planes === "1" ? "plane" : "planes"}` : ""),
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
