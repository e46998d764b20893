// The pictures of a measurement: what was read beside what it means, each with the band that holds it in 95 % of cases.

const BAND = 2;
const BAND_WORDS = "Pale lines: twice the standard deviation to both sides.";

// A line and its band from a column and that of its deviation; nothing where the band is wider than `look.widest`.
function bandLines(runs, name, deviation, scale, look) {
  return runs.flatMap((run) => {
    const whole = scaledColumn(run, name, scale);
    if (!whole) return [];
    const colour = runs.length > 1 ? run.colour : look.colour;
    const spread = scaledColumn(run, deviation, scale * BAND);
    const values = look.widest ? whole.map((value, row) => (spread && spread[row] <= look.widest ? value : null)) : whole;
    const moved = (sign) => values.map((value, row) => (isNumber(value) && isNumber(spread[row]) ? value + sign * spread[row] : null));
    const pale = { colour: colour + "80", width: 0.75, time: run.time, gaps: true };
    const band = spread ? [{ ...pale, label: run.prefix + "+2σ", values: moved(1) }, { ...pale, label: run.prefix + "−2σ", values: moved(-1) }] : [];
    return [{ ...look, label: run.prefix + look.label, time: run.time, values, colour, gaps: true }, ...band];
  });
}

// What a run has no numbers for, with the reason of one of its quantities.
function lackOf(runs, column, figure) {
  return runs.filter((run) => !columnOf(run, column)).flatMap((run) => shownIn(run, figure).map(({ words, quantity }) => notInThisRun(`${words}: ${quantity.why || "no reason is given"}`, run)));
}

function signalFigure(title, note, series, options, lack) {
  return figure(title, series.length ? note : null, series.length ? timePlot({ series, ...options }) : null, lack);
}

// The quick change seen closely: speed and acceleration from before the engagement to behind its end.
function changeFigure(run, runs) {
  const [begin, end] = shownIn(run, "change").map(({ value }) => value);
  if (!isNumber(begin) || !isNumber(end) || !columnOf(run, "shaft.acceleration")) return null;
  const rows = run.time.map((_, row) => row).filter((row) => run.time[row] >= begin - 0.4 * (end - begin) && run.time[row] <= end + 0.6 * (end - begin));
  const x = rows.map((row) => 1e3 * run.time[row]);
  const of = (name, spread, sign) => rows.map((row) => {
    const [value, deviation] = [columnOf(run, name)[row], spread ? (columnOf(run, spread) || [])[row] : 0];
    return isNumber(value) && isNumber(deviation) ? value + sign * BAND * deviation : null;
  });
  const three = (name, label, colour) => [
    { label, x, y: of(name, null, 0), colour },
    { x, y: of(name, `${name}_deviation`, 1), colour: colour + "90", width: 0.75 },
    { x, y: of(name, `${name}_deviation`, -1), colour: colour + "90", width: 0.75 },
  ];
  const raw = { label: columnOf(run, "shaft.reading") ? "as shown" : "between two pulses", x, y: rows.map((row) => (columnOf(run, "shaft.pulse_speed") || columnOf(run, "shaft.reading") || [])[row]), colour: SERIES_COLOURS.quiet, width: 1 };
  const across = "time [ms]";
  return figure(
    shareOfRun(run, runs, "The quick change, closely"),
    `${columnOf(run, "shaft.reading") ? "Grey: the instrument" : `${shownIn(run, "pulses").map(({ value }) => numberText(value, 4)).join("")} pulses came in it`}. ${BAND_WORDS}`,
    curves({ series: [raw, ...three("shaft.speed", "speed", SERIES_COLOURS.rotor)], across, upright: "speed [rad/s]", right: IN_RPM, height: 260 }),
    curves({ series: three("shaft.acceleration", "acceleration", SERIES_COLOURS.race), across, upright: "acceleration [rad/s²]", height: 260 }),
  );
}

