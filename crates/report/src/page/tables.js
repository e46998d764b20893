// Quantities, inputs and the facts of the run, as tables.

const LIST_SHOWN = 6;

function quantityText(quantity) {
  const { value, unit } = quantity;
  if (value === null || value === undefined) return element("span", { class: "absent" }, "not in this run: " + (quantity.why || "no reason given"));
  if (Array.isArray(value)) return listText(value, unit);
  if (!isNumber(value)) return String(value);
  return engineeringText(value, unit, 5);
}

function listText(values, unit) {
  if (!values.length) return "none";
  const words = values.map((value) => (isNumber(value) ? engineeringText(value, unit, 5) : String(value)));
  if (words.length <= LIST_SHOWN) return words.join(", ");
  const short = words.slice(0, LIST_SHOWN).join(", ") + ", …";
  return element("details", {}, element("summary", {}, `${values.length} values: ${short}`), words.join(", "));
}

function siCell(quantity) {
  if (isNumber(quantity.value)) return siText(quantity.value, quantity.unit);
  return Array.isArray(quantity.value) ? `list in ${quantity.unit || "1"}` : "";
}

// Mean ± standard deviation and range in one unit: plain decimals, at most six digits of the mean, two of the deviation.
function spreadText(quantity) {
  const { mean, sd, min, max, q05, median, q95 } = quantity.spread;
  let [unit, scale] = mean === 0 ? [unitText(quantity.unit), 1] : readableUnit(mean, quantity.unit);
  const size = Math.abs(mean) / scale;
  if (size > 0 && (size < 1e-3 || size >= 1e6)) {
    const power = leadingPower(size);
    scale *= 10 ** power;
    unit = `× ${powerOfTen(power)} ${unit}`.trim();
  }
  const finest = 5 - leadingPower(mean / scale);
  const known = isNumber(sd) && sd > 0;
  const decimals = known ? Math.min(finest, 1 - leadingPower(sd / scale)) : finest;
  const tail = unit === "°" ? unit : unit && " " + unit;
  const text = (value) => decimalText(isNumber(value) ? value / scale : null, decimals);
  const deviation = known ? " ± " + decimalText(sd / scale, 1 - leadingPower(sd / scale)) : sd === 0 ? " ± 0" : "";
  const grouped = deviation && tail ? `(${text(mean)}${deviation})` : text(mean) + deviation;
  const range = text(min) === text(max) ? "smallest and largest agree in these digits" : unit.startsWith("×") ? `(${text(min)} to ${text(max)})${tail}` : `${text(min)} to ${text(max)}${tail}`;
  const apart = text(q05) !== text(q95);
  const quantiles = apart ? `median ${text(median)}, 90 % within ${text(q05)} to ${text(q95)}${tail}` : null;
  return { mean: grouped + tail, range, quantiles };
}

// The members as a band: thin from the smallest to the largest, thick over the middle 90 %, a tick at the median, a dot
// at the unperturbed run.
function spreadBar(quantity) {
  const { min, max, q05, median, q95 } = quantity.spread;
  if (![min, max, q05, median, q95].every(isNumber) || !(max > min)) return null;
  // what agrees to a thousandth needs no picture
  if (max - min < 1e-3 * Math.max(Math.abs(min), Math.abs(max))) return null;
  const [width, height, edge] = [160, 14, 5];
  const at = (value) => edge + ((width - 2 * edge) * (value - min)) / (max - min);
  const middle = height / 2;
  const own = isNumber(quantity.value) && quantity.value >= min && quantity.value <= max;
  return drawing(
    "svg",
    { class: "band", width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "spread of the members" },
    drawing("line", { class: "range", x1: at(min), x2: at(max), y1: middle, y2: middle }),
    drawing("line", { class: "most", x1: at(q05), x2: at(q95), y1: middle, y2: middle }),
    drawing("line", { class: "median", x1: at(median), x2: at(median), y1: 1, y2: height - 1 }),
    own ? drawing("circle", { class: "own", cx: at(quantity.value), cy: middle, r: 3 }) : null,
  );
}

