// Time plots that share one time window: drag in any of them to zoom all, double-click to see everything again.

const AXIS_WIDTH = 74;
const PLOT_TOP = 12;
const SHORTEST_SPAN = 1e-9;
const SMALLEST_RANGE = 1e-12;

const timeline = {
  first: 0,
  last: 1,
  begin: 0,
  end: 1,
  unit: ["s", 1],
  listeners: [],
  // what follows the instant under the pointer
  followers: [],
  words: "time after release",
  span(runs) {
    const words = new Set(runs.map((run) => systemOf(run).time).filter(Boolean));
    if (words.size === 1) [this.words] = words;
    if (runs.some((run) => ![undefined, 0].includes(releaseTime(run)))) this.words = "time since the start";
    const times = runs.filter((run) => run.time && run.time.length > 1).map((run) => run.time);
    if (!times.length) return;
    this.first = Math.min(...times.map((time) => time[0]));
    this.last = Math.max(...times.map((time) => time[time.length - 1]));
    if (!(this.last > this.first)) this.last = this.first + 1;
    // A run that failed at once still gets an axis whose steps are above rounding.
    if (this.last - this.first < SHORTEST_SPAN) this.last = this.first + SHORTEST_SPAN;
    [this.begin, this.end] = [this.first, this.last];
    const units = [["s", 1, 2], ["ms", 1e-3, 1e-5], ["µs", 1e-6, 0]];
    this.unit = units.find(([, , shortest]) => this.last - this.first >= shortest);
  },
  zoom(begin, end) {
    // A window shorter than a millionth of the run shows nothing but rounding.
    if (!(end - begin > 1e-6 * (this.last - this.first))) return;
    [this.begin, this.end] = [Math.max(begin, this.first), Math.min(end, this.last)];
    for (const listener of this.listeners) listener();
  },
  all() {
    this.zoom(this.first, this.last);
  },
  point(instant) {
    if (instant >= this.first && instant <= this.last) for (const follower of this.followers) follower(instant);
  },
  text(instant) {
    return numberText(instant / this.unit[1], 5) + " " + this.unit[0];
  },
};

// Lines of several runs have several time columns: they are joined, and lines span the rows of the other runs.
function joined(series) {
  const times = [...new Set(series.map((line) => line.time))];
  const ordered = times.flatMap((time) => series.filter((line) => line.time === time));
  if (times.length === 1) return { ordered, data: [times[0], ...ordered.map((line) => line.values)] };
  const tables = times.map((time) => [time, ...series.filter((line) => line.time === time).map((line) => line.values)]);
  return { ordered, data: uPlot.join(tables) };
}

function paddedRange(low, high, extra) {
  const values = [low, high, ...extra].filter(isNumber);
  if (!values.length) return [0, 1];
  let [least, most] = [Math.min(...values), Math.max(...values)];
  if (most - least < SMALLEST_RANGE) return Math.abs(least) < SMALLEST_RANGE ? [0, 1] : [least - 0.1 * Math.abs(least), most + 0.1 * Math.abs(most)];
  const room = 0.06 * (most - least);
  const nearZero = least >= 0 && least < 0.4 * most;
  return [nearZero ? 0 : least - room, most <= 0 && least < 0 && most > 0.4 * least ? 0 : most + room];
}

function axisNumbers(scale) {
  return (_, splits) => splits.map((split) => numberText(Number((split / scale).toPrecision(12)), 6));
}

function axis(options) {
  return {
    stroke: INK,
    font: FONT,
    labelFont: FONT,
    labelSize: 20,
    labelGap: 2,
    grid: { stroke: RULE, width: 1 },
    ticks: { stroke: RULE, width: 1, size: 5 },
    ...options,
  };
}

// Space above a plot, px: for the words of its marks, or the number of the highest tick.
function wordsHeight(options) {
  const rows = (options.marks && options.marks.rows) || 0;
  return rows ? 6 + WORD_ROW * rows : PLOT_TOP;
}

