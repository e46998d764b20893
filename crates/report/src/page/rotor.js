// The pictures of the analysis of a rotor: shapes, Campbell diagram, response, stiffness map, margins.

const GROWS = "#b3261e";
// Least damping ratio that the diagram tells apart, %: where one passes through zero the axis would have no end.
const LEAST_DAMPING = 0.001;
const SENSE_COLOURS = { forward: "#1f5fa8", backward: "#c2571a", planar: "#5d6b78" };

// The rated speed, rad/s, and its mark in a diagram over speed.
function ratedSpeed(run) {
  const [rated] = shownIn(run, "rated");
  return rated ? rated.value : null;
}

function ratedMarks(run) {
  return ratedSpeed(run) ? [{ at: ratedSpeed(run), words: "rated" }] : [];
}

// A row of a table by the words of its columns.
function byWords(entries) {
  return Object.fromEntries(entries.map((entry) => [entry.words, entry.quantity.value]));
}

function senseDash(sense) {
  return sense === "backward" ? "7 4" : sense === "planar" ? "2 3" : null;
}

function rotorSection(runs) {
  return section("rotor", "The rotor", runs.map((run) => {
    const sagging = tableOf(run, "sag")("sag");
    const largest = Math.max(...sagging);
    const loads = shownIn(run, "support_loads");
    return [
      figure(shareOfRun(run, runs, "Rotor to scale"), DRAWN, rotorPicture(run, [])),
      figure(shareOfRun(run, runs, "Mass properties"), null, factTable(shownIn(run, "properties"))),
      sagging.length && largest
        ? figure(shareOfRun(run, runs, "Sag under its weight"), `Largest ${engineeringText(largest, "m", 4)}, in the direction of gravity.`, curves({ series: [{ x: tableOf(run, "nodes")("place").map((at) => 1e3 * at), y: sagging.map((value) => -1e6 * value), colour: LINE_COLOURS[0] }], across: "z [mm]", upright: "sag [µm]", height: 200 }), loads.length ? plainTable(["support", "load"], loads.map((entry) => [entry.words, cellOf(entry)])) : null)
        : null,
    ];
  }));
}

// The branches of the diagram: number and prevailing sense.
function branchesOf(run) {
  const senses = tableOf(run, "branches")("sense");
  return senses.map((_, index) => index + 1).map((number) => ({ number, sense: senses[number - 1] > 0 ? "forward" : senses[number - 1] < 0 ? "backward" : "planar" }));
}