// A mean over the members that came so far says little of those that did not.
function censored(quantity) {
  const absent = (quantity.all_members || 0) - quantity.spread.members;
  return absent > 0 ? `; ${absent} others never came to it, so that mean and range are those of the quick ones` : "";
}

// What a single run shows as an example only.
function chaoticMark(quantity) {
  return quantity.chaotic ? element("span", { class: "mark mark-chaotic", title: "tiny changes of the start change it much: compare ensembles (auxbear run --repeat)" }, "chaotic") : null;
}

function spreadCell(quantity) {
  const spread = quantity.spread;
  if (!spread || !isNumber(spread.mean)) return "";
  const { mean, range, quantiles } = spreadText(quantity);
  // quantiles of a few members say no more than their range
  const many = isNumber(spread.members) && spread.members >= 20;
  return [
    spreadBar(quantity),
    element("div", { class: "spread" }, mean),
    element("div", { class: "small" }, range + (isNumber(spread.members) ? `, ${spread.members} members${censored(quantity)}` : "")),
    many && quantiles ? element("div", { class: "small" }, quantiles) : null,
  ];
}

// Changes of these carry no meaning as a share: they scatter about zero.
const WITHOUT_SHARE = /(residual|whirl_turns)$/;

// Law, source and range of a group of quantities that share them, folded: the literature first, then the file of the code.
function lawLine(quantity) {
  const [literature, code] = sourceParts(quantity.source);
  const parts = [["Law", quantity.law], ["Source", literature], ["Valid", quantity.valid], ["Code", code]].filter(([, words]) => words);
  return parts.map(([title, words]) => element("span", { class: "law" }, element("b", {}, title + ": "), words + "  "));
}

// A source without the paths of the code that computes it, and these paths.
const CODE_PATH = /(?:crates\/[\w./{}-]+|\b\w+\/\w+\.rs|\b\w+\.rs)/g;

function sourceParts(source) {
  const text = String(source || "");
  const code = (text.match(CODE_PATH) || []).map((path) => path.replace(/[.,;]$/, ""));
  const lead = "(?:[;,]?\\s*(?:and )?(?:bands in|slips of|in)?)?\\s*";
  const literature = text.replace(new RegExp(lead + CODE_PATH.source, "g"), "").replace(/^[\s;,]+|[\s;,]+$/g, "");
  return [literature, code.join(", ")];
}

function differenceText(first, other) {
  if (first === null || other === null) return "–";
  if (!isNumber(first) || !isNumber(other)) return first === other ? "same" : "–";
  if (first === other) return "same";
  if (first === 0) return "from 0";
  const share = (other - first) / Math.abs(first);
  if (Math.abs(share) < 1e-5) return "below 0.001 %";
  return (share > 0 ? "+" : "") + percentText(share);
}

// What a quantity is about, by the words of its name; the first that fits.
const SUBJECTS = [
  ["Verdict", /^(explanation|probability_of_(?!\w+_form)|next_test)/],
  ["Residuals of the computation", /residual$/],
  ["Surfaces of rotor and race", /^contact_temperature|surface_rise|^wear_|sliding_distance|pressure_times|heat_into/],
  ["Energy and heat", /energy|heat|work|dissipat|power|path_term|without_cooling|heat_index/],
  ["Hertz pressure and loads of the balls", /pressure|ball_load|static_safety|skid_share|indentation/],
  ["Cage and balls", /cage|pocket|skid|slip|ball_ball|land_/],
  ["Contact of rotor and race", /contact|impact|force|whirl|blow/],
  ["Displacements", /displacement/],
  ["Steady moment", /^steady|_form$|coast_down|largest_parameter|effective_steady/],
  ["Moments", /moment|torque|traction_capacity|friction/],
  ["Speeds, accelerations and times", /speed|acceler|deceler|time|engage|lock|rolling_established|pulse|mark/],
  ["Film and lubricant", /film|lubricant|viscosity|temperature|lambda/],
  ["Vibration", /vibration|spectr/],
];

