// The pictures of an identification, in the layout of the source paper's Figs 7 to 10: torque over speed from the slow tests,
// then speed, acceleration and torque of each test with the steady torque laid over, with bands; and the verdict.

// A probability; what is hardly possible is not shown to its last digit.
function chanceText(probability) {
  if (probability > 0.9999) return "> 99.99 %";
  // near 1 as many digits as what is left needs
  return probability > 0 && probability < 1e-4 ? "< 0.01 %" : percentText(probability, probability > 0.99 ? 4 : 3);
}
// 2 % settling of the arm in the source paper, s: the torque before it is what the inversion of the sensor makes of it.
const SENSOR_SETTLING = 0.1;

function testsOf(run) {
  const names = Object.keys(run.quantities).map((name) => /^test_(\d+)\.name$/.exec(name)).filter(Boolean);
  return names.map((match) => ({ key: `test_${match[1]}`, number: Number(match[1]), name: String(quantityOf(run, `test_${match[1]}.name`).value) }));
}

function bandCurves(x, values, deviations, scale, label, colour) {
  const moved = (sign) => values.map((value, row) => (isNumber(value) && isNumber(deviations[row]) ? scale * (value + sign * BAND * deviations[row]) : null));
  return [
    { label, x, y: values.map((value) => (isNumber(value) ? scale * value : null)), colour, width: 2 },
    { x, y: moved(1), colour: colour + "90", width: 0.75 },
    { x, y: moved(-1), colour: colour + "90", width: 0.75 },
  ];
}

// Why a figure has nothing to show.
function whyNone(run, figure) {
  return shownIn(run, figure).map(({ quantity }) => quantity.why).find(Boolean) || "no reason is given";
}

// The explanation that the tests support, and the form of the steady moment.
function conclusionOf(run) {
  return quantityOf(run, "explanation");
}

function formOf(run) {
  return quantityOf(run, "steady_moment_form");
}

function explanationFigure(run, runs) {
  const title = shareOfRun(run, runs, "Which explanation the data support");
  const conclusion = conclusionOf(run);
  if (typeof conclusion.value !== "string") return figure(title, null, notInThisRun("a comparison of explanations: " + (conclusion.why || "no reason is given")));
  const rows = shownIn(run, "explanations").map(({ words: name, value: probability }) => {
    return element(
      "tr",
      {},
      element("td", { class: "name" }, name),
      element("td", { class: "bar" }, probability === null ? null : element("div", { style: `width:${100 * probability}%;background:${SERIES_COLOURS.rotor}` })),
      element("td", {}, probability === null ? "–" : chanceText(probability)),
    );
  });
  const parameters = quantityOf(run, "explanation_parameters").value;
  const fit = numberOf(run, "explanation_fit_probability");
  const limits = quantityOf(run, "explanation_slip_limit").value;
  const fits = fit === null ? "" : `. If it is true, ${fit > 0.995 ? "nearly all" : percentText(fit, 2)} of such measurements would fit it worse`;
  const next = String(quantityOf(run, "next_tests").value || "").split("\n").filter(Boolean).map((line) => line.replace(/^\d+\. /, ""));
  return [
    figure(
      title,
      `Probability after the data, by marginal likelihood of ${numberText(numberOf(run, "explanation_effective_data"), 3)} effective data. Below the limit of decision the answer is undecided.`,
      element("p", {}, element("strong", {}, "Verdict: " + conclusion.value), typeof limits === "string" ? ` (${limits})` : null),
      element("table", { class: "bars" }, element("tbody", {}, rows)),
      typeof parameters === "string" ? element("p", { class: "small" }, "Most probable: " + parameters + fits) : null,
    ),
    next.length ? figure(shareOfRun(run, runs, "The next test, the most informative first"), "Expected part of what is open between the explanations that the test would settle.", element("ol", {}, next.map((line) => element("li", {}, line)))) : null,
  ];
}

// The explanations whose torque the history holds for a test: the likeliest first.
function predictionsOf(run, test) {
  const start = `${test.key}.predicted_by.`;
  const names = [...run.columns.keys()].filter((name) => name.startsWith(start) && columnOf(run, name));
  return names.map((name, index) => ({ name, words: name.slice(start.length).replaceAll("_", " "), colour: index ? SERIES_COLOURS.race : SERIES_COLOURS.rotor, dash: index ? "7 4" : undefined }));
}

