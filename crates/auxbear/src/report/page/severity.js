// Which limit of a run is nearest: the indices that are 1 at their limit, in order; of a drop until standstill those of its run-out too.

const INDICES = [
  ["Dents of balls and races", ["indentation_index"]],
  ["Contact of rotor and race too hot", ["contact_temperature_index"]],
  ["Balls that skid too hot", ["skid_temperature_index"]],
  ["Bodies too warm", ["rotor", "inner_race", "balls", "cage", "lubricant", "outer_race"].map((node) => `${node}_temperature_index`)],
  ["Inner race too warm, were it not cooled", ["heat_index"]],
];

// A result of a bearing and the same of its run-out.
const withRunOut = (name) => [name, `run_out.${name}`];

// Of what has several indices the nearest to its limit; the race that is not cooled only where nothing follows its warmth.
function indexRows(run) {
  const value = ({ quantity }) => (isNumber(quantity.value) ? quantity.value : -1);
  const nearest = ([words, names]) =>
    names
      .flatMap(withRunOut)
      .map((name) => ({ name, words: name.startsWith("run_out.") ? `${words}, running out` : words, quantity: run.quantities[name] }))
      .filter(({ quantity }) => quantity)
      .sort((one, other) => value(other) - value(one))[0];
  const known = INDICES.map(nearest).filter(Boolean);
  const followed = known.some(({ name }) => name.endsWith("_temperature_index") && !/contact|skid/.test(name));
  return known.filter(({ name }) => !(followed && name === "heat_index")).sort((one, other) => value(other) - value(one));
}

function severitySection(runs) {
  const several = runs.length > 1;
  const heads = [...(several ? ["Run"] : []), "What", "Share of its limit", "Limit"];
  const share = ({ value, why }) => (isNumber(value) ? element("strong", {}, percentText(value)) : element("span", { class: "absent" }, "not known: " + why));
  const row = (run, { name, words, quantity }) =>
    element(
      "tr",
      {},
      several ? element("td", {}, run.short) : null,
      element("td", { class: "name" }, words, element("code", {}, name)),
      element("td", {}, share(quantity)),
      element("td", { class: "small" }, `${quantity.law}; ${quantity.valid}`),
    );
  const rows = runs.flatMap((run) => indexRows(run).map((entry) => row(run, entry)));
  const lead = element("p", { class: "lead" }, "The nearest first. Fracture of the cage, smearing, spalls that grow from dents, life of the lubricant and whirl have no index here: they may decide all the same.");
  return section("severity", "Nearest limit", lead, element("table", { class: "held" }, element("thead", {}, element("tr", {}, heads.map((words) => element("th", {}, words)))), element("tbody", {}, rows)));
}

// Rolling fatigue of a drop: the scatter of single bearings by Weibull, and apart from it the spread of repeated runs.
const LIFE = [
  ["life_share", "Share of the life L10 that it uses"],
  ["run_out.life_share", "Share that the run-out uses"],
  ["life_share_with_lubricant", "Share with lubricant, cleanliness and warmth"],
  ["run_out.life_share_with_lubricant", "The same of the run-out"],
  ...["one", "ten", "fifty"].map((words) => [`drops_until_${words}_percent_fail`, `Drops until ${{ one: 1, ten: 10, fifty: 50 }[words]} % of bearings have failed`]),
  ...[["one_percent", "1 %"], ["ten_percent", "10 %"], ["half", "half"]].map(([name, words]) => [`runs_until_${name}_fail`, `Run-outs until ${words} of bearings have failed`]),
];

function lifeSection(runs) {
  const several = runs.length > 1;
  const repeated = runs.some((run) => LIFE.some(([name]) => quantityOf(run, name).spread));
  const heads = [...(several ? ["Run"] : []), "Rolling fatigue", "Of this run", ...(repeated ? ["5 to 95 % of repeated runs"] : [])];
  const known = ({ value, why }) => (isNumber(value) ? element("strong", {}, numberText(value, 3)) : element("span", { class: "absent" }, "not known: " + why));
  const between = ({ spread }) => (spread ? `${numberText(spread.q05, 3)} to ${numberText(spread.q95, 3)} (${spread.members} runs)` : "–");
  const row = (run, [name, words]) => element("tr", {}, several ? element("td", {}, run.short) : null, element("td", { class: "name" }, words, element("code", {}, name)), element("td", {}, known(run.quantities[name])), repeated ? element("td", {}, between(run.quantities[name])) : null);
  const rows = runs.flatMap((run) => LIFE.filter(([name]) => run.quantities[name]).map((entry) => row(run, entry)));
  const lead = element("p", { class: "lead" }, "Rolling fatigue rarely decides a drop: dents, cage, lubricant, wear, smearing and heat end auxiliary bearings first. 1, 10 and 50\u00a0% are the scatter of single bearings under equal drops (Weibull, slope 10/9)" + (repeated ? "; how drops differ stands apart from it" : "") + ". One bearing; a drop that goes on until standstill counts with its run-out. The factor of the lubricant is taken where it is known. An order, never a promise.");
  return section("life", "Life by rolling fatigue", lead, element("table", { class: "held" }, element("thead", {}, element("tr", {}, heads.map((words) => element("th", {}, words)))), element("tbody", {}, rows)));
}

const LIMIT_SECTIONS = (runs) => [[85, severitySection, runs.filter((run) => indexRows(run).length)], [86, lifeSection, runs.filter((run) => run.quantities.life_share)]].filter(([, , some]) => some.length);
