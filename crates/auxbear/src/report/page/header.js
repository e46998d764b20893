// The verdict: what an engineer wants to know before any picture.

// Above this share of what was turned over the energy ledger counts as open.
const RESIDUAL_TO_DOUBT = 1e-6;

// A value with what it may be off below it: twice the standard deviation.
function bandValue([value, band], unit) {
  const whole = (text) => `${text} ${unit}`.trim();
  return [whole(value), band === null ? null : element("div", { class: "tile-band" }, `± ${whole(band)} (2σ)`)];
}

// state: "good" or "bad" where there is a criterion, else nothing.
function tile(title, value, notes, state) {
  return element(
    "div",
    { class: state ? "tile " + state : "tile" },
    element("div", { class: "tile-title" }, title),
    element("div", { class: "tile-value" }, value),
    list(notes).filter(Boolean).map((note) => element("div", { class: "tile-note" }, note)),
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

function quantityTile(run, title, name, note, state) {
  const quantity = quantityOf(run, name);
  if (!isNumber(quantity.value)) return tile(title, "–", ["not in this run: " + (quantity.why || "no reason given")]);
  const deviation = numberOf(run, name + "_deviation");
  const shown = () => {
    const [unit, scale] = readableUnit(Math.max(Math.abs(quantity.value), BAND * deviation), quantity.unit);
    return bandValue(bandParts(quantity.value / scale, (BAND * deviation) / scale), unit);
  };
  return tile(title, deviation === null ? engineeringText(quantity.value, quantity.unit, 4) : shown(), [meanNote(quantity), note && note(quantity.value)], state && state(quantity.value));
}

function stateTile(run) {
  const stop = run.summary.stop || {};
  const complete = run.summary.complete === true;
  const time = isNumber(stop.time_s) && systemOf(run).time ? engineeringText(stop.time_s, "s", 4) : "";
  const reason = stop.text || stop.reason || run.summaryProblem || "the summary does not say";
  return tile("Run", complete ? "complete" : "not complete", [[time, reason].filter(Boolean).join(": ")], verdictState(run, !complete));
}

function forceNote(run) {
  const peak = peakContact(run);
  const count = numberOf(run, "contact_count");
  const parts = [peak && "at " + engineeringText(peak.peak_time_s, "s", 4), isNumber(count) && count + (count === 1 ? " contact" : " contacts")];
  return parts.filter(Boolean).join(", ");
}

function pressureNote(run, pressure) {
  const limit = run.summary.hertz_pressure_limit_Pa;
  if (!isNumber(limit)) return "no limit is given for these balls";
  const where = pressure <= limit ? "below" : "ABOVE";
  const races = `${where} the limit of ${engineeringText(limit, "Pa", 4)} (${percentText(pressure / limit)} of it)`;
  const neighbours = numberOf(run, "peak_ball_ball_pressure");
  if (neighbours === null) return races;
  const share = numberOf(run, "hertz_pressure_share_of_limit");
  const apart = share > pressure / limit ? `, ${percentText(share)} of their limit` : "";
  return `${races}; between balls ${engineeringText(neighbours, "Pa", 4)}${apart}`;
}

function spinUpNote(run) {
  const half = numberOf(run, "inner_race_time_to_50_percent");
  const share = half === null ? "" : "50 % at " + engineeringText(half, "s", 4) + "; ";
  return share + "time 0 is the release";
}

function whirlTile(run) {
  const quantity = quantityOf(run, "whirl_direction");
  if (typeof quantity.value !== "string") return tile("Whirl", "–", ["not in this run: " + (quantity.why || "no reason given")]);
  const turns = quantityOf(run, "whirl_turns");
  const count = isNumber(turns.value) ? numberText(Math.abs(turns.value), 3) + " net turns in the inner race" : null;
  const rule = quantity.value === "none" ? "below one turn there is no whirl" : null;
  return tile("Whirl", quantity.value, [meanNote(turns), count, rule], verdictState(run, quantity.value === "backward"));
}

function displacementTile(run) {
  if (!("max_rotor_displacement" in run.quantities)) return null;
  const clearance = run.summary.clearance_radius_m;
  const beside = isNumber(clearance) ? `; the clearance is ${engineeringText(clearance, "m", 4)}` : "";
  return quantityTile(run, "Largest rotor displacement", "max_rotor_displacement", () => "of its centre from the origin" + beside);
}

// Each pressure counts by the limit of what touches there; the share is the largest.
function pressureTile(run) {
  const share = numberOf(run, "hertz_pressure_share_of_limit");
  const state = share === null ? null : verdictState(run, share > 1);
  return quantityTile(run, "Peak Hertz pressure", "peak_hertz_pressure", (pressure) => pressureNote(run, pressure), () => state);
}

function verdict(run) {
  return element(
    "div",
    { class: "tiles" },
    stateTile(run),
    quantityTile(run, "Peak contact force", "peak_contact_force", () => forceNote(run)),
    pressureTile(run),
    quantityTile(run, "Inner race at 95 % speed", "inner_race_time_to_95_percent", () => spinUpNote(run)),
    whirlTile(run),
    displacementTile(run),
    quantityTile(
      run,
      "Energy residual",
      "energy_residual",
      () => "share of the energies that the ledger leaves unexplained",
      (residual) => verdictState(run, Math.abs(residual) > RESIDUAL_TO_DOUBT),
    ),
  );
}

// Rotor, speed, bearing, clearance and friction in one line, as far as the inputs state it.
function machineLine(run) {
  const given = (path) => {
    const input = inputOf(run, path);
    return input && String(input.value) !== "not given" ? inputText(input.value) : null;
  };
  const speed = given("rotor.speed");
  const radians = speed && /^([0-9.eE+-]+)\s*rad\/s$/.exec(speed);
  const mass = given("rotor.mass");
  const clearance = given("contact.radial_air_clearance");
  const friction = given("contact.friction_coefficient");
  const fidelity = given("bearing.fidelity");
  const bearing = given("bearing.name") || (inputOf(run, "bearing.ball_count") ? "bearing without a name" : null);
  const planes = given("rotor.planes");
  const assumed = (path) => (inputOf(run, path).mark === "assumed" ? " (assumed)" : "");
  const facts = [
    mass && `rotor ${mass}`,
    speed && (radians ? numberText((Number(radians[1]) * 30) / Math.PI, 6) + " rpm" : speed),
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
  const varied = ["friction_coefficient", "mount_stiffness", "radial_air_clearance"].filter((name) => Number((inputOf(run, `repeat.${name}_deviation`) || {}).value) > 0).map((name) => name.replaceAll("_", " "));
  if ((inputOf(run, "repeat.unbalance_angle") || {}).value === "random") varied.push("direction of the unbalance");
  const drawn = list(run.summary.drawn).flatMap((draws) => Object.keys(draws || {}));
  const known = ["contact.friction_coefficient", "mount.stiffness", "contact.radial_air_clearance", "rotor.unbalance_angle"];
  varied.push(...new Set(drawn.filter((path) => !known.some((other) => path.endsWith(other)) || !varied.length)));
  if (varied.length) return `spread of machines that differ in ${varied.join(", ")}, and of starts perturbed by ${by} (see repeat.*)`;
  return `spread of starts perturbed by ${by || "tiny amounts"} (see repeat.*): shows numerical chaos, not tolerances of the machine`;
}

// Each warning once; with several runs it names those that have it.
function warningBox(runs) {
  const found = new Map();
  const add = (run, code, text) => {
    const key = `${code} ${text}`;
    if (!found.has(key)) found.set(key, { code, text, letters: [] });
    found.get(key).letters.push(run.letter);
  };
  for (const run of runs) {
    if (run.summaryProblem) add(run, "", run.summaryProblem);
    for (const warning of list(run.summary.warnings).filter(Boolean)) add(run, warning.code || "", warning.text || String(warning));
  }
  if (!found.size) return null;
  const who = ({ letters }) => {
    if (ofOneRun(runs)) return null;
    return element("strong", {}, letters.length === runs.length ? "all runs: " : (letters.length > 1 ? "runs " : "run ") + letters.join(", ") + ": ");
  };
  const items = [...found.values()].map((warning) => element("li", {}, warning.code ? element("code", {}, warning.code) : null, " ", who(warning), warning.text));
  return element("div", { class: "warnings" }, element("strong", {}, "Warnings"), element("ul", {}, items));
}

// Whether all are the bearings of one run.
function ofOneRun(runs) {
  return runs.every((run) => run.directory === runs[0].directory);
}

function header(runs) {
  const single = runs.length === 1 ? runs[0] : null;
  const parts = [element("h1", {}, ofOneRun(runs) ? runs[0].summary.title || runs[0].name : "Comparison of " + runs.length + " runs")];
  for (const run of runs) {
    const facts = [run.summary.system, run.directory, run.summary.version && "auxbear " + run.summary.version];
    const key = single ? null : element("span", { class: "swatch", style: "background:" + run.colour });
    const origin = spreadOrigin(run);
    const about = element("p", { class: "subtitle" }, key, single ? null : element("strong", {}, run.label + "  "), facts.filter(Boolean).join(" · "));
    const own = systemOf(run);
    const line = own.line(run);
    parts.push(single ? [line, about] : [about, line], own.verdict(run), limitTiles(run), origin ? element("p", { class: "small" }, "Large numbers: the unperturbed run. Below them: " + origin + ".") : null);
  }
  parts.push(warningBox(runs));
  return element("header", {}, parts);
}
