// Dry backward whirl in the auxiliary bearings of a machine whose rotor is analysed: needed friction over frequency, and over the mount.

// Needed frictions above so many times that of the file stand outside the picture.
const MOST_FRICTION = 30;

// The columns of one bearing in a figure, by their words.
function whirlColumns(run, figureName, begin) {
  const entries = shownIn(run, figureName).filter(({ name }) => name.startsWith(`${begin}.`));
  return Object.fromEntries(entries.map(({ words, quantity }) => [words, quantity.value]));
}

function whirlCurves(run, begin, friction) {
  const { frequency: x, friction: needed, force } = whirlColumns(run, "whirl_curves", begin);
  if (!list(x).length) return [notInThisRun("no frequency was looked at: the weight keeps slower whirl down, and the surfaces roll on each other above", run)];
  const { from, to, force: settled } = whirlColumns(run, "whirl_bands", begin);
  const axes = { across: "frequency of the whirl [rad/s]", above: IN_RPM, logarithmic: true, decades: false };
  const ends = [{ x: [x[0], x[x.length - 1]], y: [friction, friction], colour: SERIES_COLOURS.limit, dash: "7 4", width: 2, label: `μ of the file, ${numberText(friction, 3)}` }];
  const driven = needed.map((value) => (isNumber(value) && value < friction ? value : null));
  const settles = list(to).map((at, k) => ({ at, force: settled[k] })).filter((own) => isNumber(own.force));
  const marks = [...list(from).map((at) => ({ at, words: "must exceed" })), ...settles.map(({ at }) => ({ at, words: "settles", colour: SERIES_COLOURS.limit }))];
  const shownNeeded = needed.map((value) => (isNumber(value) && value <= MOST_FRICTION * friction ? value : null));
  const low = list(from).length ? marks.filter(({ at }) => at > 1.0001 * x[0]) : [];
  return [
    curves({ series: [{ label: "needed friction μ_e", x, y: shownNeeded, colour: LINE_COLOURS[0], gaps: true }, { label: "below μ: whirl is driven", x, y: driven, colour: GROWS, width: 3.5, gaps: true }, ...ends], ...axes, upright: "needed friction", marks: low, height: 330 }),
    curves({ series: [{ x: [x[0], x[x.length - 1]], y: [1, 1].map(() => force.find(isNumber)), colour: "none", line: false }, { x, y: force, colour: LINE_COLOURS[2 % LINE_COLOURS.length], gaps: true }, { label: "where whirl settles", x: settles.map(({ at }) => at), y: settles.map((own) => own.force), colour: GROWS, line: false, dots: true, radius: 4 }], ...axes, upright: "contact force [N]", height: 240 }),
  ];
}