function campbellFigures(run, runs) {
  const speed = overSpeed(run, "speed");
  if (!speed) return [notInThisRun("no diagram was computed", run)];
  const branches = branchesOf(run);
  const seen = new Set();
  const series = branches.map(({ number, sense }) => {
    const label = seen.has(sense) ? null : sense;
    seen.add(sense);
    return { label, x: speed, y: overSpeed(run, `branch_${number}.frequency`) || [], colour: SENSE_COLOURS[sense], dash: senseDash(sense) };
  });
  const top = Math.max(...series.flatMap((line) => line.y.filter(isNumber)), 0);
  const line = speed.filter((value) => value <= 1.02 * top);
  const found = rowsIn(run, "criticals");
  const criticals = found.map(([, entries]) => byWords(entries).speed);
  const diagram = curves({
    series: [...series, { label: "once a turn", x: line, y: line, colour: "#8995a0", dash: "2 3" }, { label: "critical speeds", x: criticals, y: criticals, colour: "#b3261e", line: false, dots: true, radius: 4 }],
    across: "speed of the rotor [rad/s]", above: IN_RPM, upright: "frequency [rad/s]", right: { label: "frequency [Hz]", factor: 1 / (2 * Math.PI) }, marks: ratedMarks(run), height: 420,
  });
  // rows of the response between the speeds of the diagram have no damping ratio, and are no gaps
  const ratios = branches.map(({ number, sense }) => ({ sense, points: (overSpeed(run, `branch_${number}.damping_ratio`) || []).map((value, row) => [speed[row], 100 * value, value]).filter(([, , value]) => isNumber(value)) }));
  const any = ratios.some(({ points }) => points.some(([, ratio]) => Math.abs(ratio) > 1e-6));
  const sized = (sign, { points }, line) => ({ ...line, gaps: true, x: points.map(([x]) => x), y: points.map(([, ratio]) => (sign * ratio > 1e-6 ? Math.max(sign * ratio, LEAST_DAMPING) : null)) });
  const growing = ratios.map((one) => sized(-1, one, { colour: GROWS, width: 3 })).filter(({ y }) => y.some(isNumber));
  if (growing.length) growing[0].label = "negative: the mode grows";
  const damped = [...ratios.map((one) => sized(1, one, { colour: SENSE_COLOURS[one.sense], dash: senseDash(one.sense) })), ...growing];
  const whirls = tableOf(run, "criticals_whirl")("whirl");
  const rows = found.map(([, [speedOf, ...others]], index) => [whirls[index], cellOf(speedOf), `${numberText(speedOf.value, 5)} rad/s`, ...others.map((entry) => (["fail", "grows"].includes(entry.quantity.value) ? element("strong", { class: "failed" }, entry.quantity.value) : cellOf(entry)))]);
  return [
    figure(shareOfRun(run, runs, "Campbell diagram"), "Damped natural frequencies over speed, each followed from speed to speed. Blue: with the spin; orange, dashed: against it; grey: along a line, or at rest. Where one meets the dotted line the rotor whirls once a turn.", diagram),
    any ? figure(shareOfRun(run, runs, "Damping of these modes"), `Size of the damping ratio; colours as above. Thick red: it is negative, and the mode grows. What is smaller than ${LEAST_DAMPING} % stands at ${LEAST_DAMPING} %.`, curves({ series: damped, across: "speed of the rotor [rad/s]", above: IN_RPM, upright: "damping ratio [%]", logarithmic: true, marks: ratedMarks(run), height: 340 })) : null,
    figure(shareOfRun(run, runs, "Critical speeds and their separation"), "Amplification 1/(2ζ) of the mode. Separation from the operating speeds, as a share of the nearer one.", rows.length ? plainTable(["whirl", "speed", "", "amplification", "separation", "verdict"], rows) : notInThisRun("no mode whirls once a turn up to the highest speed", run)),
  ];
}

function campbellSection(runs) {
  return section("campbell", "Frequencies and critical speeds", runs.map((run) => campbellFigures(analysisOf(run, false), runs)));
}

function shapeFigures(run, runs) {
  const shapes = rowsIn(run, "mode_shapes").map(([, [entry]]) => list(entry.quantity.value));
  const pictures = rowsIn(run, "modes").map(([, entries], index) => {
    const [frequency, damping, { value: _, quantity: whirl }] = entries;
    const words = `${frequencyText(frequency.value)}, ${whirl.value}, ζ ${percentText(damping.value, 3)}`;
    return figure(shareOfRun(run, runs, `Mode ${index + 1}: ${words}`), null, rotorPicture(run, [{ values: shapes[index], colour: SENSE_COLOURS[whirl.value] || INK, dash: senseDash(whirl.value) }]));
  });
  const frequencies = tableOf(run, "free_bending")("frequency");
  const bending = shownIn(run, "free_mode_shapes").slice(0, 4).map(({ quantity }, index) => ({ values: list(quantity.value), colour: LINE_COLOURS[index % LINE_COLOURS.length], label: frequencyText(frequencies[index]) }));
  return [
    bending.length ? figure(shareOfRun(run, runs, "First bending modes of the free rotor at rest"), "Without supports, seals and damping.", rotorPicture(run, bending)) : null,
    element("h3", {}, shareOfRun(run, runs, `Modes at ${speedText(ratedSpeed(run))}`)),
    element("div", { class: "pair" }, pictures),
  ];
}

function shapeSection(runs) {
  return section("shapes", "Mode shapes", runs.map((run) => shapeFigures(analysisOf(run, false), runs)));
}

function responsePlaces(run) {
  return [...run.columns.keys()].map((name) => /^response\.(.+)\.amplitude$/.exec(name)).filter(Boolean).map(([, place]) => place);
}

