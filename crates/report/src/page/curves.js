// Curves over something other than the time of the run, drawn as the time plots are: same letters, colours and margins.

// Round numbers that divide an axis into some so many parts.
function axisSteps(low, high, parts = 5) {
  const rough = (high - low) / parts;
  const power = 10 ** Math.floor(Math.log10(rough));
  const sizes = [1, 2, 2.5, 5, 10, 20, 25].map((factor) => factor * power).filter((size) => size >= rough * 0.999);
  // of steps that are not much wider one that ends at the end
  const ends = (size) => size <= 2 * rough && Math.abs(high / size - Math.round(high / size)) < 0.01;
  const step = sizes.find(ends) || sizes[0];
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, index) => Number(((first + index) * step).toPrecision(12)));
}

// Of an axis that ends just short of a round number, that number: a speed of 149.9 is shown up to 150.
function roundedEnd(low, high, parts) {
  const steps = axisSteps(low, high, parts);
  const step = steps.length > 1 ? steps[1] - steps[0] : 0;
  const next = steps.length ? steps[steps.length - 1] + step : high;
  return step > 0 && next > high && next - high < 0.03 * (high - low) ? next : high;
}

const CURVE_BOX = { left: AXIS_WIDTH, right: AXIS_WIDTH, top: 10, bottom: 42 };
// Height of a second axis above the plot.
const UPPER_AXIS = 34;

// series: [{label?, x, y, colour, dash?, width?, dots?, line?: false}]; words of both axes; logarithmic: decades on the upright axis;
// above: {label, factor} a second axis over the plot, right: {label, factor} one beside it; marks: [{at, words}] upright lines;
// level: {at, words} a line across; decades: a logarithmic axis across, on which the first tenths of a second have as much room as the
// seconds behind them.
function curves(options) {
  const known = options.series.some((line) => line.x.some((x, row) => isNumber(x) && isNumber(line.y[row]) && (!options.logarithmic || line.y[row] > 0)));
  if (!known) return null;
  const holder = element("div", { class: "curves" });
  resizable.push(() => holder.replaceChildren(curveDrawing(options, holder.clientWidth || 900)));
  const legend = options.series.filter((line) => line.label).map((line) => element("span", { class: "curve-key" }, curveSample(line), line.label));
  return [holder, element("p", { class: "curve-keys" }, legend)];
}

function curveSample(line) {
  const sample = line.line === false ? drawing("circle", { cx: 15, cy: 5, r: 2.5, fill: line.colour }) : drawing("line", { x1: 0, x2: 30, y1: 5, y2: 5, stroke: line.colour, "stroke-width": line.width || 1.75, "stroke-dasharray": line.dash || null });
  return drawing("svg", { width: 30, height: 10, viewBox: "0 0 30 10" }, sample);
}