// options: series [{label, time, values, shown?, colour, width?, dash?, fill?}], label, height?, second? {label, factor},
// include? (begin, end) -> values the vertical range must hold, marks? (pen, plot) draws on top, ticks? runs whose
// contact starts are marked, stacked: lines that cannot be hidden one by one.
function timePlot(options) {
  const { ordered, data } = joined(options.series);
  const holder = element("div", { class: options.stacked ? "plot stacked" : "plot" });
  const factor = options.second ? options.second.factor : 1;
  const configuration = {
    width: 600,
    height: (options.height || 250) + wordsHeight(options) - PLOT_TOP,
    padding: [wordsHeight(options), options.second ? 0 : AXIS_WIDTH, 0, 0],
    scales: {
      x: { time: false, range: () => [timeline.begin, timeline.end] },
      y: { range: (_, low, high) => paddedRange(low, high, options.include ? options.include(timeline.begin, timeline.end) : []) },
      second: { from: "y", range: (_, low, high) => [low * factor, high * factor] },
    },
    axes: [
      axis({ label: `${timeline.words} [${timeline.unit[0]}]`, size: 34, values: axisNumbers(timeline.unit[1]), space: 70 }),
      axis({ label: options.label, size: AXIS_WIDTH - 20, values: axisNumbers(1) }),
    ],
    series: [{ label: "time", value: (_, instant) => (isNumber(instant) ? timeline.text(instant) : "–") }],
    legend: { live: true, markers: { width: 2 } },
    cursor: {
      y: false,
      sync: { key: "auxbear", setSeries: false, filters: { pub: (kind) => kind === "mousemove" || kind === "mouseleave" } },
      drag: { x: true, y: false, setScale: false },
      bind: {
        dblclick: () => () => timeline.all(),
        mousemove: (plot, _, move) => (event) => {
          move(event);
          timeline.point(plot.posToVal(plot.cursor.left, "x"));
        },
      },
      points: { size: 6 },
    },
    hooks: {
      setSelect: [
        (plot) => {
          if (plot.select.width < 4) return;
          const begin = plot.posToVal(plot.select.left, "x");
          const end = plot.posToVal(plot.select.left + plot.select.width, "x");
          plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
          timeline.zoom(begin, end);
        },
      ],
      draw: [(plot) => drawMarks(plot, options)],
    },
  };
  if (options.second) {
    configuration.axes.push(
      axis({ label: options.second.label, scale: "second", side: 1, size: AXIS_WIDTH - 20, grid: { show: false }, values: axisNumbers(1) }),
    );
  }
  for (const line of ordered) {
    const shown = line.shown || line.values;
    configuration.series.push({
      label: line.label,
      stroke: line.colour,
      fill: line.fill,
      width: line.width || 1.25,
      dash: line.dash,
      // A line with gaps of its own shows them; times of other lines, at which it has no value, are none.
      spanGaps: !line.gaps,
      points: { show: false },
      value: (plot, _, __, row) => {
        const instant = row === null || row === undefined ? null : plot.data[0][row];
        return isNumber(instant) ? numberText(valueAt(line.time, shown, instant), 5) : "–";
      },
    });
  }
  const plot = new uPlot(configuration, data, holder);
  holder.querySelectorAll(".u-legend .u-series").forEach((row, index) => index && showLineStyle(row.querySelector(".u-marker"), ordered[index - 1]));
  // Lower on paper, so that pages fill.
  const height = () => (document.documentElement.classList.contains("paper") ? Math.max(155, 0.66 * configuration.height) : configuration.height);
  resizable.push(() => plot.setSize({ width: holder.clientWidth, height: height() }));
  timeline.listeners.push(() => plot.setScale("x", { min: timeline.begin, max: timeline.end }));
  return holder;
}

// The legend shows each line as it is drawn: colour, width and dashes; bands as a filled box.
function showLineStyle(marker, line) {
  marker.removeAttribute("style");
  const stroke = { x1: 0, y1: 6, x2: 30, y2: 6, stroke: line.colour, "stroke-width": (line.width || 1.25) + 0.5, "stroke-dasharray": line.dash ? line.dash.join(" ") : null };
  const sample = line.fill ? drawing("rect", { x: 8, y: 0, width: 12, height: 12, fill: line.fill }) : drawing("line", stroke);
  marker.append(drawing("svg", { width: 30, height: 12, viewBox: "0 0 30 12" }, sample));
}

function drawMarks(plot, options) {
  const pen = plot.ctx;
  const ratio = window.devicePixelRatio;
  const { left, top, width, height } = plot.bbox;
  pen.save();
  pen.beginPath();
  const above = wordsHeight(options) * ratio;
  pen.rect(left, top - above, width, height + above);
  pen.clip();
  pen.setLineDash([]);
  for (const run of options.ticks || []) {
    pen.strokeStyle = (options.ticks || []).length > 1 ? run.colour : PALE_INK;
    pen.lineWidth = ratio;
    pen.beginPath();
    for (const contact of run.contacts) {
      const x = plot.valToPos(contact.start_s, "x", true);
      pen.moveTo(x, top + height);
      pen.lineTo(x, top + height - 6 * ratio);
    }
    pen.stroke();
  }
  if (options.marks) options.marks(pen, plot, ratio);
  pen.restore();
}

