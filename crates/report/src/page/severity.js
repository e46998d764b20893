// Which margin of a run is smallest: indices that are 1 at their limit, of a drop until standstill those of its coast-down too, distances along
// the shaft, severe warnings, limits of the file.

// Of the results of one kind, which the table gives in the order of what they know, the last that has a value.
function indexRows(run) {
  const kinds = new Map();
  for (const { name, words, quantity } of shownIn(run, "worst")) {
    const kind = name.startsWith(COAST_DOWN) ? `${words}, coasting down` : words;
    if (isNumber(quantity.value) || !kinds.has(kind)) kinds.set(kind, { name, words: kind, quantity });
  }
  const value = ({ quantity }) => (isNumber(quantity.value) ? quantity.value : -1);
  return [...kinds.values()].sort((one, other) => value(other) - value(one));
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
  return section("severity", "Smallest margins", lead, tableOfRows("held", heads, rows));
}

// Rolling fatigue of a drop: the scatter of single bearings by Weibull, and apart from it the spread of repeated runs.
// Repetitions beyond which fatigue decides nothing: makers allow some dozen drops at most.
const MANY_REPETITIONS = 1000;
// The rows of a run: where 1 % fail after very many repetitions, one that says so. What counts repetitions is no share.
function lifeRows(run) {
  const known = shownIn(run, "life").map((entry) => ({ ...entry, words: entry.name.startsWith(COAST_DOWN) ? `${entry.words}, coasting down` : entry.words }));
  const isCount = ({ words }) => words.includes(" until ");
  const first = known.filter(isCount).map(({ value }) => value).find(isNumber);
  if (!(first > MANY_REPETITIONS)) return known;
  const shares = known.filter((entry) => !isCount(entry));
  const share = shares.filter(({ name, value }) => value !== null && !name.startsWith(COAST_DOWN)).at(-1);
  return [...shares, { words: "Repetitions until bearings fail", said: `fatigue is not decisive (life share ${numberText(share && share.value, 2)})` }];
}

function lifeSection(runs) {
  const several = runs.length > 1;
  const repeated = runs.some((run) => shownIn(run, "life").some(({ quantity }) => quantity.spread));
  const heads = [...(several ? ["Run"] : []), "Rolling fatigue", "Of this run", ...(repeated ? ["5 to 95 % of repeated runs"] : [])];
  const known = ({ value, why }) => (isNumber(value) ? element("strong", {}, numberText(value, 3)) : element("span", { class: "absent" }, "not known: " + why));
  const between = ({ spread }) => (spread ? `${numberText(spread.q05, 3)} to ${numberText(spread.q95, 3)} (${spread.members} runs)` : "–");
  const row = (run, { name, words, said, quantity }) => element("tr", {}, several ? element("td", {}, run.short) : null, element("td", { class: "name" }, words, said ? null : element("code", {}, name)), element("td", {}, said || known(quantity)), repeated ? element("td", {}, said ? "–" : between(quantity)) : null);
  const rows = runs.flatMap((run) => lifeRows(run).map((entry) => row(run, entry)));
  const lead = element("p", { class: "lead" }, "Rolling fatigue rarely decides a drop: dents, cage, lubricant, wear, smearing and heat end auxiliary bearings first. 1, 10 and 50\u00a0% are the scatter of single bearings under equal drops (Weibull, slope 10/9)" + (repeated ? "; how drops differ stands apart from it" : "") + ". One bearing; a drop that goes on until standstill counts with its coast-down. The factor of the lubricant is taken where it is known. An order, never a promise.");
  return section("life", "Life by rolling fatigue", lead, tableOfRows("held", heads, rows));
}

const LIMIT_SECTIONS = (runs) => [[85, severitySection, runs.filter((run) => marginsOf([run]).length)], [86, lifeSection, runs.filter((run) => shownIn(run, "life").length)]].filter(([, , some]) => some.length);
