// The runs as the page received them, and safe access to what may be absent.

// What each system shows, registered by its own script: the line and the tiles of the header; the words of its time axis, null
// where nothing depends on time; sections, each with its place among those of all systems: [place, build, runs that have it].
const SYSTEMS = {};

function register(system, parts) {
  SYSTEMS[system] = parts;
}

function systemOf(run) {
  return SYSTEMS[run.summary.system] || SYSTEMS.drop;
}

// Sections that systems share stand once, with the runs of all of them.
function sectionsOf(runs) {
  const found = new Map();
  for (const parts of Object.values(SYSTEMS)) {
    const own = runs.filter((run) => systemOf(run) === parts);
    for (const [place, build, some] of own.length ? parts.sections(own) : []) {
      if (!found.has(build)) found.set(build, { place, runs: new Set() });
      for (const run of some) found.get(build).runs.add(run);
    }
  }
  const inOrder = [...found].sort(([, one], [, other]) => one.place - other.place);
  return inOrder.map(([build, { runs: some }]) => [build, runs.filter((run) => some.has(run))]);
}

// What never changes came as a single value.
function decodeColumn(column, rows) {
  const bytes = Uint8Array.from(atob(column.data), (letter) => letter.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const wide = column.type === "f64";
  let values = new Array(bytes.length / (wide ? 8 : 4));
  for (let row = 0; row < values.length; row++) {
    const value = wide ? view.getFloat64(8 * row, true) : view.getFloat32(4 * row, true);
    values[row] = Number.isFinite(value) ? value : null;
  }
  if (values.length === 1 && rows > 1) values = new Array(rows).fill(values[0]);
  return { name: column.name, unit: column.unit, meaning: column.meaning, values };
}

function readRun(text) {
  const raw = JSON.parse(text);
  let summary = {};
  let summaryProblem = null;
  try {
    const parsed = JSON.parse(raw.summary);
    if (parsed && typeof parsed === "object") summary = parsed;
    else summaryProblem = "summary.json holds no object";
  } catch (problem) {
    summaryProblem = "summary.json cannot be read (" + problem.message + ")";
  }
  const columns = new Map(list(raw.columns).map((column) => [column.name, decodeColumn(column, raw.rows)]));
  const name = raw.name || summary.title || raw.directory || "run";
  return {
    name,
    directory: raw.directory,
    scenario: raw.scenario,
    summary,
    summaryProblem,
    columns,
    rows: raw.rows,
    rowsTotal: raw.rows_total,
    withBalls: raw.balls !== false,
    closely: raw.closely || {},
    time: columns.has("time") ? columns.get("time").values : null,
    contacts: list(summary.contacts).filter((contact) => contact && isNumber(contact.start_s)),
    quantities: summary.quantities && typeof summary.quantities === "object" ? summary.quantities : {},
  };
}

// A run on several bearings as one run for each: what carries the bearing's name loses it, what carries another's is left out.
function ofBearing(run, bearing, names) {
  const start = `${bearing.name}.`;
  const of = (entries) => entries.filter(([name]) => name.startsWith(start) || !names.some((other) => name.startsWith(`${other}.`))).map(([name, value]) => [name.startsWith(start) ? name.slice(start.length) : name, value]);
  const section = `auxiliary_bearing.${start}`;
  const inputs = list(run.summary.inputs).filter((input) => input && !(input.path.startsWith("auxiliary_bearing.") && !input.path.startsWith(section)));
  const plain = inputs.map((input) => (input.path.startsWith(section) ? { ...input, path: input.path.slice(section.length) } : input));
  return {
    ...run,
    name: `${run.name}, ${bearing.name}`,
    whole: { ...run, summary: { ...run.summary, name: "", auxiliary_bearings: [] }, short: run.name, prefix: `${run.name}: ` },
    columns: new Map(of([...run.columns]).map(([name, column]) => [name, { ...column, name }])),
    bearingNames: names,
    contacts: run.contacts.filter((contact) => contact.auxiliary_bearing === bearing.name),
    quantities: Object.fromEntries(of(Object.entries(run.quantities))),
    summary: { ...run.summary, ...bearing, inputs: plain },
  };
}

// Each machine once: of runs that are bearings of one its whole, with the colour of the first.
function wholesOf(runs) {
  const machines = machinesOf(runs);
  return machines.map(([first]) => (first.whole ? { ...first.whole, colour: first.colour, prefix: machines.length > 1 ? first.whole.prefix : "" } : first));
}

// What begins the names of the results of a coast-down.
const COAST_DOWN = "coast_down.";

// Results that a figure shows, in the order of their table: name, result, the words that the figure has for it, and its number.
function shownIn(run, figure) {
  const found = Object.entries(run.quantities).filter(([, quantity]) => quantity && quantity.shown && figure in quantity.shown);
  return found.map(([name, quantity]) => ({ name, quantity, words: quantity.shown[figure], value: isNumber(quantity.value) ? quantity.value : null }));
}

// The columns of a table that a figure shows, by their words: numbers, or the lines of a text.
function tableOf(run, figure) {
  const columns = shownIn(run, figure);
  return (words) => {
    const { value } = (columns.find((column) => column.words === words) || { quantity: {} }).quantity;
    return typeof value === "string" ? value.split("\n").filter(Boolean) : list(value);
  };
}

// The rows of a table of several results each, by what their names have before the last point.
function rowsIn(run, figure) {
  const rows = new Map();
  for (const entry of shownIn(run, figure)) {
    const key = entry.name.slice(0, entry.name.lastIndexOf("."));
    if (!rows.has(key)) rows.set(key, []);
    rows.get(key).push(entry);
  }
  return [...rows];
}

// Units other than those of results that the words of a figure may ask for.
const ASKED_UNITS = { "[%]": ["%", 100], "[Hz]": ["Hz", 1 / (2 * Math.PI)], "[deg]": ["deg", 180 / Math.PI] };

// The unit and the factor that words ask for; none where they leave both to the size of the value.
function askedUnit(words) {
  return ASKED_UNITS[(/\[.*\]$/.exec(words) || [])[0]];
}

// A number in the unit that its words ask for, else in the one in which it reads best.
function numberIn(words, value, unit, digits) {
  const [own, factor] = askedUnit(words) || [];
  return own ? `${numberText(factor * value, digits)} ${own}` : engineeringText(value, unit, digits);
}

// What a result says in a table; its reason where it has no value.
function cellOf({ quantity, words, value }) {
  if (value !== null) return numberIn(words, value, quantity.unit, 5);
  return typeof quantity.value === "string" ? quantity.value : element("span", { class: "absent" }, quantity.why || "–");
}

// Instant of the release, from the start of the run, s: null of magnets that keep their power.
function releaseTime(run) {
  return (run.quantities.release_time || {}).value;
}

function releaseOf(run) {
  return releaseTime(run) || 0;
}

// What instants of contact, spin-up and whirl count from; magnets that keep their power release nothing.
function countedFrom(run) {
  return releaseTime(run) === null ? "the start" : "the release";
}

// Instants worth a mark on the axis of time, which begins with the run; a release that is its start needs none. Of more than two runs the
// words would cover each other: the headlines alone, the others are in the table.
function instantsOf(runs, colour = SERIES_COLOURS.quiet) {
  const colourOf = (run, words) => (runs.length > 1 ? run.colour : SERIES_COLOURS[words.split(" ")[0]] || (/^release|limit$/.test(words) ? SERIES_COLOURS.limit : colour));
  const own = ({ name, quantity, value }) => value !== null && !name.startsWith(COAST_DOWN) && (runs.length <= 2 || quantity.shown.headline);
  return runs.flatMap((run) =>
    [["instants", 0], ["instants_after_release", releaseOf(run)]]
      .flatMap(([figure, from]) => shownIn(run, figure).filter(own).map(({ words, value }) => ({ instant: value + from, words: run.prefix + words, colour: colourOf(run, words) })))
      .filter(({ instant }) => instant > 0),
  );
}

// Letter, directory and title of a run among several; a directory that is called as its letter is not said twice. Tables and small
// pictures have room for the letter and the directory alone.
function runLabel(run, letter, ofOne) {
  if (ofOne) return `${letter} · ${run.summary.name || run.name}`;
  const parts = [letter, run.name === letter ? null : run.name, run.summary.title && run.summary.title !== run.name ? run.summary.title : null];
  return parts.filter(Boolean).join(" · ");
}

function readRuns() {
  const blocks = [...document.querySelectorAll("script.run")];
  const runs = blocks.map((block) => readRun(block.textContent)).flatMap((run) => {
    const bearings = list(run.summary.auxiliary_bearings).filter((bearing) => bearing && bearing.name);
    return bearings.length ? bearings.map((bearing) => ofBearing(run, bearing, bearings.map(({ name }) => name))) : [run];
  });
  return runs.map((run, index) => {
    const letter = String.fromCharCode(65 + index);
    const several = runs.length > 1;
    return { ...run, letter, label: several ? runLabel(run, letter, ofOneRun(runs)) : run.name, short: several ? `${letter} · ${run.summary.name || run.name}` : run.name, prefix: several ? letter + " " : "", colour: RUN_COLOURS[index % RUN_COLOURS.length] };
  });
}

// The values of a column, or null when the run lacks it, its time or any number in it.
function columnOf(run, name) {
  const column = run.columns.get(name);
  return run.time && column && column.values.some(isNumber) ? column.values : null;
}

function scaledColumn(run, name, scale) {
  const values = columnOf(run, name);
  return values && values.map((value) => (value === null ? null : value * scale));
}

function whyNoColumn(run, names) {
  if (!run.time) return "it has no time history";
  const absent = names.filter((name) => !columnOf(run, name));
  return "its history has no " + absent.join(", ");
}

function quantityOf(run, name) {
  const quantity = run.quantities[name];
  return quantity && typeof quantity === "object" ? quantity : { value: null, why: "this run has no such result" };
}

function numberOf(run, name) {
  const { value } = quantityOf(run, name);
  return isNumber(value) ? value : null;
}

function inputOf(run, path) {
  return list(run.summary.inputs).find((input) => input && input.path === path) || null;
}

// Last row at or before a time.
function rowBefore(time, instant) {
  let low = 0;
  let high = time.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (time[middle] <= instant) low = middle;
    else high = middle - 1;
  }
  return low;
}