function shaftSection(runs) {
  const grey = runs.some((run) => columnOf(run, "shaft.reading")) ? "what the instrument shows" : "pitch over time between two pulses, as raw as pulses are";
  const quiet = { colour: SERIES_COLOURS.quiet, width: 1 };
  const raw = [
    ...lines(runs, "shaft.pulse_speed", 1, { label: "between two pulses [rad/s]", ...quiet }),
    ...lines(runs, "shaft.reading", 1, { label: "as shown [rad/s]", ...quiet }),
  ];
  const speed = bandLines(runs, "shaft.speed", "shaft.speed_deviation", 1, { label: "speed [rad/s]", colour: SERIES_COLOURS.rotor, width: 1.5 });
  const acceleration = bandLines(runs, "shaft.acceleration", "shaft.acceleration_deviation", 1, { label: "acceleration [rad/s²]", colour: SERIES_COLOURS.race, width: 1.5 });
  const marks = instantMarks(instantsOf(runs));
  return section(
    "shaft",
    "Speed and acceleration of the shaft",
    signalFigure("Speed", `Grey: ${grey}. ${BAND_WORDS}`, [...(raw.length && speed.length ? raw : []), ...speed], { label: "speed [rad/s]", second: IN_RPM, marks, height: 290 }, lackOf(runs, "shaft.speed", "shaft_speed")),
    signalFigure("Acceleration", `Drag over the change to see it closely. ${BAND_WORDS}`, acceleration, { label: "acceleration [rad/s²]", marks, height: 260 }, []),
    runs.map((run) => changeFigure(run, runs)),
  );
}

// Unit in which torques of this size are read, and how many of it are 1 N m.
function torqueUnit(runs) {
  const sizes = runs.flatMap((run) => ["torque.reading", "torque.torque"].flatMap((name) => columnOf(run, name) || [])).filter(isNumber).map(Math.abs);
  return sizes.reduce((most, size) => Math.max(most, size), 0) < 10 ? ["N mm", 1e3] : ["N m", 1];
}

function measuredTorqueSection(runs) {
  const [unit, scale] = torqueUnit(runs);
  const raw = lines(runs, "torque.reading", scale, { label: `reading [${unit}]`, colour: SERIES_COLOURS.quiet, width: 1 });
  const torque = bandLines(runs, "torque.torque", "torque.deviation", scale, { label: `torque [${unit}]`, colour: SERIES_COLOURS.race, width: 1.5 });
  const disturbance = bandLines(runs, "torque.disturbance", "torque.disturbance_deviation", scale, { label: `amplitude [${unit}]`, colour: SERIES_COLOURS.rotor, width: 1.25 });
  return section(
    "measured-torque",
    "Torque",
    signalFigure(
      "The sensor's reading, and the torque that it felt",
      `Grey: the reading with the sensor's swing, its zero and the disturbance once a turn. Coloured: the torque without them. ${BAND_WORDS}`,
      [...raw, ...torque],
      { label: `torque [${unit}]`, marks: instantMarks(instantsOf(runs)), height: 310 },
      lackOf(runs, "torque.torque", "sensor_torque"),
    ),
    disturbance.length ? signalFigure("Disturbance once a turn, before the sensor amplifies it", BAND_WORDS, disturbance, { label: `amplitude [${unit}]`, include: () => [0], height: 190 }, []) : null,
    runs.map((run) => torqueSpectrum(run, runs)),
    runs.map((run) => designFigure(run, runs)),
  );
}

// Natural frequency of the torque sensor, Hz; null where it is not known.
function sensorFrequency(run) {
  const [sensor] = shownIn(run, "sensor");
  return sensor ? sensor.value : null;
}

// By which a torque arm is chosen: its error in this test over the frequency that it might have had.
function designFigure(run, runs) {
  const [frequencies, ...errors] = shownIn(run, "sensor_design").map(({ words, quantity }) => ({ words, values: list(quantity.value).filter(isNumber) }));
  if (!frequencies || !frequencies.values.length) return null;
  const own = sensorFrequency(run);
  const top = 1e3 * Math.max(...errors[0].values);
  const looks = [{ colour: SERIES_COLOURS.quiet }, { colour: SERIES_COLOURS.race }];
  const series = [
    ...errors.map(({ words, values }, index) => ({ label: words, x: frequencies.values, y: values.map((value) => 1e3 * value), ...looks[index], dots: true })),
    ...(own === null ? [] : [{ label: `this sensor, ${numberText(own, 4)} Hz`, x: [own, own], y: [0, top], colour: SERIES_COLOURS.cage, dash: "2 3" }]),
  ];
  return figure(shareOfRun(run, runs, "Which frequency a torque sensor should have"), "Root mean square error after the engagement for the torque found here, with the decay, noise and disturbance of this sensor. A stiff arm swings less and reads less: its noise in N mm is that of this one.", curves({ series, across: "frequency of the sensor [Hz]", upright: "error [N mm]", logarithmic: false, height: 260 }));
}