// One value for each mean with its times: rows inside one mean repeat it.
function meansOf(run, names) {
  const rows = [];
  let begin = null;
  const at = (row) => names.map((name) => columnOf(run, name)[row]);
  run.time.forEach((time, row) => {
    const values = at(row);
    if (!values.every(isNumber)) {
      begin = null;
      return;
    }
    if (begin && begin.values.every((value, index) => value === values[index])) begin.to = time;
    else rows.push((begin = { from: time, to: time, values }));
  });
  return rows.map(({ from, to, values }) => ({ from, to, middle: 0.5 * (from + to), values }));
}

// What the two likeliest explanations predict for the means that were compared, over the data, and what they leave.
function predictionFigures(run, runs) {
  return testsOf(run).map((test) => {
    const predictions = predictionsOf(run, test);
    const measured = `${test.key}.torque_mean`;
    if (!predictions.length || !columnOf(run, measured)) return null;
    const means = meansOf(run, [measured, ...predictions.map(({ name }) => name)]).filter(({ middle }) => middle > 0);
    // a mean is drawn as long as it lasts
    const steps = (value) => ({ x: means.flatMap(({ from, to }) => [1e3 * from, 1e3 * to]), y: means.flatMap((mean) => [value(mean), value(mean)]) });
    const torque = [
      ...predictions.map(({ words, colour, dash }, index) => ({ ...steps(({ values }) => 1e3 * values[index + 1]), label: `${index ? "next best" : "likeliest"}: ${words}`, colour, dash, width: 2 })),
      { x: means.map(({ middle }) => 1e3 * middle), y: means.map(({ values }) => 1e3 * values[0]), label: "measured, means", colour: INK, dots: true, line: false, radius: 2.2 },
    ];
    const left = predictions.map(({ words, colour, dash }, index) => ({ ...steps(({ values }) => 1e3 * (values[0] - values[index + 1])), label: words, colour, dash, width: 1.75 }));
    const axes = { across: "time since the engagement [ms]", decades: true };
    return figure(
      shareOfRun(run, runs, `${test.name}: what the explanations predict, over the data`),
      "Means of the torque t_O, on which the explanations were compared, over a time in decades. Below: measured less predicted; what is common to a test, its zero, scale and level of M, may be off within its deviation and is not taken out here.",
      curves({ series: torque, ...axes, upright: "torque [N mm]", height: 280 }),
      curves({ series: left, ...axes, upright: "residual [N mm]", height: 170 }),
    );
  });
}

function explanationSection(runs) {
  return section("explanations", "Verdict", runs.map((run) => [explanationFigure(run, runs), predictionFigures(run, runs)]));
}

// Forms of the steady moment, as the field calls them.
const FORMS = { palmgren: "Palmgren's form", skf: "SKF's form", spline: "spline" };

function steadyFigure(run, runs) {
  const title = shareOfRun(run, runs, "Torque on the outer race at steady speed");
  const [speeds, moments, deviations] = ["speed", "moment", "deviation"].map(tableOf(run, "steady_curve"));
  if (!speeds.length) return figure(title, null, notInThisRun("a steady moment: " + whyNone(run, "steady_curve")));
  const points = tableOf(run, "steady_points");
  const measured = [points("speed"), points("torque").map((value) => 1e3 * value)];
  const form = formOf(run).value;
  const series = [
    ...bandCurves(speeds, moments, deviations, 1e3, `M, ${FORMS[form] || form}`, SERIES_COLOURS.limit),
    // on top of the line, and thin enough to leave it to be seen
    { label: "measured", x: measured[0], y: measured[1], colour: INK, dots: true, line: false, radius: 1.1 },
  ];
  const forms = Object.keys(FORMS).map((name) => [name, numberOf(run, `probability_of_${name}_form`)]).filter(([, probability]) => probability !== null);
  const correlation = numberOf(run, "largest_parameter_correlation");
  const words = forms.map(([name, probability]) => `${FORMS[name]} ${chanceText(probability)}`).join(", ");
  return figure(
    title,
    `From the slow tests. Probability of the forms: ${words}. ${correlation === null ? "" : `Parameters correlate up to ${numberText(correlation, 3)}: the curve counts, not they. `}${BAND_WORDS}`,
    curves({ series, across: "speed [rad/s]", above: IN_RPM, upright: "torque [N mm]", height: 320 }),
    steadyResidual(run, measured),
  );
}