function valueAt(time, values, instant) {
  if (!time.length || instant < time[0] || instant > time[time.length - 1]) return null;
  const row = rowBefore(time, instant);
  const [left, right] = [values[row], values[row + 1]];
  if (!isNumber(left) || !isNumber(right) || time[row + 1] === time[row]) return left;
  return left + ((right - left) * (instant - time[row])) / (time[row + 1] - time[row]);
}

// Marks on a curve, and curves through an orbit, are only as good as the rows they are drawn from.
const COARSE_ROWS = 0.5e-3;
const ROWS_A_TURN = 40;

// True when rows on both sides of an instant lie close enough to place a mark between them.
function rowsAround(time, instant) {
  if (!time.length || instant < time[0] || instant > time[time.length - 1]) return false;
  const row = rowBefore(time, instant);
  if (time[row] === instant) return true;
  return instant - time[row] <= COARSE_ROWS && time[row + 1] - instant <= COARSE_ROWS;
}

function medianSpacing(time) {
  const gaps = time.slice(1).map((instant, row) => instant - time[row]);
  gaps.sort((left, right) => left - right);
  return gaps.length ? gaps[gaps.length >> 1] : 0;
}

// What to say about rows too far apart to show an orbit, or null.
function coarseRowsNote(run) {
  const spacing = medianSpacing(run.time);
  const speed = (columnOf(run, "rotor.speed") || []).reduce((most, value) => Math.max(most, Math.abs(value || 0)), 0);
  const limits = [COARSE_ROWS, ...(speed > 0 ? [(2 * Math.PI) / speed / ROWS_A_TURN] : [])];
  // Rows written at just the limit differ from it by rounding.
  if (!(spacing > 1.001 * Math.min(...limits))) return null;
  const turn = speed > 0 ? `, a rotor turn takes ${engineeringText((2 * Math.PI) / speed, "s", 3)}` : "";
  const thinned = run.rows < run.rowsTotal ? ` (this page holds ${run.rows} of ${run.rowsTotal} rows)` : "";
  return `rows every ${engineeringText(spacing, "s", 3)}${thinned}${turn}: the orbit is drawn from rows, not from every step.`;
}

