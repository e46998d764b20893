// The pictures of the analysis of a rotor: shapes, Campbell diagram, response, stiffness map, margins.

const GROWS = "#b3261e";
// Least damping ratio that the diagram tells apart, %: where one passes through zero the axis would have no end.
const LEAST_DAMPING = 0.001;
const SENSE_COLOURS = { forward: "#1f5fa8", backward: "#c2571a", planar: "#5d6b78" };

function listAt(run, name) {
  return list(quantityOf(run, name).value);
}

function wordsAt(run, name) {
  const { value } = quantityOf(run, name);
  return typeof value === "string" && value ? value.split("\n") : [];
}

// Numbers that several results share: mode_1, mode_2 …
function numbered(run, begin, end) {
  const found = [];
  for (let number = 1; `${begin}_${number}${end}` in run.quantities; number++) found.push(number);
  return found;
}

function senseDash(sense) {
  return sense === "backward" ? "7 4" : sense === "planar" ? "2 3" : null;
}

function rotorSection(runs) {
  return section("rotor", "The rotor", runs.map((run) => {
    const rows = [
      ["mass", engineeringText(numberOf(run, "mass"), "kg", 5)],
      ["mass centre", engineeringText(numberOf(run, "mass_centre"), "m", 5)],
      ["polar inertia", siText(numberOf(run, "polar_inertia"), "kg m^2")],
      ["transverse inertia", siText(numberOf(run, "transverse_inertia"), "kg m^2")],
      ["length", engineeringText(numberOf(run, "length"), "m", 5)],
      ["nodes, coordinates of the diagrams", `${numberText(numberOf(run, "node_count"))}, ${numberText(numberOf(run, "coordinates"))}`],
    ];
    const sagging = listAt(run, "sag");
    const loads = Object.keys(run.quantities).filter((name) => name.startsWith("load."));
    return [
      figure(shareOfRun(run, runs, "Rotor to scale"), DRAWN, rotorPicture(run, [])),
      figure(shareOfRun(run, runs, "Mass properties"), null, plainTable(["", ""], rows)),
      sagging.length && numberOf(run, "largest_sag")
        ? figure(shareOfRun(run, runs, "Sag under its weight"), `Largest ${engineeringText(numberOf(run, "largest_sag"), "m", 4)}, in the direction of gravity.`, curves({ series: [{ x: listAt(run, "node_positions").map((at) => 1e3 * at), y: sagging.map((value) => -1e6 * value), colour: LINE_COLOURS[0] }], across: "z [mm]", upright: "sag [µm]", height: 200 }), loads.length ? plainTable(["support", "load"], loads.map((name) => [name.slice(5), engineeringText(numberOf(run, name), "N", 4)])) : null)
        : null,
    ];
  }));
}