// Names by the test or bearing that they begin with, else by subject, in the order of their first.
function subjectsOf(names) {
  const found = new Map();
  for (const name of names) {
    const [owner, rest] = name.includes(".") ? [name.slice(0, name.lastIndexOf(".")), name.slice(name.lastIndexOf(".") + 1)] : ["", name];
    const subject = owner ? wordsOf(owner) : (SUBJECTS.find(([, words]) => words.test(rest)) || ["Others"])[0];
    if (!found.has(subject)) found.set(subject, []);
    found.get(subject).push(name);
  }
  return [...found];
}

function hasValue({ value }) {
  return value !== null && value !== undefined;
}

// Values of a list that a narrow column of several runs has room for on paper.
const LIST_ON_PAPER = 3;

function quantitySection(runs) {
  // what a coast-down does over time is in its pictures
  const names = [...new Set(runs.flatMap((run) => Object.keys(run.quantities)))].filter((name) => !name.includes("over_time."));
  if (!names.length) return section("quantities", "Quantities", notInThisRun("the summary holds no quantities"));
  const repeated = runs.some((run) => names.some((name) => quantityOf(run, name).spread));
  const single = runs.length === 1;
  for (const run of runs) for (const quantity of Object.values(run.quantities)) if (quantity && quantity.spread) quantity.all_members = run.summary.members_total || list(run.summary.members).length;
  const heads = ["Quantity"];
  if (single) heads.push("Value", "In SI units");
  else runs.forEach((run, index) => heads.push(run.short, ...(index ? [`(${run.letter} − A) / A`] : [])));
  if (repeated && single) heads.push("Mean ± deviation, range");
  const statedOf = (name) => {
    const all = runs.map((run) => quantityOf(run, name));
    return all.find((quantity) => quantity.law || quantity.source || quantity.valid) || all[0];
  };
  const rowOf = (name) => {
    const all = runs.map((run) => quantityOf(run, name));
    const cells = [element("td", { class: "name" }, wordsOf(name), chaoticMark(statedOf(name)), element("code", {}, breakable(name)))];
    if (single) cells.push(element("td", {}, quantityText(all[0])), element("td", { class: "small" }, siCell(all[0])));
    else {
      all.forEach((quantity, index) => {
        const { value } = quantity;
        const many = Array.isArray(value) && value.length > LIST_ON_PAPER;
        const text = many ? [element("span", { class: "screen-only" }, quantityText(quantity)), element("span", { class: "print-only" }, `${value.length} values`)] : quantityText(quantity);
        cells.push(element("td", {}, text, spreadCell(quantity)));
        if (index) cells.push(element("td", { class: "difference" }, WITHOUT_SHARE.test(name) ? "–" : differenceText(all[0].value, quantity.value)));
      });
    }
    if (repeated && single) cells.push(element("td", {}, spreadCell(all[0])));
    return element("tr", {}, cells);
  };
  const bodies = subjectsOf(names).map(([subject, some]) => {
    const empty = some.filter((name) => runs.every((run) => !hasValue(quantityOf(run, name))));
    const shown = some.filter((name) => !empty.includes(name));
    const laws = new Map();
    for (const name of some) {
      const quantity = statedOf(name);
      const key = JSON.stringify([quantity.law, quantity.source, quantity.valid]);
      if (!(quantity.law || quantity.source || quantity.valid)) continue;
      if (!laws.has(key)) laws.set(key, { quantity, of: [] });
      laws.get(key).of.push(wordsOf(name));
    }
    const about = [...laws.values()].map(({ quantity, of }) => element("p", {}, laws.size > 1 ? element("strong", {}, of.join(", ") + ". ") : null, lawLine(quantity)));
    const whole = (content) => element("tr", { class: "laws" }, element("td", { colspan: heads.length }, content));
    return element(
      "tbody",
      {},
      element("tr", { class: "subject" }, element("th", { colspan: heads.length }, subject)),
      shown.map(rowOf),
      empty.length ? whole(element("details", {}, element("summary", {}, `${empty.length} not in ${single ? "this run" : "these runs"}: ${empty.map(wordsOf).join(", ")}`), element("table", {}, element("tbody", {}, empty.map(rowOf))))) : null,
      about.length ? whole(element("details", {}, element("summary", {}, "Law, source and valid range"), about)) : null,
    );
  });
  const table = element("table", { class: single ? "quantities single" : "quantities several", style: single ? null : `--columns:${heads.length}` }, element("thead", {}, element("tr", {}, heads.map((words) => element("th", {}, words)))), bodies);
  const origin = runs.map(spreadOrigin).find(Boolean);
  const note = repeated ? element("p", { class: "lead" }, `Value: the unperturbed run. Then mean ± standard deviation, smallest and largest value, and quantiles over all members: ${origin}. In the bands: thin, all members; thick, the middle 90 %; tick, median; dot, the unperturbed run.`) : null;
  const anyChaotic = runs.some((run) => names.some((name) => quantityOf(run, name).chaotic));
  const chaos = anyChaotic ? element("p", { class: "lead" }, element("span", { class: "mark mark-chaotic" }, "chaotic"), " marks what differs from start to start: read its band, not its value.") : null;
  const once = !repeated && runs.some((run) => ["drop", "machine"].includes(run.summary.system)) ? element("p", { class: "lead" }, "Which of these tiny changes of the start change much is not known without repetition: auxbear run --repeat 64.") : null;
  return section("quantities", "Quantities", note, chaos, once, element("div", { class: "wide" }, table), runs.map(memberDetails));
}