function rotorResponseFigures(run, runs) {
  const speed = overSpeed(run, "speed");
  const places = responsePlaces(run);
  const of = (end, scale, logarithmic) => places.map((place, index) => ({ label: place, x: speed, y: (overSpeed(run, `response.${place}.${end}`) || []).map((value) => (isNumber(value) ? scale * value : null)), colour: LINE_COLOURS[index % LINE_COLOURS.length], dash: index >= LINE_COLOURS.length ? "7 4" : null, gaps: !logarithmic }));
  const axes = { across: "speed of the rotor [rad/s]", above: IN_RPM, marks: ratedMarks(run) };
  // of a phase that goes round, the jump is a gap and no line
  const lags = of("lag", 180 / Math.PI).map((line) => ({ ...line, label: null, y: line.y.map((value, row) => (row && isNumber(value) && isNumber(line.y[row - 1]) && Math.abs(value - line.y[row - 1]) > 180 ? null : value)) }));
  const rows = rowsIn(run, "responses").map(([begin, entries]) => [begin.replace(/^response\./, ""), ...entries.map(cellOf)]);
  const z = tableOf(run, "nodes")("place").map((at) => 1e3 * at);
  const shapes = rowsIn(run, "deflections").map(([, [at, amplitude]], index) => ({ label: `${engineeringText(at.value, "rad/s", 5)}${index ? "" : " (rated)"}`, colour: LINE_COLOURS[index % LINE_COLOURS.length], x: z, y: list(amplitude.quantity.value).map((value) => 1e6 * value) }));
  return [
    figure(shareOfRun(run, runs, "Amplitude"), "Half the longer axis of the orbit under all unbalances together.", curves({ series: of("amplitude", 1e6, true), ...axes, upright: "amplitude [µm]", logarithmic: true, height: 340 })),
    figure(shareOfRun(run, runs, "Phase"), "How far the displacement in x is behind the mark on the rotor that angles count from.", curves({ series: lags, ...axes, upright: "lag [°]", height: 260 })),
    figure(shareOfRun(run, runs, "Peaks"), null, plainTable(["place", "largest amplitude", "at", "at the rated speed"], rows)),
    shapes.length ? figure(shareOfRun(run, runs, "Deflected shapes"), "Amplitude along the shaft, at the rated speed and at the four critical speeds that amplify most.", curves({ series: shapes, across: "z [mm]", upright: "amplitude [µm]", logarithmic: true, height: 300 })) : null,
  ];
}

function rotorResponseSection(runs) {
  return section("response", "Response to unbalance", runs.map((run) => rotorResponseFigures(analysisOf(run, false), runs)));
}

function stiffnessMapFigures(run, runs) {
  const [stiffness, ...speeds] = shownIn(run, "stiffness_map");
  const x = list(stiffness.quantity.value);
  const first = (words, index) => speeds.findIndex((entry) => entry.words === words) === index;
  const series = speeds.map(({ words: sense, quantity }, index) => ({ label: first(sense, index) ? sense : null, x, y: list(quantity.value), colour: SENSE_COLOURS[sense], dash: senseDash(sense) }));
  return [figure(shareOfRun(run, runs, "Undamped critical speeds over the stiffness of the supports"), "Every support of the shaft has the same stiffness; mounts of housings stay, seals are left out.", curves({ series: [...series, { label: "rated speed", x, y: x.map(() => Math.abs(ratedSpeed(run))), colour: "#8995a0", dash: "2 3" }], across: "stiffness of each support [N/m]", upright: "critical speed [rad/s]", right: { label: "", factor: 1 }, logarithmic: true, decades: true, height: 380 }))];
}

function stiffnessMapSection(runs) {
  return section("stiffness-map", "Stiffness map", runs.map((run) => stiffnessMapFigures(run, runs)));
}

// Axes of magnets: words, and the beginning of their results.
function magnetAxes(run) {
  return tableOf(run, "levitated_axes")("axis").map((label, index) => ({ label, begin: `levitation.${label.replace(/[. ]/g, "_")}`, colour: LINE_COLOURS[index % LINE_COLOURS.length], dash: index % 2 ? "7 4" : null }));
}

const ZONE_BOUNDS = [[3, "A below 3"], [4, "B below 4"], [5, "C below 5"]];

function sensitivityCurves(run, at) {
  const x = listOf(run, `levitation.${at}.frequencies`);
  const zones = ZONE_BOUNDS.map(([bound, label], k) => ({ label, x: [x[0], x[x.length - 1]], y: [bound, bound], colour: ["#2f8f5b", "#b58a00", "#b3261e"][k], dash: "2 3" }));
  const lines = magnetAxes(run).map(({ label, begin, colour, dash }) => ({ label, x, y: listOf(run, `${begin}.${at}.sensitivity`), colour, dash }));
  return curves({ series: [...lines, ...zones], across: "frequency [Hz]", upright: "|S|", logarithmic: true, decades: true, height: 320 });
}