// The branches of the diagram: number and prevailing sense.
function branchesOf(run) {
  const senses = listAt(run, "branch_senses");
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
  const criticals = numbered(run, "critical", ".speed").map((number) => numberOf(run, `critical_${number}.speed`));
  const rated = numberOf(run, "rated_speed");
  const diagram = curves({
    series: [...series, { label: "once a turn", x: line, y: line, colour: "#8995a0", dash: "2 3" }, { label: "critical speeds", x: criticals, y: criticals, colour: "#b3261e", line: false, dots: true, radius: 4 }],
    across: "speed of the rotor [rad/s]", above: IN_RPM, upright: "frequency [rad/s]", right: { label: "frequency [Hz]", factor: 1 / (2 * Math.PI) }, marks: rated ? [{ at: rated, words: "rated" }] : [], height: 420,
  });
  // rows of the response between the speeds of the diagram have no damping ratio, and are no gaps
  const ratios = branches.map(({ number, sense }) => ({ sense, points: (overSpeed(run, `branch_${number}.damping_ratio`) || []).map((value, row) => [speed[row], 100 * value, value]).filter(([, , value]) => isNumber(value)) }));
  const any = ratios.some(({ points }) => points.some(([, ratio]) => Math.abs(ratio) > 1e-6));
  const sized = (sign, { points }, line) => ({ ...line, gaps: true, x: points.map(([x]) => x), y: points.map(([, ratio]) => (sign * ratio > 1e-6 ? Math.max(sign * ratio, LEAST_DAMPING) : null)) });
  const growing = ratios.map((one) => sized(-1, one, { colour: GROWS, width: 3 })).filter(({ y }) => y.some(isNumber));
  if (growing.length) growing[0].label = "negative: the mode grows";
  const damped = [...ratios.map((one) => sized(1, one, { colour: SENSE_COLOURS[one.sense], dash: senseDash(one.sense) })), ...growing];
  const rows = numbered(run, "critical", ".speed").map((number) => {
    const at = (name) => numberOf(run, `critical_${number}.${name}`);
    const amplification = at("amplification");
    const verdict = quantityOf(run, `critical_${number}.verdict`).value;
    return [number, engineeringText(at("speed"), "rad/s", 5), `${numberText(at("speed"), 5)} rad/s`, wordsAt(run, "critical_whirls")[number - 1], amplification === null ? quantityOf(run, `critical_${number}.amplification`).why : numberText(amplification, 3), percentText(at("separation"), 3), verdict ? element("strong", { class: verdict === "fail" || verdict === "grows" ? "failed" : null }, verdict) : "–"];
  });
  return [
    figure(shareOfRun(run, runs, "Campbell diagram"), "Damped natural frequencies over speed, each followed from speed to speed. Blue: with the spin; orange, dashed: against it; grey: along a line, or at rest. Where one meets the dotted line the rotor whirls once a turn.", diagram),
    any ? figure(shareOfRun(run, runs, "Damping of these modes"), `Size of the damping ratio; colours as above. Thick red: it is negative, and the mode grows. What is smaller than ${LEAST_DAMPING} % stands at ${LEAST_DAMPING} %.`, curves({ series: damped, across: "speed of the rotor [rad/s]", above: IN_RPM, upright: "damping ratio [%]", logarithmic: true, marks: rated ? [{ at: rated, words: "rated" }] : [], height: 340 })) : null,
    figure(shareOfRun(run, runs, "Critical speeds and their separation"), "Amplification 1/(2ζ) of the mode. Separation from the operating speeds, as a share of the nearer one.", rows.length ? plainTable(["", "speed", "", "whirl", "amplification", "separation", "verdict"], rows) : notInThisRun("no mode whirls once a turn up to the highest speed", run)),
  ];
}

function campbellSection(runs) {
  return section("campbell", "Frequencies and critical speeds", runs.map((run) => campbellFigures(run, runs)));
}

function shapeFigures(run, runs) {
  const modes = numbered(run, "mode", ".shape");
  const free = numbered(run, "free_mode", ".shape");
  const pictures = modes.map((number) => {
    const sense = quantityOf(run, `mode_${number}.whirl`).value;
    const words = `${frequencyText(numberOf(run, `mode_${number}.frequency`))}, ${sense}, ζ ${percentText(numberOf(run, `mode_${number}.damping_ratio`), 3)}`;
    return figure(shareOfRun(run, runs, `Mode ${number}: ${words}`), null, rotorPicture(run, [{ values: listAt(run, `mode_${number}.shape`), colour: SENSE_COLOURS[sense] || INK, dash: senseDash(sense) }]));
  });
  const frequencies = listAt(run, "free_bending_frequencies");
  const bending = free.slice(0, 4).map((number, index) => ({ values: listAt(run, `free_mode_${number}.shape`), colour: LINE_COLOURS[index % LINE_COLOURS.length], label: frequencyText(frequencies[number - 1]) }));
  return [
    bending.length ? figure(shareOfRun(run, runs, "First bending modes of the free rotor at rest"), "Without supports, seals and damping.", rotorPicture(run, bending)) : null,
    element("h3", {}, shareOfRun(run, runs, `Modes at ${speedText(numberOf(run, "rated_speed"))}`)),
    element("div", { class: "pair" }, pictures),
  ];
}

function shapeSection(runs) {
  return section("shapes", "Mode shapes", runs.map((run) => shapeFigures(run, runs)));
}