// Amplitudes over frequency; where the sensor swings and where the shaft's orders lie at its largest speed is marked.
function torqueSpectrum(run, runs) {
  const [across, upwards] = shownIn(run, "spectrum").map(({ quantity }) => quantity);
  const frequencies = list(across && across.value).filter(isNumber);
  const [unit, scale] = torqueUnit([run]);
  const amplitudes = list(upwards && upwards.value).filter(isNumber).map((value) => scale * value);
  const title = shareOfRun(run, runs, "Spectrum of the reading");
  if (!frequencies.length) return figure(title, null, null, [notInThisRun((across && across.why) || "no reason is given", run)]);
  const top = Math.max(...amplitudes);
  const bottom = Math.min(...amplitudes.filter((value) => value > 0));
  const upright = (at, label, colour, dash) => ({ label, x: [at, at], y: [bottom, top], colour, dash, width: 1.25 });
  const sensor = sensorFrequency(run);
  const [{ value: turn }] = [...shownIn(run, "shaft_speed"), { value: null }];
  const last = frequencies[frequencies.length - 1];
  const orders = turn === null ? [] : [1, 2, 3].map((order) => [order, (order * turn) / (2 * Math.PI)]).filter(([, at]) => at < last);
  const series = [
    { label: "reading", x: frequencies, y: amplitudes, colour: SERIES_COLOURS.rotor, width: 1.25 },
    ...(sensor === null ? [] : [upright(sensor, `sensor, ${numberText(sensor, 4)} Hz`, SERIES_COLOURS.race, "7 4")]),
    ...orders.map(([order, at]) => upright(at, `order ${order} at the largest speed, ${numberText(at, 4)} Hz`, SERIES_COLOURS.cage, "2 3")),
  ];
  return figure(title, "Amplitude of a sine, peak; overlapping Hann segments over the whole record. A speed that changes smears its orders.", curves({ series, across: "frequency [Hz]", upright: `amplitude [${unit}]`, logarithmic: true, height: 280 }));
}

// A band beyond which a slip says nothing, %.
const WIDEST_SLIP = 10;

function cageSection(runs) {
  const speed = bandLines(runs, "cage.speed", "cage.speed_deviation", 1, { label: "cage [rad/s]", colour: SERIES_COLOURS.cage, width: 1.5 });
  const slip = bandLines(runs, "cage.slip", "cage.slip_deviation", 100, { label: "slip [%]", colour: SERIES_COLOURS.cage, width: 1.5, widest: WIDEST_SLIP });
  return section(
    "cage",
    "Cage",
    signalFigure("Speed of the cage", BAND_WORDS, speed, { label: "speed [rad/s]", second: IN_RPM, marks: instantMarks(instantsOf(runs)), height: 230 }, lackOf(runs, "cage.speed", "cage_speed")),
    slip.length ? signalFigure("Slip of the cage", `0 % where the balls roll, 100 % where the cage rests; nothing is drawn where the band is wider than ±${WIDEST_SLIP} %. ${BAND_WORDS}`, slip, { label: "slip [%]", include: () => [-0.5, 0.5], height: 230 }, []) : null,
  );
}

// A list of a quantity with its gaps.
function wholeList(run, name, scale = 1) {
  return list(quantityOf(run, name).value).map((value) => (isNumber(value) ? scale * value : null));
}

