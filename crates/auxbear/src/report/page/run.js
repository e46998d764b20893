// The runs as the page received them, and safe access to what may be absent.

function decodeColumn(column) {
  const bytes = Uint8Array.from(atob(column.data), (letter) => letter.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const wide = column.type === "f64";
  const values = new Array(bytes.length / (wide ? 8 : 4));
  for (let row = 0; row < values.length; row++) {
    const value = wide ? view.getFloat64(8 * row, true) : view.getFloat32(4 * row, true);
    values[row] = Number.isFinite(value) ? value : null;
  }
  return { name: column.name, unit: column.unit, meaning: column.meaning, values };
}

function readRun(text, index, count) {
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
  const columns = new Map(list(raw.columns).map((column) => [column.name, decodeColumn(column)]));
  const letter = String.fromCharCode(65 + index);
  const name = raw.name || summary.title || raw.directory || "run";
  return {
    letter,
    name,
    label: count > 1 ? letter + " · " + name : name,
    prefix: count > 1 ? letter + " " : "",
    directory: raw.directory,
    scenario: raw.scenario,
    summary,
    summaryProblem,
    columns,
    rows: raw.rows,
    rowsTotal: raw.rows_total,
    colour: RUN_COLOURS[index % RUN_COLOURS.length],
    time: columns.has("time") ? columns.get("time").values : null,
    contacts: list(summary.contacts).filter((contact) => contact && isNumber(contact.start_s)),
    quantities: summary.quantities && typeof summary.quantities === "object" ? summary.quantities : {},
  };
}

function readRuns() {
  const blocks = [...document.querySelectorAll("script.run")];
  return blocks.map((block, index) => readRun(block.textContent, index, blocks.length));
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
  return quantity && typeof quantity === "object" ? quantity : { value: null, why: "the summary does not hold it" };
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
      pocket_force: part("pocket_force"),
    };
  });
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