function responsePlaces(run) {
  return [...run.columns.keys()].map((name) => /^response\.(.+)\.amplitude$/.exec(name)).filter(Boolean).map(([, place]) => place);
}

function rotorResponseFigures(run, runs) {
  const speed = overSpeed(run, "speed");
  const places = responsePlaces(run);
  const of = (end, scale, logarithmic) => places.map((place, index) => ({ label: place, x: speed, y: (overSpeed(run, `response.${place}.${end}`) || []).map((value) => (isNumber(value) ? scale * value : null)), colour: LINE_COLOURS[index % LINE_COLOURS.length], dash: index >= LINE_COLOURS.length ? "7 4" : null, gaps: !logarithmic }));
  const rated = numberOf(run, "rated_speed");
  const axes = { across: "speed of the rotor [rad/s]", above: IN_RPM, marks: rated ? [{ at: rated, words: "rated" }] : [] };
  // of a phase that goes round, the jump is a gap and no line
  const lags = of("lag", 180 / Math.PI).map((line) => ({ ...line, label: null, y: line.y.map((value, row) => (row && isNumber(value) && isNumber(line.y[row - 1]) && Math.abs(value - line.y[row - 1]) > 180 ? null : value)) }));
  const rows = places.map((place) => [place, engineeringText(numberOf(run, `response.${place}.peak_amplitude`), "m", 4), engineeringText(numberOf(run, `response.${place}.peak_speed`), "rad/s", 5), engineeringText(numberOf(run, `response.${place}.rated_amplitude`), "m", 4)]);
  const deflected = numbered(run, "deflection", ".speed").map((number, index) => ({ number, colour: LINE_COLOURS[index % LINE_COLOURS.length], label: `${engineeringText(numberOf(run, `deflection_${number}.speed`), "rad/s", 5)}${number === 1 ? " (rated)" : ""}` }));
  const z = listAt(run, "node_positions").map((at) => 1e3 * at);
  const shapes = deflected.map(({ number, colour, label }) => ({ label, colour, x: z, y: listAt(run, `deflection_${number}.amplitude`).map((value) => 1e6 * value) }));
  return [
    figure(shareOfRun(run, runs, "Amplitude"), "Half the longer axis of the orbit under all unbalances together.", curves({ series: of("amplitude", 1e6, true), ...axes, upright: "amplitude [µm]", logarithmic: true, height: 340 })),
    figure(shareOfRun(run, runs, "Phase"), "How far the displacement in x is behind the mark on the rotor that angles count from.", curves({ series: lags, ...axes, upright: "lag [°]", height: 260 })),
    figure(shareOfRun(run, runs, "Peaks"), null, plainTable(["place", "largest amplitude", "at", "at the rated speed"], rows)),
    shapes.length ? figure(shareOfRun(run, runs, "Deflected shapes"), "Amplitude along the shaft, at the rated speed and at the four critical speeds that amplify most.", curves({ series: shapes, across: "z [mm]", upright: "amplitude [µm]", logarithmic: true, height: 300 })) : null,
  ];
}

function rotorResponseSection(runs) {
  return section("response", "Response to unbalance", runs.map((run) => rotorResponseFigures(run, runs)));
}

function stiffnessMapFigures(run, runs) {
  const x = listAt(run, "map_stiffnesses");
  const of = (sense) => numbered(run, `map_${sense}`, "").map((number) => ({ label: number === 1 ? sense : null, x, y: listAt(run, `map_${sense}_${number}`), colour: SENSE_COLOURS[sense], dash: senseDash(sense) }));
  const rated = numberOf(run, "rated_speed");
  return [figure(shareOfRun(run, runs, "Undamped critical speeds over the stiffness of the supports"), "Every support of the shaft has the same stiffness; mounts of housings stay, seals are left out.", curves({ series: [...of("forward"), ...of("backward"), { label: "rated speed", x, y: x.map(() => Math.abs(rated)), colour: "#8995a0", dash: "2 3" }], across: "stiffness of each support [N/m]", upright: "critical speed [rad/s]", right: { label: "", factor: 1 }, logarithmic: true, decades: true, height: 380 }))];
}

