// Where the heat of a bearing went: losses, bodies that they warm, what these keep and what the surroundings take. Widths are in
// proportion to energies. From body to body only what each passes on in the whole is known, and drawn through one bar.

const SMALL_FLOW = 0.005;
const FLOW_HEIGHT = 260;
const BAR = 14;
const LABEL_ROW = 16;

// [name, colour, joule] lists of losses, and made, kept and given of every body. What came out of a store counts as a loss.
function heatFlows(run) {
  const bodies = Object.keys(NODE_COLOURS).filter((node) => numberOf(run, `heat_made_in_${node}`) !== null);
  const of = (words, node) => numberOf(run, `${words}_${node}`) || 0;
  const suffix = "_heat_by_node";
  const kinds = Object.keys(run.quantities).filter((name) => name.endsWith(suffix) && listOf(run, name).length);
  const order = Object.keys(NODE_COLOURS);
  const losses = kinds.map((name) => {
    const kind = name.slice(0, -suffix.length);
    const known = { speed_dependent: ["speed-dependent moment M0", HEAT_COLOURS.steady_moment], load_dependent: ["load-dependent moment M1", HEAT_COLOURS.ball_slip] };
    const [words, colour] = known[kind] || [wordsOf(kind), HEAT_COLOURS[kind] || HEAT_WITHOUT_NAME];
    return { words, colour, into: Object.fromEntries(order.map((node, place) => [node, listOf(run, name)[place]])) };
  });
  if (!kinds.length) losses.push({ words: "bearing, ball by ball and by laws", colour: HEAT_COLOURS.steady_moment, into: Object.fromEntries(bodies.map((node) => [node, of("heat_made_in", node)])) });
  for (const [words, name] of [["given up by bodies that cooled", "stored_heat_in"], ["from the surroundings", "heat_to_surroundings_from"]]) {
    const into = Object.fromEntries(bodies.map((node) => [node, Math.max(0, -of(name, node))]));
    losses.push({ words, colour: SERIES_COLOURS.quiet, into });
  }
  const ends = bodies.map((node) => ({ node, kept: Math.max(0, of("stored_heat_in", node)), given: Math.max(0, of("heat_to_surroundings_from", node)) }));
  return { losses, ends };
}

// Columns of bars with the bands between them, small ones together.
function flowColumns({ losses, ends }) {
  const sum = (values) => values.reduce((all, value) => all + value, 0);
  const whole = sum(losses.map(({ into }) => sum(Object.values(into))));
  const made = (node) => sum(losses.map(({ into }) => into[node] || 0));
  const end = ({ kept, given }) => kept + given;
  const body = (node, amount) => (amount >= SMALL_FLOW * whole ? node : "other");
  const bars = new Map();
  const bands = new Map();
  const flow = (from, to, amount) => {
    if (!(amount > 0)) return;
    const key = from.key + ">" + to.key;
    for (const bar of [from, to]) if (!bars.has(bar.key)) bars.set(bar.key, { ...bar, in: 0, out: 0 });
    bars.get(from.key).out += amount;
    bars.get(to.key).in += amount;
    const band = bands.get(key) || { from: bars.get(from.key), to: bars.get(to.key), amount: 0 };
    bands.set(key, { ...band, amount: band.amount + amount });
  };
  const bar = (column, name, words, colour) => ({ key: column + name, column, words, colour });
  const ofBody = (column, node) => bar(column, node, node === "other" ? "other bodies" : wordsOf(node), NODE_COLOURS[node] || HEAT_WITHOUT_NAME);
  const large = (loss) => sum(Object.values(loss.into)) >= SMALL_FLOW * whole;
  const bySize = [...losses].sort((one, other) => sum(Object.values(other.into)) - sum(Object.values(one.into)));
  for (const node of Object.keys(NODE_COLOURS)) for (const loss of bySize) flow(large(loss) ? bar(0, loss.words, loss.words, loss.colour) : bar(0, "other", "other", HEAT_WITHOUT_NAME), ofBody(1, body(node, made(node))), loss.into[node]);
  const [pool, kept, given] = [bar(2, "pool", "conducted", SERIES_COLOURS.quiet), bar(4, "kept", "stored", "#b58a3c"), bar(4, "given", "to the surroundings", "#5f8f9c")];
  for (const one of ends) {
    const [start, left] = [made(one.node), end(one)];
    const [from, to] = [ofBody(1, body(one.node, start)), ofBody(3, body(one.node, left))];
    flow(from, to, Math.min(start, left));
    // what rounding leaves passes on nothing
    if (Math.abs(start - left) > 1e-9 * whole) {
      flow(from, pool, start - left);
      flow(pool, to, left - start);
    }
    flow(to, kept, one.kept);
    flow(to, given, one.given);
  }
  return { whole, bars: [...bars.values()], bands: [...bands.values()] };
}

const FLOW_PLACES = [300, 480, 680, 830, 985];
const FLOW_WIDTH = 1240;
const FLOW_HEADS = ["made by", "first in", null, "passed on to", "at the end"];

