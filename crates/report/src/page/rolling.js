// A machine's rotor as it rolls on its auxiliary bearings: the figures of a rotor once more, of other results.

// What begins the names of its results and columns.
const ROLLING = "on_auxiliary_bearings.";

// A run with the results and columns of one of both analyses, and with the rows of its history that belong to it. What the rotor itself is stays.
function analysisOf(run, rolls) {
  const own = (name) => name.startsWith(ROLLING) === rolls;
  const plain = (name) => (own(name) && rolls ? name.slice(ROLLING.length) : name);
  const both = ["rated", "nodes"];
  const entries = Object.entries(run.quantities).filter(([name, { shown }]) => own(name) || both.some((figure) => figure in (shown || {})));
  const columns = [...run.columns].filter(([name]) => name !== "speed" && own(name));
  const speed = run.columns.get("speed");
  const rows = speed ? speed.values.map((_, row) => row).filter((row) => columns.some(([, column]) => isNumber(column.values[row]))) : [];
  const kept = (name, column) => [plain(name), { ...column, name: plain(name), values: rows.map((row) => column.values[row]) }];
  return {
    ...run,
    quantities: Object.fromEntries(entries.map(([name, quantity]) => [plain(name), quantity])),
    columns: new Map([...(speed ? [["speed", speed]] : []), ...columns].map(([name, column]) => kept(name, column))),
  };
}

function rollingFigures(run, runs) {
  const of = (figureName, begin) => rowsIn(run, figureName).map(([key, entries]) => [key.slice(begin.length), ...entries.map(cellOf)]);
  const heads = rowsIn(run, "rolling_bearings").slice(0, 1).flatMap(([, entries]) => entries.map(({ words }) => words));
  const distances = of("rolling_distances", `${ROLLING}node.`);
  const [from, to] = ["from", "to"].map(tableOf(run, "rolling_left_out"));
  const left = from.map((low, k) => `${numberText(low, 4)} to ${numberText(to[k], 4)} rad/s`).join(", ");
  const outside = left ? ` At ${left} the linear answer does not hold: these speeds do not count here.` : "";
  const view = analysisOf(run, true);
  return [
    figure(shareOfRun(run, runs, "Static load and stiffness of each auxiliary bearing"), "Of one row, for small motion about the rest in the bottom of the bore: along the weight contact, balls and mount are in series; across it the rotor is a pendulum whose length is the clearance. Largest force and amplitude are those of unbalance from the rated speed down; where the force exceeds the static load the rotor lifts off.", plainTable(["", ...heads], of("rolling_bearings", ROLLING))),
    distances.length ? figure(shareOfRun(run, runs, "Least distances while it rolls"), `Clearance less the rotor's position at rest and its orbit under unbalance, during the coast-down.${outside}`, plainTable(["place", "least distance", "at"], distances)) : null,
    campbellFigures(view, runs),
    responsePlaces(view).length ? rotorResponseFigures(view, runs) : null,
  ];
}

function rollingSection(runs) {
  return section("rolling", "The rotor on its auxiliary bearings", runs.map((run) => rollingFigures(run, runs)));
}