// Measured less M, where both are known; pale lines: twice the standard deviation of M.
function steadyResidual(run, [x, y]) {
  const curve = tableOf(run, "steady_curve");
  const speeds = curve("speed");
  const [moments, deviations] = ["moment", "deviation"].map((words) => curve(words).map((value) => 1e3 * value));
  const rows = x.map((_, row) => row).filter((row) => x[row] >= speeds[0] && x[row] <= speeds[speeds.length - 1]);
  const left = rows.map((row) => y[row] - valueAt(speeds, moments, x[row]));
  const pale = (sign) => ({ x: speeds, y: deviations.map((deviation) => sign * BAND * deviation), colour: SERIES_COLOURS.limit + "90", width: 0.75 });
  const series = [pale(1), pale(-1), { label: "measured less M", x: rows.map((row) => x[row]), y: left, colour: INK, dots: true, line: false, radius: 1.1 }];
  return rows.length ? curves({ series, across: "speed [rad/s]", upright: "residual [N mm]", height: 150 }) : null;
}

function steadyMomentSection(runs) {
  return section("steady", "Steady friction moment", runs.map((run) => steadyFigure(run, runs)));
}

function settledMarks() {
  return instantMarks([
    { instant: 0, words: "engaged", colour: SERIES_COLOURS.quiet },
    { instant: SENSOR_SETTLING, words: "arm settled (0.1 s)", colour: SERIES_COLOURS.quiet },
  ]);
}

// Rows of a test from a little before its engagement to some time after, s.
function rowsUpTo(run, upto) {
  return run.time.map((_, row) => row).filter((row) => run.time[row] >= -0.1 * upto && run.time[row] <= upto);
}

// The quick part of a test closely: speed and acceleration, as long again as the spin-up takes.
function quickFigures(run, test) {
  const until = numberOf(run, `${test.key}.dissipation_until`);
  if (until === null) return null;
  const rows = rowsUpTo(run, 2 * until);
  const x = rows.map((row) => 1e3 * run.time[row]);
  const of = (name) => rows.map((row) => (columnOf(run, `${test.key}.${name}`) || [])[row]);
  const look = (name, label, colour, right) => curves({ series: bandCurves(x, of(name), of(name + "_deviation"), 1, label, colour), across: "time since the engagement [ms]", upright: label, right, height: 200 });
  return [figure(`${test.name}: speed and acceleration after the engagement, closely`, null, look("speed", "speed [rad/s]", SERIES_COLOURS.rotor, IN_RPM), look("acceleration", "acceleration [rad/s²]", SERIES_COLOURS.race))];
}

// F over the spin-ups closely: its band is wide only there.
function frictionClosely(run, tests) {
  const until = Math.max(...tests.map((test) => numberOf(run, `${test.key}.dissipation_until`) || 0));
  const rows = rowsUpTo(run, 2 * until);
  const x = rows.map((row) => 1e3 * run.time[row]);
  const series = tests.flatMap((test, index) => {
    const of = (name) => rows.map((row) => (columnOf(run, `${test.key}.${name}`) || [])[row]);
    return columnOf(run, `${test.key}.friction`) ? bandCurves(x, of("friction"), of("friction_deviation"), 1, test.name, LINE_COLOURS[index % LINE_COLOURS.length]) : [];
  });
  return until > 0 && series.length ? curves({ series, across: "time since the engagement [ms]", upright: "F [N]", height: 260 }) : null;
}

// The first part of a test closely, where its torque is decided.
function closeFigure(run, test) {
  const rows = rowsUpTo(run, 0.6);
  const x = rows.map((row) => 1e3 * run.time[row]);
  const of = (name) => rows.map((row) => (columnOf(run, `${test.key}.${name}`) || [])[row]);
  const steady = { label: "steady torque at this speed", x, y: of("steady_moment").map((value) => (isNumber(value) ? 1e3 * value : null)), colour: SERIES_COLOURS.limit, dash: "7 4" };
  const series = [...bandCurves(x, of("torque"), of("torque_deviation"), 1e3, "t_O", SERIES_COLOURS.race), steady];
  return figure(`${test.name}: the torque after the engagement, closely`, null, curves({ series, across: "time since the engagement [ms]", upright: "torque [N mm]", height: 260 }));
}