function heatFlowPicture(run) {
  const { whole, bars, bands } = flowColumns(heatFlows(run));
  const scale = FLOW_HEIGHT / whole;
  const size = (one) => scale * Math.max(one.in, one.out);
  const place = [34, 34, 34, 34, 34];
  // as the bodies stand, the largest loss first, others last
  const order = Object.keys(NODE_COLOURS);
  const rank = ({ column, key, out }) => (key.endsWith("other") ? Infinity : column === 0 ? -out : order.indexOf(key.slice(1)));
  const sorted = bars.filter(({ column }) => column !== 2).sort((one, other) => rank(one) - rank(other));
  for (const one of sorted) {
    const slot = Math.max(size(one), LABEL_ROW);
    Object.assign(one, { y: place[one.column] + (slot - size(one)) / 2, leaves: 0, enters: 0 });
    place[one.column] += slot + 6;
  }
  const pool = bars.find(({ column }) => column === 2);
  const bottom = Math.max(...place);
  // below the wide bands that stay in their body
  const wide = bands.filter(({ from, to, amount }) => from.column === 1 && to.column === 3 && amount >= 0.05 * whole);
  if (pool) Object.assign(pool, { y: Math.max(34, ...wide.flatMap(({ from, to }) => [from.y + size(from), to.y + size(to)])) + 10, leaves: 0, enters: 0 });
  const height = pool ? Math.max(bottom, pool.y + size(pool) + LABEL_ROW) : bottom;
  for (const band of [...bands].sort((one, other) => one.from.y - other.from.y || one.to.y - other.to.y)) {
    band.start = band.from.y + band.from.leaves;
    band.from.leaves += scale * band.amount;
  }
  for (const band of [...bands].sort((one, other) => one.to.y - other.to.y || one.from.y - other.from.y)) {
    band.end = band.to.y + band.to.enters;
    band.to.enters += scale * band.amount;
  }
  const ribbon = ({ from, to, start, end, amount }) => {
    const [x, u, wide] = [FLOW_PLACES[from.column] + BAR, FLOW_PLACES[to.column], scale * amount];
    const half = (x + u) / 2;
    const path = `M${x} ${start}C${half} ${start} ${half} ${end} ${u} ${end}V${end + wide}C${half} ${end + wide} ${half} ${start + wide} ${x} ${start + wide}Z`;
    return drawing("path", { d: path, fill: from.colour, "fill-opacity": 0.28 }, drawing("title", {}, `${from.words} → ${to.words}: ${engineeringText(amount, "J", 4)}`));
  };
  const label = (one) => {
    const [x, most] = [FLOW_PLACES[one.column], Math.max(one.in, one.out)];
    const middle = one.y + size(one) / 2;
    const at = { 0: [x - 6, middle, "end"], 2: [x + BAR / 2, one.y + size(one) + 13, "middle"] }[one.column] || [x + BAR + 5, middle, "start"];
    const words = `${one.words} ${engineeringText(most, "J", 3)}${one.column === 0 || one.column === 4 ? `, ${most < 1e-4 * whole ? "< 0.01 %" : percentText(most / whole, 2)}` : ""}`;
    return drawing("text", { x: at[0], y: at[1] + (one.column === 2 ? 0 : 4), "text-anchor": at[2], fill: INK, stroke: "#fff", "stroke-width": 3, "stroke-opacity": 0.8, "paint-order": "stroke" }, words);
  };
  const heads = FLOW_HEADS.map((words, column) => words && drawing("text", { x: FLOW_PLACES[column] + (column ? 0 : BAR), y: 14, "text-anchor": column ? "start" : "end", fill: PALE_INK }, words));
  const boxes = bars.map((one) => drawing("rect", { x: FLOW_PLACES[one.column], y: one.y, width: BAR, height: Math.max(1, size(one)), fill: one.colour }));
  return drawing("svg", { viewBox: `0 0 ${FLOW_WIDTH} ${Math.ceil(height)}`, width: "100%", style: `display:block;max-width:${FLOW_WIDTH}px;font:12px system-ui, sans-serif` }, heads, bands.map(ribbon), boxes, bars.map(label));
}

function heatFlowFigure(run, runs, whose) {
  const title = shareOfRun(run, runs, "Where the heat went");
  const made = Object.keys(NODE_COLOURS).reduce((sum, node) => sum + (numberOf(run, `heat_made_in_${node}`) || 0), 0);
  if (!(made > 0)) return figure(title, null, notInThisRun("no heat is made, or its way through the bodies is not known", run));
  const note = `${whose} Made ${engineeringText(made, "J", 4)} = ${shownIn(run, "heat_balance").map(({ words, value }) => `${words} ${engineeringText(value, "J", 4)}`).join(" + ")}, at the end of these times. Losses and bodies below 0.5 % stand together as other; what one body conducts to others is known in the whole alone.`;
  return figure(title, note, heatFlowPicture(run));
}
