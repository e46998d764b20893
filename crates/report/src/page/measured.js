// Measured channels beside the columns that they measure: both curves, their difference, features of both.

// Measured columns by the column that they stand beside; of drops after the first their number follows it.
function measuredOf(run) {
  const found = new Map();
  for (const name of run.columns.keys()) {
    const match = /^measured\.(.+?)(?:\.drop_(\d+))?$/.exec(name);
    if (match) found.set(match[1], [...(found.get(match[1]) || []), { name, drop: match[2] || "" }]);
  }
  return found;
}

function measuredFigure(run, column, channels) {
  const { unit } = run.columns.get(column) || run.columns.get(channels[0].name);
  const [shown, scale] = axisUnit([run], column, unit);
  const values = (name) => scaledColumn(run, name, 1 / scale);
  const predicted = values(column);
  const title = `${run.prefix}${column}`;
  if (!predicted) return figure(title, null, notInThisRun(whyNoColumn(run, [column]), run));
  const known = channels.filter(({ name }) => columnOf(run, name));
  const several = channels.some(({ drop }) => drop);
  const words = ({ drop }) => (several ? `measured, drop ${drop || 1}` : "measured");
  const line = (label, own, look) => ({ label: `${label} [${shown}]`, time: run.time, values: own, gaps: true, ...look });
  const of = (channel, index) => ({ colour: RUN_COLOURS[index % RUN_COLOURS.length], width: 1.25 });
  const both = [line("predicted", predicted, { colour: INK, width: 1.75 }), ...known.map((channel, index) => line(words(channel), values(channel.name), of(channel, index)))];
  const apart = (channel) => values(channel.name).map((value, row) => (isNumber(value) && isNumber(predicted[row]) ? value - predicted[row] : null));
  const differences = known.map((channel, index) => line(`${words(channel)} less predicted`, apart(channel), of(channel, index)));
  const drawn = (series, label, height) =>
    systemOf(run).time
      ? timePlot({ series, label: `${label} [${shown}]`, height })
      : curves({ series: series.map((own) => ({ ...own, x: own.time, y: own.values, gaps: true })), across: "time [s]", upright: `${label} [${shown}]`, height });
  const note = run.columns.get(channels[0].name).meaning;
  return figure(title, note.charAt(0).toUpperCase() + note.slice(1) + ".", drawn(both, "value", 250), differences.length ? drawn(differences, "difference", 150) : null);
}

// A row a channel with all its differences.
function differenceTable(run) {
  const rows = rowsIn(run, "measured_difference");
  const heads = [...new Set(rows.flatMap(([, entries]) => entries.map(({ words }) => words)))];
  const cell = (entries, head) => element("td", {}, entries.filter(({ words }) => words === head).map(cellOf));
  const head = (words) => words.replace(/ \[.*\]$/, "");
  const body = rows.map(([key, entries]) => element("tr", {}, element("td", { class: "name" }, element("code", {}, key.slice("measured.".length))), heads.map((words) => cell(entries, words))));
  return tableOfRows("held", ["Channel", ...heads.map(head)], body);
}

function featureTable(run) {
  const rows = rowsIn(run, "measured_features");
  if (!rows.length) return null;
  const spreadOf = ({ quantity, words, value }) => (value === null ? "–" : numberIn(words, value, quantity.unit, 2));
  const body = rows.map(([key, entries]) => {
    const side = (end) => element("td", {}, entries.filter(({ name }) => name.endsWith(`.${end}`)).map(end.endsWith("uncertainty") ? spreadOf : cellOf));
    const channel = key.slice("measured.".length, key.lastIndexOf("."));
    return element("tr", {}, element("td", { class: "name" }, element("code", {}, channel)), element("td", {}, entries[0].words.replace(/ \[.*\]$/, "")), ["measured", "uncertainty", "predicted", "difference", "difference_uncertainty"].map(side));
  });
  return tableOfRows("held", ["Channel", "Feature", "Measured", "Uncertainty", "Predicted", "Difference", "Uncertainty"], body);
}

function measuredSection(runs) {
  const lead = element("p", { class: "lead" }, "At the samples of the file within the run; differences are measured less predicted. Features of both curves by the same estimator with standard uncertainties, instants after the release. The phase at the release is an input: impacts after the first depend on it.");
  const of = (run) => [...[...measuredOf(run)].map(([column, channels]) => measuredFigure(run, column, channels)), differenceTable(run), featureTable(run)];
  return section("measured", "Measured beside predicted", lead, runs.map(of));
}