function curveDrawing({ series, across, upright, height: tall = 300, logarithmic = false, above = null, right: beside = null, marks = [], level = null, decades: across10 = false }, width) {
  const paper = document.documentElement.classList.contains("paper");
  const height = Math.round((paper ? 0.78 : 1) * tall) + (above ? UPPER_AXIS : 0);
  const box = { ...CURVE_BOX, top: CURVE_BOX.top + (above ? UPPER_AXIS : 0) + (marks.length ? 16 : 0) };
  const scaled = (y) => (logarithmic ? Math.log10(y) : y);
  const placed = (x) => (across10 ? Math.log10(x) : x);
  const points = series.flatMap((line) => line.x.map((x, row) => [x, line.y[row]])).filter(([x, y]) => isNumber(x) && isNumber(y) && (!logarithmic || y > 0) && (!across10 || x > 0));
  let [left, right] = [Infinity, -Infinity];
  let [low, high] = [Infinity, -Infinity];
  for (const [x, y] of points) {
    [left, right] = [Math.min(left, placed(x)), Math.max(right, placed(x))];
    [low, high] = [Math.min(low, scaled(y)), Math.max(high, scaled(y))];
  }
  if (!across10 && left > 0 && left < 0.05 * right) left = 0;
  if (!(right > left)) right = left + 1;
  const high_ = height - box.top - box.bottom;
  const rows = Math.max(4, Math.floor(high_ / 26));
  // A peak that touches the frame looks cut off.
  const room = 0.04 * (high - low);
  [low, high] = logarithmic ? [low - room, high + room] : paddedRange(low, high, level ? [level.at] : []);
  if (!(high > low)) [low, high] = [low - 0.5, high + 0.5];
  const decades = (from, to) => Array.from({ length: Math.ceil(to) - Math.floor(from) + 1 }, (_, index) => Math.floor(from) + index).flatMap((power) => [1, 2, 5].map((digit) => [digit * 10 ** power, power + Math.log10(digit)]));
  const rungs = logarithmic ? decades(low, high).filter(([, y]) => y >= low && y <= high) : axisSteps(low, high, rows).map((y) => [y, y]);
  // Long numbers beside the axis leave room for its words.
  const longest = Math.max(...rungs.map(([value]) => numberText(value, 6).length), 1);
  box.left = Math.max(box.left, 29 + 7 * longest);
  const wide = width - box.left - box.right;
  const columns = Math.max(3, Math.floor(wide / 75));
  if (!across10) right = roundedEnd(left, right, columns);
  const toX = (x) => box.left + ((placed(x) - left) / (right - left)) * wide;
  const toY = (y) => box.top + high_ - ((y - low) / (high - low)) * high_;
  const bottom = box.top + high_;
  const turned = (x, words) => axisText(x, box.top + high_ / 2, "middle", words, { transform: `rotate(-90 ${x} ${box.top + high_ / 2})` });
  const grid = [
    (across10 ? decades(left, right).filter(([, at]) => at >= left && at <= right).map(([x]) => x) : axisSteps(left, right, columns)).map((x) => [drawing("line", { x1: toX(x), x2: toX(x), y1: box.top, y2: bottom, stroke: RULE }), axisText(toX(x), bottom + 17, "middle", numberText(x, 6))]),
    rungs.map(([value, y]) => [
      drawing("line", { x1: box.left, x2: width - box.right, y1: toY(y), y2: toY(y), stroke: !logarithmic && value === 0 ? "#8995a0" : RULE }),
      axisText(box.left - 7, toY(y) + 4, "end", numberText(value, 6)),
    ]),
    axisText(box.left + wide / 2, height - 6, "middle", across),
    turned(box.left - 18 - 7 * longest, upright),
  ];
  if (above) {
    for (const x of axisSteps(left * above.factor, right * above.factor, columns)) {
      const at = toX(x / above.factor);
      grid.push(drawing("line", { x1: at, x2: at, y1: box.top - 5, y2: box.top, stroke: "#b9c2ca" }), axisText(at, box.top - 9, "middle", numberText(x, 6)));
    }
    grid.push(axisText(box.left + wide / 2, box.top - 25, "middle", above.label), drawing("line", { x1: box.left, x2: box.left + wide, y1: box.top, y2: box.top, stroke: "#b9c2ca" }));
  }
  if (beside) {
    for (const y of axisSteps(low * beside.factor, high * beside.factor, rows)) grid.push(axisText(box.left + wide + 7, toY(y / beside.factor) + 4, "start", numberText(y, 6)));
    grid.push(turned(width - 8, beside.label));
  }
  const drawn = series.map((line) => {
    const path = [];
    let down = false;
    const dots = [];
    line.x.forEach((x, row) => {
      const y = line.y[row];
      // a value that is known to be none is a gap; x without y of a joined line is not
      if (!isNumber(x) || !isNumber(y) || (logarithmic && !(y > 0)) || (across10 && !(x > 0))) {
        if (line.gaps) down = false;
        return;
      }
      path.push(`${down ? "L" : "M"}${toX(x).toFixed(2)} ${toY(scaled(y)).toFixed(2)}`);
      down = true;
      if (line.dots || path.length === 1) dots.push([x, y]);
    });
    const alone = line.dots || path.length === 1 ? dots.map(([x, y]) => drawing("circle", { cx: toX(x), cy: toY(scaled(y)), r: line.radius || 2.6, fill: line.fill || line.colour, stroke: line.fill ? line.colour : null })) : [];
    return [line.line === false ? null : drawing("path", { d: path.join(""), fill: "none", stroke: line.colour, "stroke-width": line.width || 1.75, "stroke-dasharray": line.dash || null, "stroke-linejoin": "round" }), alone];
  });
  let free = -Infinity;
  const events = marks.filter(({ at }) => at >= left && at <= right).map(({ at, words, colour = "#6b7680" }) => {
    const x = toX(at);
    // words that would meet those before them are left to the line alone
    const fits = x > free;
    if (fits) free = x + 7 * words.length + 8;
    return [drawing("line", { x1: x, x2: x, y1: box.top, y2: bottom, stroke: colour, "stroke-dasharray": "3 3" }), fits ? axisText(Math.min(x - 3, width - 7 * words.length), box.top - (above ? UPPER_AXIS + 5 : 5), "start", words, { fill: colour, "font-size": 11 }) : null];
  });
  const line = level ? [drawing("line", { x1: box.left, x2: box.left + wide, y1: toY(level.at), y2: toY(level.at), stroke: SERIES_COLOURS.limit, "stroke-dasharray": "7 4" }), axisText(box.left + wide - 6, toY(level.at) - 4, "end", level.words, { fill: SERIES_COLOURS.limit, "font-size": 11 })] : [];
  return drawing("svg", { class: "curves", width, height, viewBox: `0 0 ${width} ${height}`, role: "img" }, grid, drawn, events, line);
}

// The second axis of a speed in rad/s, and of one in rpm.
const IN_RPM = { label: "speed [rpm]", factor: 30 / Math.PI };
const IN_RADIANS = { label: "speed [rad/s]", factor: Math.PI / 30 };
