// Dynamic stiffness of mounts over frequency, part by part, and the fit to a measured one.

// Names of columns before their last point, in their order.
function mountParts(run) {
  return [...run.columns.keys()].map((name) => /^(.+)\.storage$/.exec(name)).filter(Boolean).map(([, part]) => part);
}

function mountCurves(run, parts, end, upright) {
  const x = overSpeed(run, "frequency");
  const series = parts.map((part, index) => ({ label: part.split(".").pop().replace(/_/g, " "), x, y: overSpeed(run, `${part}.${end}`) || [], colour: /\.sum$|^fit$/.test(part) ? INK : LINE_COLOURS[index % LINE_COLOURS.length], width: /\.sum$|^fit$/.test(part) ? 2.5 : null, line: part !== "measured", dots: part === "measured", gaps: true }));
  return curves({ series: series.filter(({ y }) => y.some((value) => value > 0)), across: "frequency [rad/s]", upright, logarithmic: true, decades: true, height: 300 });
}

function mountFigures(run, runs) {
  const all = mountParts(run);
  const fitted = all.filter((part) => part === "fit" || part === "measured");
  const names = [...new Set(all.filter((part) => !fitted.includes(part)).map((part) => part.split(".")[0]))];
  const group = (name) => all.filter((part) => part.startsWith(`${name}.`));
  const figures = names.map((name) => figure(shareOfRun(run, runs, `Dynamic stiffness: ${name}`), "K' in phase with the displacement, K'' with the velocity; their quotient is the loss factor.", factTable(rowsIn(run, "mounts").filter(([begin]) => begin === name).flatMap(([, entries]) => entries)), mountCurves(run, group(name), "storage", "K' [N/m]"), mountCurves(run, group(name), "loss", "K'' [N/m]"), mountCurves(run, [`${name}.sum`], "loss_factor", "loss factor")));
  const fit = fitted.length ? figure(shareOfRun(run, runs, "Spring, damper and branches fitted to the table"), "Distances are over the size of the measured stiffness.", plainTable(["", ""], shownIn(run, "fit").map((entry) => [entry.words, element("span", { style: "white-space: pre" }, cellOf(entry))])), mountCurves(run, fitted, "storage", "K' [N/m]"), mountCurves(run, fitted, "loss", "K'' [N/m]")) : null;
  return [fit, ...figures];
}

function mountSection(runs) {
  return section("mounts", "Mounts", runs.map((run) => mountFigures(run, runs)));
}

register("mount", {
  line: () => null,
  verdict: (run) => element("div", { class: "tiles" }, stateTile(run), tilesOf(run)),
  time: null,
  facts: false,
  sections: (runs) => [[20, mountSection, runs]],
});
