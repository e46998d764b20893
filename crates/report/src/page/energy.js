// Where the energy came from and where it went.

const HEAT_PREFIX = "energy.heat.";
const SOURCE_PREFIX = "energy.source.";

// Columns of one kind of flow: of a bearing its own and those of the machine, of a whole machine those of every bearing under its name.
function columnsUnder(run, prefix) {
  const own = [...run.columns.keys()].filter((name) => (name.startsWith(prefix) || name.includes("." + prefix)) && columnOf(run, name));
  return own.map((name) => ({ key: name.replace(prefix, ""), name: wordsOf(name.replace(prefix, "")), values: columnOf(run, name) }));
}

function lastNumber(values) {
  for (let row = values.length - 1; row >= 0; row--) if (isNumber(values[row])) return values[row];
  return 0;
}

function change(values) {
  return lastNumber(values) - (values.find(isNumber) || 0);
}

// Largest heat first, each in the colour of its name: the same in the history, in the bars and in every report.
function heatsOf(run) {
  const heats = columnsUnder(run, HEAT_PREFIX).map((heat) => ({ ...heat, final: lastNumber(heat.values) }));
  heats.sort((left, right) => right.final - left.final);
  return heats.map((heat) => ({ ...heat, colour: HEAT_COLOURS[heat.key.split(".").pop()] || HEAT_WITHOUT_NAME }));
}

function heatHistory(run, runs) {
  const all = heatsOf(run).filter((heat) => heat.final > 0);
  // bands that no picture shows stand in the balance below
  const heats = all.filter((heat) => heat.final > 1e-3 * all[0].final);
  const title = (runs.length > 1 ? run.short + ": " : "") + "Heat over time";
  if (!heats.length) return figure(title, null, notInThisRun(run.time ? "its history has no heats" : "it has no time history"));
  const sums = [];
  let below = run.time.map(() => 0);
  for (const heat of [...heats].reverse()) {
    below = below.map((sum, row) => sum + (heat.values[row] || 0));
    sums.unshift(below);
  }
  // The tallest sum is painted first, the smaller ones over it: the largest heat lies on top of the small ones.
  const series = heats.map((heat, index) => ({
    label: heat.name + " [J]",
    time: run.time,
    values: sums[index],
    shown: heat.values,
    colour: heat.colour,
    fill: heat.colour,
    width: 0.5,
  }));
  return figure(title, "Stacked: each band is one kind of heat, the upper edge their sum." + (all.length > heats.length ? " Heats below a thousandth of the largest stand in the balance alone." : ""), timePlot({ series, label: "energy [J]", stacked: true, height: 240 }));
}

// Every entry with a positive amount, on the side of the balance where it stands.
function balance(run) {
  const came = [];
  const went = heatsOf(run).filter((heat) => heat.final !== 0).map((heat) => ({ name: "heat: " + heat.name, amount: heat.final, colour: heat.colour }));
  const enter = (name, gain) => {
    if (gain < 0) came.push({ name, amount: -gain, colour: SERIES_COLOURS.rotor });
    else went.push({ name, amount: gain, colour: SERIES_COLOURS.quiet });
  };
  for (const [name, words] of [["energy.kinetic", "net change of kinetic energy of all bodies"], ["energy.potential", "net change of potential energy"]]) {
    const values = columnOf(run, name);
    if (values) enter(words, change(values));
  }
  for (const source of columnsUnder(run, SOURCE_PREFIX)) {
    const amount = change(source.values);
    if (amount === 0) continue;
    if (amount > 0) came.push({ name: "source: " + source.name, amount, colour: SERIES_COLOURS.cage });
    else went.push({ name: "taken out: " + source.name, amount: -amount, colour: SERIES_COLOURS.limit });
  }
  // rings that close on their balls as they warm
  const rings = shownIn(run, "sources").map(({ value }) => value || 0).find(Boolean) || 0;
  if (rings !== 0) (rings > 0 ? came : went).push({ name: "work of warm rings", amount: Math.abs(rings), colour: SERIES_COLOURS.cage });
  const missed = columnOf(run, "energy.residual") ? lastNumber(columnOf(run, "energy.residual")) : 0;
  if (missed !== 0) (missed > 0 ? went : came).push({ name: "residual", amount: Math.abs(missed), colour: SERIES_COLOURS.limit });
  const bySize = (left, right) => right.amount - left.amount;
  return { came: came.sort(bySize), went: went.sort(bySize) };
}

function barRows(entries, largest, total) {
  return entries.map((entry) =>
    element(
      "tr",
      {},
      element("td", { class: "name" }, entry.name),
      element("td", { class: "bar" }, element("div", { style: `width:${Math.max(0, (100 * entry.amount) / largest)}%;background:${entry.colour}` })),
      element("td", {}, engineeringText(entry.amount, "J", 5)),
      element("td", {}, total > 0 ? percentText(entry.amount / total) : "–"),
    ),
  );
}

function balanceFigure(run, runs) {
  const title = (runs.length > 1 ? run.short + ": " : "") + "Energy balance over the whole run";
  const { came, went } = balance(run);
  if (!came.length && !went.length) return figure(title, null, notInThisRun(run.time ? "its history has no energies" : "it has no time history"));
  const sum = (entries) => entries.reduce((total, entry) => total + entry.amount, 0);
  const [supplied, used] = [sum(came), sum(went)];
  const largest = Math.max(1e-300, ...[...came, ...went].map((entry) => entry.amount));
  const head = (words, total) => element("tr", { class: "head" }, element("th", { colspan: 2 }, words), element("td", {}, engineeringText(total, "J", 5)), element("td", {}, "100 %"));
  const residual = columnOf(run, "energy.residual");
  return figure(
    title,
    "Sources = change of stored energy + heats of all bearings + residual. Every entry stands on the side where its amount is positive.",
    element(
      "table",
      { class: "bars" },
      element("tbody", {}, head("Came from", supplied), barRows(came, largest, supplied)),
      element("tbody", {}, head("Went to", used), barRows(went, largest, used)),
    ),
    residual
      ? element("p", {}, `Residual at the end: ${engineeringText(lastNumber(residual), "J", 3)}.`)
      : notInThisRun("an energy residual over time"),
  );
}

function energySection(runs) {
  const absentSources = runs.filter((run) => run.time && !columnsUnder(run, SOURCE_PREFIX).length);
  const totals = runs.length > 1 ? totalHeatFigure(runs) : null;
  return section(
    "energy",
    "Energy balance",
    totals,
    runs.map((run) => heatHistory(run, runs)),
    wholesOf(runs).map((machine, _, machines) => balanceFigure(machine, machines)),
    absentSources.map((run) => notInThisRun("energy sources: nothing drives or brakes this machine, or its history does not say", run)),
  );
}

function totalHeatFigure(runs) {
  const series = runs.flatMap((run) => {
    const heats = heatsOf(run);
    if (!heats.length) return [];
    const values = run.time.map((_, row) => heats.reduce((sum, heat) => sum + (heat.values[row] || 0), 0));
    return [{ label: run.prefix + "all heats [J]", time: run.time, values, colour: run.colour, width: 1.5 }];
  });
  return series.length ? figure("Sum of all heats", null, timePlot({ series, label: "energy [J]", height: 220 })) : null;
}