// Cells over stiffness and damping, dark where much friction is needed, with the border at the friction of the file.
function whirlMap(run, begin, friction) {
  const { stiffness, damping, friction: needed } = whirlColumns(run, "whirl_map", begin);
  const today = whirlColumns(run, "whirl_mount", begin);
  const count = list(stiffness).length;
  if (!count) return null;
  const [cell, left, top, bottom] = [20, 92, 14, 46];
  const size = cell * count;
  const value = (row, column) => (row < 0 || column < 0 || row >= count || column >= count ? null : needed[row * count + column]);
  const enough = (row, column) => !isNumber(value(row, column)) || value(row, column) > friction;
  const shade = (own) => (isNumber(own) ? 0.5 + 0.25 * Math.log10(own / friction) : 1);
  const at = (row, column) => [left + cell * column, top + size - cell * (row + 1)];
  const cells = [];
  const borders = [];
  for (let row = 0; row < count; row++) {
    for (let column = 0; column < count; column++) {
      const [x, y] = at(row, column);
      const own = value(row, column);
      const words = `${engineeringText(stiffness[column], "N/m", 3)}, ${engineeringText(damping[row], "N s/m", 3)}: ${isNumber(own) ? `needs μ ${numberText(own, 3)}` : "no friction drives whirl"}`;
      cells.push(drawing("rect", { x, y, width: cell + 0.5, height: cell + 0.5, fill: `rgb(${mapColour(shade(own)).join(",")})` }, drawing("title", {}, words)));
      const line = (x1, y1, x2, y2) => borders.push(drawing("line", { x1, x2, y1, y2, stroke: GROWS, "stroke-width": 2.5 }));
      if (column + 1 < count && enough(row, column) !== enough(row, column + 1)) line(x + cell, y, x + cell, y + cell);
      if (row + 1 < count && enough(row, column) !== enough(row + 1, column)) line(x, y, x + cell, y);
    }
  }
  const place = (values, own) => (count - 1) * (Math.log(own / values[0]) / Math.log(values[count - 1] / values[0])) + 0.5;
  const [column, row] = [place(stiffness, today.stiffness), today.damping > 0 ? place(damping, today.damping) : 0];
  const middle = [left + cell * column, top + size - cell * Math.max(0, row)];
  const mark = [drawing("circle", { cx: middle[0], cy: middle[1], r: 6, fill: "white", stroke: INK, "stroke-width": 2.5 }), axisText(middle[0] + 11, middle[1] + 4, "start", "today", { "font-weight": 600, stroke: "white", "stroke-width": 3, "paint-order": "stroke" })];
  const steps = Array.from({ length: Math.floor((count - 1) / 5) + 1 }, (_, k) => 5 * k);
  const labels = steps.flatMap((k) => [axisText(left + cell * (k + 0.5), top + size + 17, "middle", numberText(stiffness[k], 2)), axisText(left - 7, top + size - cell * (k + 0.5) + 4, "end", numberText(damping[k], 2))]);
  const scale = [0.01, 0.1, 1, 10, 100];
  const ramp = scale.map((factor, k) => [drawing("rect", { x: left + size + 24, y: top + 40 * (scale.length - 1 - k), width: 22, height: 40, fill: `rgb(${mapColour(shade(factor * friction)).join(",")})` }), axisText(left + size + 52, top + 40 * (scale.length - 1 - k) + 24, "start", `μ_e ${numberText(factor * friction, 2)}`)]);
  const border = [drawing("line", { x1: left + size + 24, x2: left + size + 46, y1: top + 226, y2: top + 226, stroke: GROWS, "stroke-width": 2.5 }), axisText(left + size + 52, top + 230, "start", `border: μ ${numberText(friction, 3)}`)];
  const axes = [axisText(left + size / 2, top + size + 39, "middle", "mount stiffness [N/m]"), axisText(16, top + size / 2, "middle", "mount damping [N s/m]", { transform: `rotate(-90 16 ${top + size / 2})` })];
  const [width, height] = [left + size + 150, top + size + bottom];
  return drawing("svg", { class: "curves", width, height, viewBox: `0 0 ${width} ${height}`, role: "img" }, cells, borders, labels, axes, ramp, border, mark);
}

function whirlFigures(run, runs) {
  return rowsIn(run, "whirl").flatMap(([begin, entries]) => {
    const name = begin.replace(/^whirl\./, "");
    const friction = entries[0].value;
    const map = whirlMap(run, begin, friction);
    return [
      figure(shareOfRun(run, runs, `Dry backward whirl: ${name}`), "Whirl goes on at any frequency at which the friction of rotor and race exceeds the needed one (thick red): slower it is braked, in the range it accelerates, and in full slip it settles at the upper end. This bearing alone, race at rest, linear mount.", factTable(entries), whirlCurves(run, begin, friction)),
      map ? figure(shareOfRun(run, runs, `Mount against dry whirl: ${name}`), "Smallest needed friction with another spring and damper; Maxwell branches stay. On the dark side of the red border friction of the file drives no whirl at any frequency looked at.", map) : null,
    ];
  });
}

function whirlSection(runs) {
  return section("whirl", "Dry backward whirl", runs.map((run) => whirlFigures(run, runs)));
}