function testFigures(run, test) {
  const one = [run];
  const of = (name, scale, look) => bandLines(one, `${test.key}.${name}`, `${test.key}.${name}_deviation`, scale, look);
  const steady = of("steady_moment", 1e3, { label: "steady torque at this speed [N mm]", colour: SERIES_COLOURS.limit, width: 1.5, dash: [7, 4] });
  const marks = settledMarks();
  const slip = of("cage_slip", 100, { label: "slip [%]", colour: SERIES_COLOURS.cage, width: 1.25, widest: WIDEST_SLIP });
  const peak = numberOf(run, `${test.key}.peak_acceleration`);
  const title = `${test.name}${peak === null ? "" : `, peak ${numberText(peak, 4)} rad/s²`}`;
  return [
    figure(`${title}: speed`, BAND_WORDS, timePlot({ series: of("speed", 1, { label: "speed [rad/s]", colour: SERIES_COLOURS.rotor, width: 1.5 }), label: "speed [rad/s]", second: IN_RPM, marks, height: 180 })),
    figure("Acceleration", null, timePlot({ series: of("acceleration", 1, { label: "acceleration [rad/s²]", colour: SERIES_COLOURS.race, width: 1.25 }), label: "acceleration [rad/s²]", marks, height: 180 })),
    figure("Torque on the outer race, without the sensor's swing", "Dashed: the steady torque of the slow tests at the speed of the moment.", timePlot({ series: [...of("torque", 1e3, { label: "t_O [N mm]", colour: SERIES_COLOURS.race, width: 1.5 }), ...steady], label: "torque [N mm]", marks, height: 260 })),
    quickFigures(run, test),
    closeFigure(run, test),
    slip.length ? figure("Slip of the cage", `0 % where the balls roll; nothing is drawn where the band is wider than ±${WIDEST_SLIP} %.`, timePlot({ series: slip, label: "slip [%]", include: () => [-0.5, 0.5], height: 160 })) : notInThisRun("slip: " + (quantityOf(run, `${test.key}.slip_probability`).why || "no cage signal"), run),
  ];
}

function testSection(runs) {
  return section("tests", "The tests", runs.map((run) => testsOf(run).map((test) => testFigures(run, test))));
}

function uncertainText(run, name, unit, scale = 1) {
  const [value, deviation] = [numberOf(run, name), numberOf(run, name + "_deviation")];
  if (value === null) return element("span", { class: "absent" }, quantityOf(run, name).why || "–");
  return `${bandNumbers(scale * value, deviation === null ? null : BAND * scale * deviation)} ${unit}`.trim();
}

function lossFigures(run, runs) {
  const tests = testsOf(run);
  if (!tests.length) return null;
  const table = plainTable(
    ["test", "t_O − M, 0.2 to 0.4 s", "t_O − M, last 0.5 s at speed", "torque that would bring balls and cage to speed in 3.5 s", "cage slipped", "balls skidded, if M holds", "rolls from, after the engagement"],
    tests.map((test) => {
      const shares = shownIn(run, "slips").filter(({ name }) => name.startsWith(`${test.key}.`));
      const share = (words) => shares.filter((entry) => entry.words === words && entry.value !== null).map(({ value }) => chanceText(value))[0] || "–";
      const from = numberOf(run, `${test.key}.rolling_established_at`);
      return [test.name, uncertainText(run, `${test.key}.excess_torque_settled`, "N mm", 1e3), uncertainText(run, `${test.key}.excess_torque_at_end`, "N mm", 1e3), `${numberText(1e3 * numberOf(run, `${test.key}.torque_to_roll_within_3_5_s`), 2)} N mm`, share("cage slipped"), share("balls skidded, if M holds"), from === null ? quantityOf(run, `${test.key}.rolling_established_at`).why || "–" : engineeringText(from, "s", 3)];
    }),
  );
  const energies = plainTable(
    ["test", "until, after the engagement", "best", "(21) as printed", "corrected, rolling", "exact, with the cage signal", "without a cage signal"],
    tests.map((test) => [test.name, engineeringText(numberOf(run, `${test.key}.dissipation_until`), "s", 3), ...["", "_printed", "_corrected", "_exact", "_without_cage"].map((form) => uncertainText(run, `${test.key}.dissipated_energy${form}`, "J"))]),
  );
  const friction = tests.flatMap((test, index) => bandLines([run], `${test.key}.friction`, `${test.key}.friction_deviation`, 1, { label: `${test.name} [N]`, colour: LINE_COLOURS[index % LINE_COLOURS.length], width: 1.25 }));
  return [
    figure(shareOfRun(run, runs, "Beyond the steady moment"), "± is twice the standard deviation. Slip and skid: probability that it happened at any time that the signals show; a slip before about ten balls have passed is not seen. The spin of the balls is inferred from the torque alone and takes M to hold: a lubricant in another state than in the slow tests looks like skid.", table),
    figure(shareOfRun(run, runs, "Friction F of the accelerated balls"), friction.length ? `Where the balls are known to roll, of tests that come to M; elsewhere t_O − M alone is known. No friction is negative: where F is, the lubricant or the sensor was in another state than in the slow tests. ${BAND_WORDS}` : null, friction.length ? timePlot({ series: friction, label: "F [N]", include: () => [0], height: 240 }) : notInThisRun("F: " + whyNone(run, "friction_map"), run), friction.length ? frictionClosely(run, tests) : null),
    mapFigure(run, runs),
    figure(shareOfRun(run, runs, "What the spin-up dissipated"), "From the engagement until 99 % of the largest speed: where a motor brings up the last per cent, most of it is steady running. ± is twice the standard deviation. The printed form has the factor 1 + 2s where none belongs.", energies),
  ];
}