function stiffnessMapSection(runs) {
  return section("stiffness-map", "Stiffness map", runs.map((run) => stiffnessMapFigures(run, runs)));
}

// Axes of magnets: words, and the beginning of their results.
function magnetAxes(run) {
  return wordsAt(run, "levitation.axes").map((label, index) => ({ label, begin: `levitation.${label.replace(/[. ]/g, "_")}`, colour: LINE_COLOURS[index % LINE_COLOURS.length], dash: index % 2 ? "7 4" : null }));
}

const ZONE_BOUNDS = [[3, "A below 3"], [4, "B below 4"], [5, "C below 5"]];

function sensitivityCurves(run, at) {
  const x = listAt(run, `levitation.${at}.frequencies`);
  const zones = ZONE_BOUNDS.map(([bound, label], k) => ({ label, x: [x[0], x[x.length - 1]], y: [bound, bound], colour: ["#2f8f5b", "#b58a00", "#b3261e"][k], dash: "2 3" }));
  const lines = magnetAxes(run).map(({ label, begin, colour, dash }) => ({ label, x, y: listAt(run, `${begin}.${at}.sensitivity`), colour, dash }));
  return curves({ series: [...lines, ...zones], across: "frequency [Hz]", upright: "|S|", logarithmic: true, decades: true, height: 320 });
}

function openLoop(run, begin, at) {
  return ["real", "imaginary"].map((part) => listAt(run, `${begin}.${at}.open_loop_${part}`));
}

// Size and phase of the open loops; the phase from -360 to 0 degrees, broken where it leaves one end for the other.
function bodeCurves(run, at) {
  const x = listAt(run, `levitation.${at}.frequencies`);
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
  const least = nearest ? [{ label: `least distance from -1: ${numberText(nearest.far, 3)}, ${nearest.label}, at ${engineeringText(listAt(run, `levitation.${at}.frequencies`)[nearest.k], "Hz", 3)}`, x: [-1, nearest.x], y: [0, nearest.y], colour: NODE_DOT, width: 3 }] : [];
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
  const [re, im, damping] = ["real_parts", "imaginary_parts", "damping_ratios"].map((part) => listAt(run, `levitation.pole_${part}`));
  const poles = re.map((value, k) => [`${numberText(value, 6)} 1/s`, frequencyText(im[k]), Math.abs(im[k]) > 0.02 * Math.hypot(value, im[k]) ? (im[k] > 0 ? "with positive spin" : "against positive spin") : "–", percentText(damping[k], 3)]);
  const rows = magnetAxes(run).map(({ label, begin }) => {
    const at = (name) => numberOf(run, `${begin}.${name}`);
    const stiffness = at("static_stiffness");
    return [label, stiffness === null ? quantityOf(run, `${begin}.static_stiffness`).why : siText(stiffness, "N/m"), engineeringText(at("static_current"), "A", 4), engineeringText(at("static_displacement"), "m", 4), engineeringText(at("unbalance_current"), "A", 4), numberText(at("standstill.sensitivity_peak"), 4), numberText(at("rated.sensitivity_peak"), 4), `${numberText(at("rated.sensitivity_peak_frequency"), 4)} Hz`, ["standstill", "rated"].map((when) => quantityOf(run, `${begin}.${when}.zone`).value).sort().pop()];
  });
  const rated = speedText(numberOf(run, "rated_speed"));
  return [
    figure(shareOfRun(run, runs, "Axes of the magnets"), "Static state under weight; amplitude of the current under all unbalances; largest |S| of one axis with all others closed. Zones are quoted from memory of ISO 14839-3.", plainTable(["axis", "static stiffness", "static current", "static displacement", "unbalance current", "peak |S| at standstill", "at speed", "at", "zone of both"], rows)),
    figure(shareOfRun(run, runs, "Sensitivity at standstill"), null, sensitivityCurves(run, "standstill")),
    figure(shareOfRun(run, runs, `Sensitivity at ${rated}`), null, sensitivityCurves(run, "rated")),
    figure(shareOfRun(run, runs, `Open loops at ${rated} (Nyquist)`), "One axis opened, all others closed: the distance from -1 is 1/|S|. A loop that stays outside a circle keeps the sensitivity below its bound. What lies farther than 2 from the axis, or beside the picture, is left out: whether the loop is stable is said by its eigenvalues.", nyquistCurves(run, "rated")),
    figure(shareOfRun(run, runs, `Open loops at ${rated} (Bode)`), "Size and phase of the same.", bodeCurves(run, "rated")),
    figure(shareOfRun(run, runs, `Poles of the closed loop at ${rated}`), "Those of filters and integrators included, up to the highest frequency of the sensitivity.", curves({ series: [{ x: re.map((value) => -value), y: im, colour: LINE_COLOURS[0], line: false, dots: true, radius: 3 }], across: "decay -Re λ [1/s]", upright: "Im λ [rad/s]", decades: true, height: 320 }), plainTable(["Re λ", "Im λ", "sense", "damping ratio"], poles)),
  ];
}