// Levels, column after column, as a picture: time to the right, frequency or order upwards, colour for dB.
function levelPicture(run, runs, name, upright, words, title, note) {
  const [times, rungs, levels] = [wholeList(run, `${name}_times`), wholeList(run, `${name}_${upright}`), wholeList(run, `${name}_levels`)];
  if (!levels.length) return figure(shareOfRun(run, runs, title), null, null, [notInThisRun(quantityOf(run, `${name}_levels`).why || "no reason is given", run)]);
  const floor = -60;
  const sheet = element("canvas", { width: times.length, height: rungs.length });
  const pen = sheet.getContext("2d");
  const image = pen.createImageData(times.length, rungs.length);
  levels.forEach((level, index) => {
    const [column, row] = [Math.floor(index / rungs.length), index % rungs.length];
    const colour = mapColour(Math.max(0, 1 - (level === null ? floor : level) / floor));
    const at = 4 * ((rungs.length - 1 - row) * times.length + column);
    for (let part = 0; part < 3; part++) image.data[at + part] = colour[part];
    image.data[at + 3] = 255;
  });
  pen.putImageData(image, 0, 0);
  const holder = element("div", { class: "curves" });
  resizable.push(() => holder.replaceChildren(levelDrawing(sheet, times, rungs, words, holder.clientWidth || 900)));
  return figure(shareOfRun(run, runs, title), `${note} Darkest: the largest amplitude; palest: ${-floor} dB below it and less.`, holder);
}

// The picture of levels with its axes, in the letters and margins of all other plots.
function levelDrawing(sheet, times, rungs, words, width) {
  const [height, box] = [300, CURVE_BOX];
  const half = (values) => (values.length > 1 ? 0.5 * (values[1] - values[0]) : 0.5);
  const ends = (values) => [values[0] - half(values), values[values.length - 1] + half(values)];
  const [[left, right], [low, high]] = [ends(times), ends(rungs)];
  const [wide, tall] = [width - box.left - box.right, height - box.top - box.bottom];
  const toX = (x) => box.left + ((x - left) / (right - left)) * wide;
  const toY = (y) => box.top + tall - ((y - low) / (high - low)) * tall;
  const ticks = [
    ...axisSteps(left, right, Math.max(3, Math.floor(wide / 75))).map((x) => axisText(toX(x), height - box.bottom + 16, "middle", numberText(x, 6))),
    ...axisSteps(Math.max(low, 0), high).map((y) => axisText(box.left - 8, toY(y) + 4, "end", numberText(y, 6))),
    axisText(box.left + wide / 2, height - 6, "middle", "time [s]"),
    axisText(14, box.top + tall / 2, "middle", words, { transform: `rotate(-90 14 ${box.top + tall / 2})` }),
  ];
  const picture = drawing("image", { x: box.left, y: box.top, width: wide, height: tall, href: sheet.toDataURL(), preserveAspectRatio: "none" });
  return drawing("svg", { class: "curves", width, height, viewBox: `0 0 ${width} ${height}`, role: "img" }, picture, ticks);
}

const ORDER_COLOURS = ["#1f5fa8", "#b5541c", "#3b7d3b", "#7a4aa0", "#a33a3a", "#287d86", "#8a6d1f", "#555f68"];

function vibrationSection(runs) {
  return section("vibration", "Vibration", runs.map((run) => {
    const names = [...run.columns.keys()].filter((name) => /^vibration\.order_.*_amplitude$/.test(name));
    const series = names.flatMap((name, index) => bandLines([run], name, name.replace(/amplitude$/, "deviation"), 1, { label: `order ${name.slice(16, -10).replace("_", ".")}`, colour: ORDER_COLOURS[index % ORDER_COLOURS.length], width: 1.5 }));
    const [orders, amplitudes] = shownIn(run, "orders").map(({ quantity }) => quantity);
    const unit = amplitudes && amplitudes.unit;
    return [
      signalFigure(shareOfRun(run, runs, "Orders over time"), `Amplitude, peak. ${BAND_WORDS}`, series, { label: unit && unit !== "1" ? `amplitude [${unit}]` : "amplitude, in the unit of the file", include: () => [0], height: 270 }, series.length ? [] : [notInThisRun((orders && orders.why) || "no reason is given", run)]),
      levelPicture(run, runs, "vibration_spectrogram", "frequencies", "frequency [Hz]", "Spectrogram over time", "What follows the speed bends with it; what stands still is the machine's own."),
      levelPicture(run, runs, "vibration_order_spectrogram", "orders", "order", "Spectrogram over order", "What follows the speed stands still here."),
    ];
  }));
}