function openLoop(run, begin, at) {
  return ["real", "imaginary"].map((part) => listOf(run, `${begin}.${at}.open_loop_${part}`));
}

// Size and phase of the open loops; the phase from -360 to 0 degrees, broken where it leaves one end for the other.
function bodeCurves(run, at) {
  const x = listOf(run, `levitation.${at}.frequencies`);
  const each = magnetAxes(run).map(({ label, begin, colour, dash }) => ({ label, colour, dash, x, parts: openLoop(run, begin, at) }));
  const phase = ([re, im]) => {
    const turned = re.map((value, k) => { const degrees = (180 / Math.PI) * Math.atan2(im[k], value); return degrees > 0 ? degrees - 360 : degrees; });
    return turned.map((value, k) => (k && Math.abs(value - turned[k - 1]) > 180 ? null : value));
  };
  const size = each.map(({ parts: [re, im], ...line }) => ({ ...line, y: re.map((value, k) => Math.hypot(value, im[k])) }));
  const turned = each.map(({ parts, ...line }) => ({ ...line, label: null, gaps: true, y: phase(parts) }));
  return [
    curves({ series: [...size, { x: [x[0], x[x.length - 1]], y: [1, 1], colour: "#8995a0", dash: "2 3" }], across: "frequency [Hz]", upright: "|L|", logarithmic: true, decades: true, height: 260 }),
    curves({ series: turned, across: "frequency [Hz]", upright: "phase of L [°]", decades: true, height: 220, level: { at: -180, words: "-180°" } }),
  ];
}

// Open loops near -1, with as much room upright as across; what lies far outside is left out. Circles: the zones of |S|.
function nyquistCurves(run, at) {
  const [height, reach] = [460, 2];
  const circles = ZONE_BOUNDS.map(([bound, label], k) => {
    const round = Array.from({ length: 73 }, (_, n) => (n * Math.PI) / 36);
    return { label: `zone ${label}`, x: round.map((a) => -1 + Math.cos(a) / bound), y: round.map((a) => Math.sin(a) / bound), colour: ["#2f8f5b", "#b58a00", "#b3261e"][k], dash: "2 3" };
  });
  const holder = element("div", { class: "curves" });
  const lines = magnetAxes(run).map(({ label, begin, colour, dash }) => {
    const [re, im] = openLoop(run, begin, at);
    return { label, colour, dash, gaps: true, re, im };
  });
  const [nearest] = lines.flatMap(({ label, re, im }) => re.map((value, k) => ({ label, k, x: value, y: im[k], far: Math.hypot(value + 1, im[k]) }))).filter(({ far }) => isNumber(far)).sort((one, other) => one.far - other.far);
  const least = nearest ? [{ label: `least distance from -1: ${numberText(nearest.far, 3)}, ${nearest.label}, at ${engineeringText(listOf(run, `levitation.${at}.frequencies`)[nearest.k], "Hz", 3)}`, x: [-1, nearest.x], y: [0, nearest.y], colour: NODE_DOT, width: 3 }] : [];
  const point = { label: "-1", x: [-1], y: [0], colour: "#b3261e", line: false, dots: true, radius: 4 };
  const series = (wide) => lines.map((line) => {
    const inside = (k) => isNumber(line.re[k]) && Math.abs(line.re[k] + 0.5) <= wide && Math.abs(line.im[k]) <= reach;
    return { ...line, x: line.re, y: line.im.map((value, k) => (inside(k) ? value : null)) };
  });
  const draw = () => {
    const width = holder.clientWidth || 900;
    const wide = (reach * (width - CURVE_BOX.left - CURVE_BOX.right)) / (height - CURVE_BOX.top - CURVE_BOX.bottom);
    const frame = { x: [-0.5 - wide, -0.5 + wide, -0.5, -0.5], y: [0, 0, -reach, reach], colour: "none", line: false };
    holder.replaceChildren(curveDrawing({ series: [frame, ...circles, ...series(wide), ...least, point], across: "Re L", upright: "Im L", height }, width));
  };
  resizable.push(draw);
  const keys = [...lines, point, ...least, ...circles].map((line) => element("span", { class: "curve-key" }, curveSample(line), line.label));
  return [holder, element("p", { class: "curve-keys" }, keys)];
}