function isLevitated(run) {
  return wordsAt(run, "levitation.axes").length > 0;
}

function levitationSection(runs) {
  return section("levitation", "Magnets and controller", runs.map((run) => levitationFigures(run, runs)));
}

function rotorVerdict(run) {
  const first = quantityOf(run, "first_critical_speed");
  const verdict = quantityOf(run, "separation_verdict").value;
  const unstable = quantityOf(run, "first_unstable_speed");
  const rated = numberOf(run, "rated_speed");
  const bending = numberOf(run, "first_bending_frequency");
  const grows = isNumber(unstable.value) && unstable.value <= Math.abs(rated);
  return element(
    "div",
    { class: "tiles" },
    stateTile(run),
    tile("First critical speed", isNumber(first.value) ? engineeringText(first.value, "rad/s", 5) : "–", [isNumber(first.value) ? `${numberText(first.value, 5)} rad/s` : first.why]),
    tile("Separation", typeof verdict === "string" ? verdict : "–", [typeof verdict === "string" ? "critical speeds against analysis.separation_margin" : quantityOf(run, "separation_verdict").why], typeof verdict === "string" ? verdictState(run, verdict !== "pass") : null),
    tile("Stability", isNumber(unstable.value) ? engineeringText(unstable.value, "rad/s", 5) : "stable", [isNumber(unstable.value) ? "from this speed on a mode grows" : unstable.why], verdictState(run, grows)),
    typeof quantityOf(run, "levitation.zone").value === "string" ? tile("Largest sensitivity", numberText(numberOf(run, "levitation.largest_sensitivity"), 3), [`zone ${quantityOf(run, "levitation.zone").value}, slowest eigenvalue ${numberText(numberOf(run, "levitation.slowest_eigenvalue"), 3)} 1/s`]) : null,
    tile("First free bending mode", isNumber(bending) ? `${numberText(bending / (2 * Math.PI), 5)} Hz` : "–", [isNumber(bending) ? `${numberText(bending, 5)} rad/s, of the free rotor at rest` : "of the free rotor at rest"]),
    tile("Largest sag", engineeringText(numberOf(run, "largest_sag"), "m", 4), ["under its weight"]),
    tile("Error of the reduction", numberOf(run, "reduction_error") === null ? "none" : numberText(numberOf(run, "reduction_error"), 2), [numberOf(run, "reduction_error") === null ? "all coordinates are kept" : "of eigenvalues at the highest speed"]),
  );
}

function rotorLine(run) {
  const facts = [
    `${engineeringText(numberOf(run, "mass"), "kg", 4)}, ${engineeringText(numberOf(run, "length"), "m", 4)} long`,
    `rated ${speedText(numberOf(run, "rated_speed"))}`,
    `${listAt(run, "support_positions").length} supports`,
    listAt(run, "disk_positions").length ? `${listAt(run, "disk_positions").length} disks` : null,
  ].filter(Boolean);
  return element("p", { class: "machine" }, facts.join(" · "));
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
    [23, rotorResponseSection, runs.filter((run) => responsePlaces(run).length)],
    [24, levitationSection, runs.filter(isLevitated)],
    [25, stiffnessMapSection, runs.filter((run) => listAt(run, "map_stiffnesses").length)],
  ].filter(([, , part]) => part.length),
});