function memberDetails(run) {
  const members = list(run.summary.members).filter((member) => member && typeof member === "object");
  if (!members.length) return null;
  const plain = (cell) => (cell && typeof cell === "object" && !Array.isArray(cell) ? cell.value : cell);
  const names = [...new Set(members.flatMap(Object.keys))].filter((name) => members.some((member) => isNumber(plain(member[name]))));
  const row = (member, index) => element("tr", {}, element("td", {}, index), names.map((name) => element("td", {}, numberText(plain(member[name]), 6))));
  const unit = (name) => unitText(quantityOf(run, name).unit);
  const heads = names.map((name) => wordsOf(name) + (unit(name) ? ` [${unit(name)}]` : ""));
  return element(
    "details",
    { class: "screen-only" },
    element("summary", {}, `${run.prefix}${run.summary.members_total ? `the first ${members.length} of ${run.summary.members_total}` : members.length} members of the repeated run, in SI units${run.summary.members_total ? "; summary.json and auxbear export have all" : ""}`),
    element("div", { class: "wide" }, tableOfRows("numbers", ["member", ...heads], members.map(row))),
  );
}

const MARK_WORDS = { given: "given", default: "default", assumed: "assumed", catalogue: "catalogue", derived: "derived" };

function markBadge(mark) {
  return element("span", { class: "mark mark-" + (MARK_WORDS[mark] || "other") }, MARK_WORDS[mark] || String(mark || "not said"));
}

// A dotted path may break after its dots and underscores, nowhere else.
function breakable(path) {
  return path.split(/(?<=[._])/).flatMap((part, index) => (index ? [element("wbr"), part] : [part]));
}

// Beside more than two runs there is room for neither notes nor a column of origins: those stand below the values, these in the tips
// of their marks.
const RUNS_WITH_NOTES = 2;

function inputRow(paths, path, runs) {
  const inputs = paths.get(path);
  const narrow = runs.length > RUNS_WITH_NOTES;
  const cells = runs.map((run, index) => {
    const input = inputs[index];
    const value = input ? inputText(input.value) : element("span", { class: "absent" }, "not in this run");
    if (narrow) return element("td", { title: input && input.note ? input.note : null }, value, " ", input ? markBadge(input.mark) : null);
    return [element("td", {}, value), element("td", {}, input ? markBadge(input.mark) : null)];
  });
  const notes = [...new Set(inputs.filter(Boolean).map((input) => input.note).filter(Boolean))].join("; ");
  const assumed = inputs.some((input) => input && input.mark === "assumed");
  return element("tr", { class: assumed ? "assumed" : null }, element("td", {}, element("code", {}, breakable(path))), cells, narrow ? null : element("td", { class: "small" }, notes));
}

// The inputs of all runs by path, in the order of the file.
function inputPaths(runs) {
  const paths = new Map();
  runs.forEach((run, index) => {
    for (const input of list(run.summary.inputs)) {
      if (!input || !input.path) continue;
      if (!paths.has(input.path)) paths.set(input.path, runs.map(() => null));
      paths.get(input.path)[index] = input;
    }
  });
  return paths;
}