function levitationFigures(run, runs) {
  const [re, im, damping] = ["Re λ", "Im λ", "damping ratio"].map(tableOf(run, "poles"));
  const poles = re.map((value, k) => [`${numberText(value, 6)} 1/s`, frequencyText(im[k]), Math.abs(im[k]) > 0.02 * Math.hypot(value, im[k]) ? (im[k] > 0 ? "with positive spin" : "against positive spin") : "–", percentText(damping[k], 3)]);
  const statics = rowsIn(run, "magnet_axes");
  const peaks = rowsIn(run, "sensitivities");
  const of = (rows, begin) => rows.filter(([key]) => key === begin || key.startsWith(`${begin}.`)).flatMap(([, entries]) => entries.map(cellOf));
  const rows = magnetAxes(run).map(({ label, begin }) => [label, ...of(statics, begin), ...of(peaks, begin)]);
  const rated = speedText(ratedSpeed(run));
  return [
    figure(shareOfRun(run, runs, "Axes of the magnets"), "Static state under weight; amplitude of the current under all unbalances; largest |S| of one axis with all others closed. Zones are quoted from memory of ISO 14839-3.", plainTable(["axis", ...statics.slice(0, 1).flatMap(([, entries]) => entries.map(({ words }) => words)), "peak |S| at standstill", "at", "zone", "at speed", "at", "zone"], rows)),
    figure(shareOfRun(run, runs, "Sensitivity at standstill"), null, sensitivityCurves(run, "standstill")),
    figure(shareOfRun(run, runs, `Sensitivity at ${rated}`), null, sensitivityCurves(run, "rated")),
    figure(shareOfRun(run, runs, `Open loops at ${rated} (Nyquist)`), "One axis opened, all others closed: the distance from -1 is 1/|S|. A loop that stays outside a circle keeps the sensitivity below its bound. What lies farther than 2 from the axis, or beside the picture, is left out: whether the loop is stable is said by its eigenvalues.", nyquistCurves(run, "rated")),
    figure(shareOfRun(run, runs, `Open loops at ${rated} (Bode)`), "Size and phase of the same.", bodeCurves(run, "rated")),
    figure(shareOfRun(run, runs, `Poles of the closed loop at ${rated}`), "Those of filters and integrators included, up to the highest frequency of the sensitivity.", curves({ series: [{ x: re.map((value) => -value), y: im, colour: LINE_COLOURS[0], line: false, dots: true, radius: 3 }], across: "decay -Re λ [1/s]", upright: "Im λ [rad/s]", decades: true, height: 320 }), plainTable(["Re λ", "Im λ", "sense", "damping ratio"], poles)),
  ];
}

function isLevitated(run) {
  return tableOf(run, "levitated_axes")("axis").length > 0;
}

function levitationSection(runs) {
  return section("levitation", "Magnets and controller", runs.map((run) => levitationFigures(run, runs)));
}

function rotorVerdict(run) {
  const unstable = quantityOf(run, "first_unstable_speed");
  const grows = isNumber(unstable.value);
  const stability = tile("Stability", grows ? engineeringText(unstable.value, "rad/s", 5) : "stable", [grows ? "from this speed on a mode grows" : unstable.why], verdictState(run, grows && unstable.value <= Math.abs(ratedSpeed(run))));
  return element("div", { class: "tiles" }, stateTile(run), stability, tilesOf(analysisOf(run, false)));
}

function rotorLine(run) {
  const supports = tableOf(run, "supports")("place").length;
  const disks = tableOf(run, "disks")("place").length;
  const facts = [...shownIn(run, "rotor_line").map((entry) => `${entry.words} ${cellOf(entry)}`), `${supports} supports`, disks ? `${disks} disks` : null];
  return element("p", { class: "machine" }, facts.filter(Boolean).join(" · "));
}

register("rotor", {
  line: rotorLine,
  verdict: rotorVerdict,
  time: null,
  facts: false,
  sections: (runs) => [
    [20, rotorSection, runs],
    [21, campbellSection, runs],
    [22, shapeSection, runs],
    [23, rotorResponseSection, runs.filter((run) => responsePlaces(analysisOf(run, false)).length)],
    [24, levitationSection, runs.filter(isLevitated)],
    [25, whirlSection, runs.filter((run) => shownIn(run, "whirl").length)],
    [26, rollingSection, runs.filter((run) => shownIn(run, "rolling_bearings").length)],
    [27, stiffnessMapSection, runs.filter((run) => tableOf(run, "stiffness_map")("stiffness").length)],
  ].filter(([, , part]) => part.length),
});