// The balls of a run: one entry each with the columns that exist, or an empty list.
function ballsOf(run) {
  const names = [...run.columns.keys()].map((name) => /^bearing\.(ball_\d+)\.inner_load$/.exec(name)).filter(Boolean);
  return names.map((match) => {
    const part = (name) => columnOf(run, `bearing.${match[1]}.${name}`);
    return {
      name: match[1].replace("_", " "),
      azimuth: part("azimuth"),
      inner_load: part("inner_load"),
      outer_load: part("outer_load"),
      inner_slip: part("inner_slip"),
      outer_slip: part("outer_slip"),
      inner_film: part("inner_film"),
      outer_film: part("outer_film"),
      ...anglesOf(run, match[1]),
    };
  });
}

// Contact angles of a ball in space, deg; null without load.
function anglesOf(run, ball) {
  const degrees = (name) => {
    const values = columnOf(run, `bearing.${ball}.${name}`);
    return values && values.map((value) => (value ? (180 / Math.PI) * value : null));
  };
  return { inner_angle: degrees("inner_angle"), outer_angle: degrees("outer_angle") };
}

// The rows of a bearing in space as runs of their own, by rising place along the shaft; a bearing of one row is its own.
function rowsOf(run) {
  const row = (name) => /^bearing\.ball_(\d+)\./.exec(name);
  const balls = ballsOf(run).length;
  const ofRow = Number((inputOf(run, "bearing.ball_count") || {}).value);
  const count = inSpace([run]).length ? Math.round(balls / ofRow) : 1;
  if (!(count > 1)) return [run];
  return Array.from({ length: count }, (_, k) => {
    const own = ([name]) => !row(name) || Math.floor((Number(row(name)[1]) - 1) / ofRow) === k;
    return { ...run, columns: new Map([...run.columns].filter(own)), short: `${run.short}, row ${k + 1}`, row: k + 1 };
  });
}

// Bearings whose rings move along their axis and tilt.
function inSpace(runs) {
  return runs.filter((run) => columnOf(run, "bearing.inner_race.z"));
}

// Largest size over the balls of one of their columns, row by row.
function largestOverBalls(run, part) {
  const columns = ballsOf(run).map((ball) => ball[part]).filter(Boolean);
  if (!columns.length) return null;
  return run.time.map((_, row) => columns.reduce((most, values) => Math.max(most, Math.abs(values[row] || 0)), 0));
}

function peakContact(run) {
  const known = run.contacts.filter((contact) => isNumber(contact.peak_force_N) && isNumber(contact.peak_time_s));
  return known.reduce((best, contact) => (best && best.peak_force_N >= contact.peak_force_N ? best : contact), null);
}