// Rows of words above a plot, at most; what does not fit on them goes on inside it.
const WORD_ROWS = 4;
const WORD_ROW = 15;

// Marks at instants [{instant, words, colour}]: upright lines, their words above the plot, where no curve is.
function instantMarks(instants) {
  const known = instants.filter((mark) => mark.instant !== null);
  const marks = (pen, plot, ratio) => drawInstants(pen, plot, ratio, known);
  marks.rows = Math.min(known.length, WORD_ROWS);
  return marks;
}

// Words that would meet stand on rows of their own; the first instant is nearest to the plot.
function drawInstants(pen, plot, ratio, instants) {
  const { left, width } = plot.bbox;
  const placed = instants
    .map((mark) => ({ ...mark, x: plot.valToPos(mark.instant, "x", true) }))
    .filter((mark) => mark.x >= left && mark.x <= left + width)
    .sort((one, other) => one.x - other.x);
  for (const mark of placed) instantLine(pen, plot, ratio, mark);
  pen.font = FONT.replace("12px", 11 * ratio + "px");
  const ends = [];
  for (const mark of placed) {
    const space = pen.measureText(mark.words).width + 10 * ratio;
    const start = Math.max(left, Math.min(mark.x - 4 * ratio, left + width - space));
    const free = ends.findIndex((end) => end <= start);
    const row = free < 0 ? ends.length : free;
    ends[row] = start + space;
    instantWords(pen, plot, ratio, { ...mark, start, space }, row);
  }
}

function instantLine(pen, plot, ratio, { x, colour }) {
  const { top, height } = plot.bbox;
  pen.strokeStyle = colour;
  pen.lineWidth = ratio;
  pen.setLineDash([3 * ratio, 3 * ratio]);
  strokeLine(pen, x, top, x, top + height);
  pen.setLineDash([]);
}

function instantWords(pen, plot, ratio, { start, space, words, colour }, row) {
  const base = plot.bbox.top - (5 + WORD_ROW * (row < WORD_ROWS ? row : WORD_ROWS - 2 - row)) * ratio;
  pen.fillStyle = "#fff";
  if (row >= WORD_ROWS) pen.fillRect(start, base - 11 * ratio, space, 14 * ratio);
  pen.fillStyle = colour;
  penWords(pen, words, start + 4 * ratio, base, "left", "alphabetic");
}

function levelMark(pen, plot, ratio, level, words, colour) {
  const y = plot.valToPos(level, "y", true);
  const { left, width } = plot.bbox;
  pen.strokeStyle = colour;
  pen.lineWidth = 1.5 * ratio;
  pen.setLineDash([7 * ratio, 4 * ratio]);
  strokeLine(pen, left, y, left + width, y);
  pen.setLineDash([]);
  pen.font = FONT.replace("12px", 11 * ratio + "px");
  pen.fillStyle = colour;
  penWords(pen, words, left + width - 6 * ratio, y - 3 * ratio, "right", "bottom");
}

// A slider over the rows of a run, with a button that plays them: draw(row) at each; what is built for a pointer follows it.
function timeSlider(run, instant, draw, follows = false) {
  const last = run.time.length - 1;
  const readout = element("span", { class: "readout" }, "");
  const slider = element("input", { type: "range", min: "0", max: String(last), value: String(rowBefore(run.time, instant)), class: "time", "aria-label": timeline.words });
  let playing = null;
  const show = () => {
    const row = Number(slider.value);
    draw(row);
    readout.textContent = ` ${timeline.text(run.time[row])}`;
  };
  const stop = () => {
    clearInterval(playing);
    playing = null;
    button.textContent = "play";
  };
  const button = element("button", { type: "button", onclick: () => (playing ? stop() : play()) }, "play");
  const play = () => {
    if (Number(slider.value) >= last) slider.value = "0";
    button.textContent = "stop";
    playing = setInterval(() => {
      slider.value = String(Number(slider.value) + 1);
      show();
      if (Number(slider.value) >= last) stop();
    }, 40);
  };
  slider.addEventListener("input", show);
  resizable.push(show);
  if (follows)
    timeline.followers.push((at) => {
      slider.value = String(rowBefore(run.time, at));
      show();
    });
  return element("div", { class: "controls" }, button, slider, readout);
}