// F over speed and acceleration: one line an acceleration, where data are near.
function mapFigure(run, runs) {
  const [speeds, accelerations, friction, deviations, known] = ["speed", "acceleration", "friction", "deviation", "known"].map(tableOf(run, "friction_map"));
  const title = shareOfRun(run, runs, "F over speed and acceleration, from all tests");
  if (!speeds.length) return figure(title, null, notInThisRun("a map of F: " + whyNone(run, "friction_map"), run));
  const levels = [...new Set(accelerations)];
  const shown = [0, 0.1, 0.3, 0.6, 1].map((share) => levels[Math.round(share * (levels.length - 1))]);
  const series = shown.flatMap((level, index) => {
    const rows = speeds.map((_, row) => row).filter((row) => accelerations[row] === level && known[row] > 0);
    if (rows.length < 2) return [];
    const x = rows.map((row) => speeds[row]);
    return bandCurves(x, rows.map((row) => friction[row]), rows.map((row) => deviations[row]), 1, `${numberText(level, 3)} rad/s²`, LINE_COLOURS[index]);
  });
  return figure(title, series.length ? `Drawn where data are near. ${BAND_WORDS}` : null, series.length ? curves({ series, across: "speed [rad/s]", above: IN_RPM, upright: "F [N]", height: 260 }) : notInThisRun("places with data near", run));
}

function lossSection(runs) {
  return section("losses", "Loss, slip and energy", runs.map((run) => lossFigures(run, runs)));
}

function rotorFrictionSection(runs) {
  return section("rotor-friction", "Sliding friction between rotor and race", runs.map((run) => {
    const [slips, coefficients, deviations] = ["slip", "coefficient", "deviation"].map(tableOf(run, "rotor_friction"));
    const series = bandCurves(slips, coefficients, deviations, 1, "coefficient", SERIES_COLOURS.rotor);
    return figure(shareOfRun(run, runs, "Coefficient of friction over slip"), `Means over whole turns of the rotor, each at the mean slip of its turns. ${BAND_WORDS}`, curves({ series, across: "slip [m/s]", upright: "coefficient", height: 260 }));
  }));
}

function identifyVerdict(run) {
  const conclusion = conclusionOf(run);
  const words = typeof conclusion.value === "string" ? conclusion.value : "–";
  const probability = Math.max(0, ...shownIn(run, "explanations").map(({ value }) => value || 0));
  const tests = testsOf(run);
  const energy = (test) => (numberOf(run, `${test.key}.dissipated_energy`) === null ? "–" : `${uncertainText(run, `${test.key}.dissipated_energy`, "mJ", 1e3)} (2σ)`);
  const best = tests.map((test) => `${test.name}: ${energy(test)}`);
  const form = formOf(run);
  return element(
    "div",
    { class: "tiles" },
    stateTile(run),
    tile("Explanation", words.split(":")[0], [conclusion.why || words.split(": ")[1] || (words === "none of these" ? "the likeliest does not fit" : `probability ${chanceText(probability)}`)]),
    tile("Steady moment", typeof form.value === "string" ? FORMS[form.value] || form.value : "–", [form.why]),
    tilesOf(run),
    tile("Dissipated in the spin-ups", `${tests.length} ${tests.length === 1 ? "test" : "tests"}`, best),
  );
}

function identifyLine(run) {
  const input = inputOf(run, "bearing.name");
  return element("p", { class: "machine" }, `bearing ${input ? inputText(input.value) : "without a name"} · time 0 is the engagement of each test`);
}

register("identify", {
  line: identifyLine,
  verdict: identifyVerdict,
  time: "time since the engagement",
  facts: false,
  sections: (runs) => {
    const rubbed = runs.filter((run) => tableOf(run, "rotor_friction")("slip").length);
    return [[35, explanationSection, runs], [36, steadyMomentSection, runs], [37, testSection, runs], [38, lossSection, runs], [39, rotorFrictionSection, rubbed]].filter(([, , part]) => part.length);
  },
});