function inputsDiffer(inputs) {
  return new Set(inputs.map((input) => (input ? String(input.value) : null))).size > 1;
}

function inputTable(runs, paths, keys) {
  const narrow = runs.length > RUNS_WITH_NOTES;
  const heads = ["Input", ...runs.flatMap((run) => [runs.length === 1 ? "Value" : run.short, ...(narrow ? [] : ["Origin"])]), ...(narrow ? [] : ["Note"])];
  return tableOfRows("inputs", heads, keys.map((path) => inputRow(paths, path, runs)));
}

function differenceSection(runs) {
  const paths = inputPaths(runs);
  const keys = [...paths.keys()].filter((path) => inputsDiffer(paths.get(path)));
  const same = paths.size ? "None: all inputs are the same." : "The summaries list no inputs.";
  return section("differences", "Inputs that differ", keys.length ? inputTable(runs, paths, keys) : element("p", {}, same));
}

function inputSection(runs) {
  const paths = inputPaths(runs);
  const scenario = runs.map((run) =>
    run.scenario ? element("details", { class: "screen-only" }, element("summary", {}, run.prefix + "scenario.toml as it was run"), element("pre", {}, run.scenario)) : notInThisRun("its scenario text", run),
  );
  if (!paths.size) return section("inputs", "Inputs", notInThisRun("the summary lists no inputs"), scenario);
  const single = runs.length === 1;
  const keys = [...paths.keys()].filter((path) => single || !inputsDiffer(paths.get(path)));
  const counts = Object.keys(MARK_WORDS).map((mark) => [mark, list(runs[0].summary.inputs).filter((input) => input && input.mark === mark).length]);
  const lead = single
    ? element("p", { class: "lead" }, "Origin of the values: ", counts.filter(([, count]) => count).map(([mark, count]) => [markBadge(mark), ` ${count}   `]), "Six digits are shown; scenario.toml holds them all.")
    : element("p", { class: "lead" }, "Inputs that are the same in all runs; those that differ stand at the top of this page.");
  return section("inputs", "Inputs", lead, inputTable(runs, paths, keys), scenario);
}

function factSection(runs) {
  const work = (run) => run.summary.work || {};
  const largest = (run, name) => {
    const values = columnOf(run, name);
    return values ? values.reduce((most, value) => Math.max(most, Math.abs(value || 0)), 0) : null;
  };
  const number = (value, unit) => (isNumber(value) ? engineeringText(value, unit, 4) : element("span", { class: "absent" }, "not in this run"));
  const facts = [
    ["Program", (run) => (run.summary.version ? "auxbear " + run.summary.version : number(null))],
    ["Summary format", (run) => run.summary.format || number(null)],
    ["End of the run", (run) => [run.summary.stop && run.summary.stop.reason, run.summary.stop && isNumber(run.summary.stop.time_s) && engineeringText(run.summary.stop.time_s, "s", 5)].filter(Boolean).join(" at ") || number(null)],
    ["Time integration", (run) => work(run).method || number(null)],
    ["Steps taken", (run) => number(work(run).steps, "1")],
    ["Steps rejected", (run) => number(work(run).rejected, "1")],
    ["Calls of the right-hand side", (run) => number(work(run).rate_calls, "1")],
    ["Wall-clock time of the simulation", (run) => number(work(run).wall_s, "s")],
    ["Largest angular momentum residual", (run) => number(largest(run, "angular_momentum.residual"), "N m s")],
    ["Rows in this page", (run) => (run.time ? (run.rows === run.rowsTotal ? `all ${run.rows} of history.parquet` : `${run.rows} of the ${run.rowsTotal} in history.parquet, extremes kept`) : number(null))],
  ];
  const rows = facts.map(([title, fact]) => element("tr", {}, element("th", {}, title), runs.map((run) => element("td", {}, fact(run)))));
  const head = runs.length > 1 ? element("thead", {}, element("tr", {}, element("th", {}, ""), runs.map((run) => element("th", {}, run.short)))) : null;
  return section("facts", "Run facts", element("table", { class: "facts" }, head, element("tbody", {}, rows)), residualFigures(runs));
}