function steadySection(runs) {
  return section("steady", "Torque over speed", runs.map((run) => {
    const [speeds] = shownIn(run, "slow_speeds").map(({ quantity }) => quantity);
    const x = list(speeds && speeds.value);
    const curve = ({ name, words: label, quantity }, index) => {
      const colour = [SERIES_COLOURS.race, SERIES_COLOURS.rotor, SERIES_COLOURS.cage, SERIES_COLOURS.quiet][index];
      const torque = list(quantity.value);
      return torque.length ? bandCurves(x, torque, wholeList(run, name.replace(/torques$/, "deviations")), 1e3, label, colour) : [];
    };
    const series = shownIn(run, "steady_torques").flatMap(curve);
    const row = ({ name, words, quantity }) => {
      const [deviation, chance] = ["_deviation", "_chance"].map((end) => numberOf(run, name + end));
      return isNumber(quantity.value)
        ? [words, `${bandNumbers(1e3 * quantity.value, 1e3 * BAND * deviation)} N mm (2σ)`, numberText(chance, 2)]
        : [words, element("span", { class: "absent" }, quantity.why || "–"), ""];
    };
    const [{ name, value: inertia }] = [...shownIn(run, "slow_inertia"), { name: "", value: null }];
    const spread = BAND * numberOf(run, `${name}_deviation`);
    const note = inertia === null ? "" : spread > 0 ? `I = ${bandNumbers(inertia, spread)} kg m² (2σ). ` : `I = ${numberText(inertia, 4)} kg m², taken as exact. `;
    return [
      figure(shareOfRun(run, runs, "Torque over speed in slow running"), `${note}${BAND_WORDS}`, series.length ? curves({ series, across: "speed [rad/s]", above: IN_RPM, upright: "torque [N mm]", height: 320 }) : null, series.length ? null : [notInThisRun((speeds && speeds.why) || "no reason is given", run)]),
      figure(shareOfRun(run, runs, "One curve against another"), "Chance: how often equal curves would differ as much.", plainTable(["difference", "mean over the speeds", "chance"], shownIn(run, "differences").map(row))),
    ];
  }));
}

// What was read, what was repaired, and what is not to be trusted.
function trustSection(runs) {
  return section("trust", "What was read, repaired, and not trusted", runs.map((run) => {
    const quantity = (shownIn(run, "channels")[0] || {}).quantity || {};
    const channels = String(quantity.value || "").split("; ").filter(Boolean).map((entry) => {
      const parts = /^(.*) \((.*), (\d+) values, (.*)\)$/.exec(entry);
      return parts ? parts.slice(1) : [entry, "", "", ""];
    });
    const counts = shownIn(run, "repairs").map((entry) => [entry.words, cellOf(entry)]);
    const notes = list(run.summary.warnings).filter(Boolean).map((warning) => element("li", {}, element("code", {}, warning.code), " ", warning.text));
    return [
      figure(shareOfRun(run, runs, "Channels of the file"), null, plainTable(["channel", "unit", "values", "clock"], channels)),
      figure(shareOfRun(run, runs, "Repairs"), null, plainTable(["what", "how much"], counts)),
      figure(shareOfRun(run, runs, "What to know before trusting the numbers"), null, notes.length ? element("ul", {}, notes) : element("p", {}, "Nothing was found wrong.")),
    ];
  }));
}

// The sections of measurements; what no run asked for has no section.
function signalsVerdict(run) {
  return element("div", { class: "tiles" }, stateTile(run), tilesOf(run));
}

function signalsLine(run) {
  const file = inputOf(run, "signals.file");
  return file ? element("p", { class: "machine" }, "measurement: " + String(file.value).split(/[\\/]/).pop()) : null;
}

register("signals", {
  line: signalsLine,
  verdict: signalsVerdict,
  time: "time on the clock of the file",
  facts: false,
  sections: (runs) => {
    const given = (path) => runs.filter((run) => String((inputOf(run, path) || { value: "not given" }).value) !== "not given");
    const asked = (section) => given(`signals.${section}.channel`);
    return [
      [30, shaftSection, asked("speed")],
      [31, measuredTorqueSection, asked("torque")],
      [32, cageSection, asked("cage")],
      [33, vibrationSection, asked("vibration")],
      [34, steadySection, given("signals.steady.from")],
      [34.5, trustSection, runs],
    ].filter(([, , part]) => part.length);
  },
});
