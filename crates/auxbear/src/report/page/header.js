// The verdict: what an engineer wants to know before any picture.

// Above this share of the energies an energy picture can no longer be trusted at a glance.
const RESIDUAL_TO_DOUBT = 1e-3;

function tile(title, value, note, doubtful) {
  return element(
    "div",
    { class: doubtful ? "tile doubtful" : "tile" },
    element("div", { class: "tile-title" }, title),
    element("div", { class: "tile-value" }, value),
    element("div", { class: "tile-note" }, note),
  );
}

function quantityTile(run, title, name, note, doubtful) {
  const quantity = quantityOf(run, name);
  if (!isNumber(quantity.value)) return tile(title, "–", "not in this run: " + (quantity.why || "no reason given"), true);
  return tile(title, engineeringText(quantity.value, quantity.unit, 4), note(quantity.value), doubtful && doubtful(quantity.value));
}

function stateTile(run) {
  const stop = run.summary.stop || {};
  const complete = run.summary.complete === true;
  const time = isNumber(stop.time_s) ? engineeringText(stop.time_s, "s", 4) : "";
  const reason = stop.text || stop.reason || run.summaryProblem || "the summary does not say";
  return tile("Run", complete ? "complete" : "not complete", [time, reason].filter(Boolean).join(": "), !complete);
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
  return `${where} the limit of ${engineeringText(limit, "Pa", 4)} (${percentText(pressure / limit)} of it)`;
}

function spinUpNote(run) {
  const half = numberOf(run, "inner_race_time_to_50_percent");
  const share = half === null ? "" : "50 % at " + engineeringText(half, "s", 4) + "; ";
  return share + "time 0 is the release";
}

function verdict(run) {
  const limit = run.summary.hertz_pressure_limit_Pa;
  return element(
    "div",
    { class: "tiles" },
    stateTile(run),
    quantityTile(run, "Peak contact force", "peak_contact_force", () => forceNote(run)),
    quantityTile(
      run,
      "Peak Hertz pressure",
      "peak_hertz_pressure",
      (pressure) => pressureNote(run, pressure),
      (pressure) => isNumber(limit) && pressure > limit,
    ),
    quantityTile(run, "Inner race at 95 % speed", "inner_race_time_to_95_percent", () => spinUpNote(run)),
    quantityTile(
      run,
      "Energy residual",
      "energy_residual",
      () => "share of the energies that the ledger leaves unexplained",
      (residual) => Math.abs(residual) > RESIDUAL_TO_DOUBT,
    ),
  );
}

function warningBox(run) {
  const warnings = list(run.summary.warnings).filter(Boolean);
  const items = warnings.map((warning) =>
    element("li", {}, warning.code ? element("code", {}, warning.code) : null, " ", warning.text || String(warning)),
  );
  if (run.summaryProblem) items.unshift(element("li", {}, run.summaryProblem));
  if (!items.length) return null;
  return element("div", { class: "warnings" }, element("strong", {}, run.prefix ? "Warnings of run " + run.letter : "Warnings"), element("ul", {}, items));
}

function header(runs) {
  const single = runs.length === 1 ? runs[0] : null;
  const parts = [element("h1", {}, single ? single.summary.title || single.name : "Comparison of " + runs.length + " runs")];
  for (const run of runs) {
    const facts = [run.summary.system, run.directory, run.summary.version && "auxbear " + run.summary.version];
    const key = single ? null : element("span", { class: "swatch", style: "background:" + run.colour });
    parts.push(element("p", { class: "subtitle" }, key, single ? null : element("strong", {}, run.label + "  "), facts.filter(Boolean).join(" · ")));
    parts.push(verdict(run), warningBox(run));
  }
  return element("header", {}, parts);
}
