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
