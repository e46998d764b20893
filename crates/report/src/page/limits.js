// Limits of the scenario: a tile and a row each, with the verdict.

// Those of a run; of one of several bearings its own and those of the whole machine.
function limitsOf(run) {
  const others = list(run.summary.auxiliary_bearings).filter(({ name }) => name !== run.summary.name);
  return list(run.summary.limits).filter((limit) => limit && !others.some(({ name }) => String(limit.quantity).startsWith(name + ".")));
}

function limitState(limit) {
  return { pass: "good", fail: "bad" }[limit.verdict];
}

function limitName(run, limit) {
  const start = run.summary.name ? run.summary.name + "." : "";
  return wordsOf(start && limit.quantity.startsWith(start) ? limit.quantity.slice(start.length) : limit.quantity);
}

// A temperature, which no rise of one is, in °C.
function limitValue(limit, value, digits) {
  return limit.quantity.endsWith("_temperature") ? `${numberText(value - ZERO_CELSIUS, digits)} °C` : engineeringText(value, limit.unit, digits);
}

function boundText(limit) {
  const share = limit.share < 1 ? `, ${percentText(limit.share)} of the runs` : "";
  return `at ${limit.side} ${limitValue(limit, limit.bound, 4)}${share}`;
}

function limitTiles(run) {
  const tiles = limitsOf(run).map((limit) => {
    const value = isNumber(limit.value) ? limitValue(limit, limit.value, 4) : "–";
    return tile(limitName(run, limit), limit.verdict, [`${value}; ${boundText(limit)}`], limitState(limit));
  });
  return tiles.length ? element("div", { class: "tiles limits" }, tiles) : null;
}

function limitSection(runs) {
  const several = runs.length > 1;
  const heads = [...(several ? ["Run"] : []), "Limit", "Bound", "Value", "Verdict", "Why"];
  const row = (run, limit) =>
    element(
      "tr",
      {},
      several ? element("td", {}, run.short) : null,
      element("td", { class: "name" }, limitName(run, limit), element("code", {}, breakable(limit.quantity))),
      element("td", {}, boundText(limit)),
      element("td", {}, isNumber(limit.value) ? limitValue(limit, limit.value, 5) : "–"),
      element("td", {}, element("strong", {}, limit.verdict)),
      element("td", { class: "small" }, limit.why),
    );
  const rows = runs.flatMap((run) => limitsOf(run).map((limit) => row(run, limit)));
  const repeated = runs.some((run) => limitsOf(run).some((limit) => limit.members > 1));
  const note = repeated ? element("p", { class: "lead" }, "Of a repeated run the value is the one that the share of the members holds: of all of them the worst.") : null;
  return section("limits", "Limits", note, tableOfRows("held", heads, rows));
}
