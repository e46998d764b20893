// Which limit of a drop is nearest: the indices that are 1 at their limit, in order.

const INDICES = [
  ["indentation_index", "Dents of balls and races"],
  ["contact_temperature_index", "Contact of rotor and race too hot"],
  ["skid_temperature_index", "Balls that skid too hot"],
  ["heat_index", "Inner race too warm"],
];

function indexRows(run) {
  const known = INDICES.map(([name, words]) => ({ name, words, quantity: run.quantities[name] })).filter(({ quantity }) => quantity);
  const value = ({ quantity }) => (isNumber(quantity.value) ? quantity.value : -1);
  return known.sort((one, other) => value(other) - value(one));
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
  ["life_share", "Share of the life L10 that a drop uses"],
  ["life_share_with_lubricant", "The same with lubricant, cleanliness and warmth"],
  ["drops_until_one_percent_fail", "Drops until 1 % of bearings have failed"],
  ["drops_until_ten_percent_fail", "Drops until 10 % of bearings have failed"],
  ["drops_until_fifty_percent_fail", "Drops until 50 % of bearings have failed"],
];

function lifeSection(runs) {
  const several = runs.length > 1;
  const repeated = runs.some((run) => LIFE.some(([name]) => quantityOf(run, name).spread));
  const heads = [...(several ? ["Run"] : []), "Rolling fatigue", "Of this drop", ...(repeated ? ["5 to 95 % of repeated drops"] : [])];
  const known = ({ value, why }) => (isNumber(value) ? element("strong", {}, numberText(value, 3)) : element("span", { class: "absent" }, "not known: " + why));
  const between = ({ spread }) => (spread ? `${numberText(spread.q05, 3)} to ${numberText(spread.q95, 3)} (${spread.members} drops)` : "–");
  const row = (run, [name, words]) => element("tr", {}, several ? element("td", {}, run.short) : null, element("td", { class: "name" }, words, element("code", {}, name)), element("td", {}, known(run.quantities[name])), repeated ? element("td", {}, between(run.quantities[name])) : null);
  const rows = runs.flatMap((run) => LIFE.filter(([name]) => run.quantities[name]).map((entry) => row(run, entry)));
  const lead = element("p", { class: "lead" }, "Rolling fatigue rarely decides a drop: dents, cage, lubricant, wear, smearing and heat end auxiliary bearings first. 1, 10 and 50\u00a0% are the scatter of single bearings under equal drops (Weibull, slope 10/9)" + (repeated ? "; how drops differ stands apart from it" : "") + ". One bearing, what was computed ball by ball; the factor of the lubricant is taken where it is known. An order, never a promise.");
  return section("life", "Life by rolling fatigue", lead, element("table", { class: "held" }, element("thead", {}, element("tr", {}, heads.map((words) => element("th", {}, words)))), element("tbody", {}, rows)));
}
