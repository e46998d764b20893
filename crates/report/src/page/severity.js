// Which margin of a run is smallest: indices that are 1 at their limit, of a drop until standstill those of its run-out too, distances along
// the shaft, severe warnings, limits of the file.

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

// Distances along the shaft, severe warnings and limits of the file: what a machine has besides the indices of its bearings. Of a
// warning no share is known: it stands at its limit. What rubs is said by its distance.
function marginRows(machine) {
  const distances = distancesOf(machine).map(({ name, clearance, displacement }) => ({ name: `node.${name}`, words: `Clearance at ${wordsOf(name)}`, share: displacement / clearance, limit: `the shaft moves by ${engineeringText(displacement, "m", 4)} of ${engineeringText(clearance, "m", 4)}` }));
  const severe = list(machine.summary.warnings).filter((warning) => warning && isSevere(warning) && !(warning.code === RUB && distances.length));
  const warned = severe.map(({ code, text }) => ({ name: code, words: "Severe warning", share: Infinity, state: "severe", limit: text }));
  const held = limitsOf(machine).map((limit) => {
    const [part, whole] = limit.side === "most" ? [limit.value, limit.bound] : [limit.bound, limit.value];
    const known = limit.verdict !== "undecided" && isNumber(limit.value) && part >= 0 && whole > 0;
    const share = known ? part / whole : limit.verdict === "fail" ? Infinity : null;
    return { name: limit.quantity, words: `Limit: ${limitName(machine, limit)}`, share, limit: boundText(limit), why: `${limit.verdict}: ${limit.why}` };
  });
  return [...distances, ...warned, ...held];
}

function marginsOf(bearings) {
  const indices = bearings.flatMap((run) => indexRows(run).map(({ name, words, quantity }) => ({ name, words: bearings.length > 1 ? `${run.summary.name}: ${words}` : words, share: isNumber(quantity.value) ? quantity.value : null, limit: `${quantity.law}; ${quantity.valid}`, why: quantity.why })));
  const rank = ({ share }) => (share === null ? -1 : share === Infinity ? 1 : share);
  return [...indices, ...marginRows(bearings[0].whole || bearings[0])].sort((one, other) => (rank(other) === rank(one) ? 0 : rank(other) - rank(one)));
}

function severitySection(runs) {
  const machines = machinesOf(runs);
  const several = machines.length > 1;
  const heads = [...(several ? ["Run"] : []), "What", "Share of its limit", "Limit"];
  const share = ({ share: part, state, why }) => {
    if (part === null) return element("span", { class: "absent" }, "not known: " + why);
    return element("strong", { class: part > 1 ? "failed" : null }, part === Infinity ? state || "exceeded" : percentText(part));
  };
  const row = (bearings, entry) =>
    element(
      "tr",
      {},
      several ? element("td", {}, bearings.length > 1 ? bearings[0].whole.short : bearings[0].short) : null,
      element("td", { class: "name" }, entry.words, element("code", {}, breakable(entry.name))),
      element("td", {}, share(entry)),
      element("td", { class: "small" }, entry.limit),
    );
  const rows = machines.flatMap((bearings) => marginsOf(bearings).map((entry) => row(bearings, entry)));
  const lead = element("p", { class: "lead" }, "The smallest margin first. Fracture of the cage, smearing, spalls that grow from dents, life of the lubricant and whirl have no index here: they may decide all the same.");
  return section("severity", "Smallest margins", lead, element("table", { class: "held" }, element("thead", {}, element("tr", {}, heads.map((words) => element("th", {}, words)))), element("tbody", {}, rows)));
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

// Repetitions beyond which fatigue decides nothing: makers allow some dozen drops at most.
const MANY_REPETITIONS = 1000;
const REPETITIONS = /^(drops|runs)_until_/;

// The rows of a run: where 1 % fail after very many repetitions, one that says so.
function lifeRows(run) {
  const known = LIFE.filter(([name]) => run.quantities[name]);
  const counts = known.filter(([name]) => REPETITIONS.test(name));
  const first = counts.map(([name]) => run.quantities[name].value).find(isNumber);
  if (!(first > MANY_REPETITIONS)) return known;
  const share = numberOf(run, "life_share_with_lubricant") ?? numberOf(run, "life_share");
  return [...known.filter((entry) => !counts.includes(entry)), ["drops_until_ten_percent_fail", "Drops until bearings fail", `fatigue is not decisive (life share ${numberText(share, 2)})`]];
}

function lifeSection(runs) {
  const several = runs.length > 1;
  const repeated = runs.some((run) => LIFE.some(([name]) => quantityOf(run, name).spread));
  const heads = [...(several ? ["Run"] : []), "Rolling fatigue", "Of this run", ...(repeated ? ["5 to 95 % of repeated runs"] : [])];
  const known = ({ value, why }) => (isNumber(value) ? element("strong", {}, numberText(value, 3)) : element("span", { class: "absent" }, "not known: " + why));
  const between = ({ spread }) => (spread ? `${numberText(spread.q05, 3)} to ${numberText(spread.q95, 3)} (${spread.members} runs)` : "–");
  const row = (run, [name, words, said]) => element("tr", {}, several ? element("td", {}, run.short) : null, element("td", { class: "name" }, words, said ? null : element("code", {}, name)), element("td", {}, said || known(run.quantities[name])), repeated ? element("td", {}, said ? "–" : between(run.quantities[name])) : null);
  const rows = runs.flatMap((run) => lifeRows(run).map((entry) => row(run, entry)));
  const lead = element("p", { class: "lead" }, "Rolling fatigue rarely decides a drop: dents, cage, lubricant, wear, smearing and heat end auxiliary bearings first. 1, 10 and 50\u00a0% are the scatter of single bearings under equal drops (Weibull, slope 10/9)" + (repeated ? "; how drops differ stands apart from it" : "") + ". One bearing; a drop that goes on until standstill counts with its run-out. The factor of the lubricant is taken where it is known. An order, never a promise.");
  return section("life", "Life by rolling fatigue", lead, element("table", { class: "held" }, element("thead", {}, element("tr", {}, heads.map((words) => element("th", {}, words)))), element("tbody", {}, rows)));
}

const LIMIT_SECTIONS = (runs) => [[85, severitySection, runs.filter((run) => marginsOf([run]).length)], [86, lifeSection, runs.filter((run) => run.quantities.life_share)]].filter(([, , some]) => some.length);
