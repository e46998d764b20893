// The pictures of a test on a rig: what happened, beside what its arm indicated.

function rigSpeedSection(runs) {
  const names = ["bearing.inner_race.speed"];
  const speeds = [
    ...lines(runs, "flywheel.speed", 1, { label: "flywheel [rad/s]", colour: SERIES_COLOURS.quiet, width: 1, dash: [7, 4] }),
    ...lines(runs, names[0], 1, { label: "shaft [rad/s]", colour: SERIES_COLOURS.rotor, width: 1.5 }),
    ...lines(runs, "bearing.cage.speed", 1, { label: "cage [rad/s]", colour: SERIES_COLOURS.cage, width: 1.25 }),
  ];
  const marks = instantMarks(instantsOf(runs));
  return section(
    "rig-speed",
    "Speed and acceleration",
    history("Speed", "The clutch slips until flywheel and shaft turn at the same speed, then both are one body.", runs, names, speeds, { label: "speed [rad/s]", second: IN_RPM, marks, height: 270 }),
    history("Acceleration of the shaft", "It grows with the torque of the engaging clutch and ends where the clutch locks.", runs, ["shaft.acceleration"], lines(runs, "shaft.acceleration", 1, { label: "acceleration [rad/s²]", colour: SERIES_COLOURS.race, width: 1.25 }), { label: "acceleration [rad/s²]", marks, height: 230 }),
  );
}

function rigTorqueSection(runs) {
  const milli = 1e3;
  const marks = instantMarks(instantsOf(runs));
  const names = ["bearing.outer_race.moment"];
  return section(
    "rig-torque",
    "Moments on the bearing",
    history(
      "Moment on the outer race t_O, what the arm indicates of it, and the friction moment M",
      "Grey: the arm swings and feels lateral vibration once a turn; its gauges, the converter and their noise come on top in the raw file. Dashed: the law at this speed and load, with the state of the lubricant where it has one.",
      runs,
      names,
      [
        ...lines(runs, "arm.reading", milli, { label: "arm [N mm]", colour: SERIES_COLOURS.quiet, width: 1 }),
        ...lines(runs, "bearing.inner_race.resisting_moment", milli, { label: "t_I inner race [N mm]", colour: SERIES_COLOURS.race, width: 1, dash: [2, 3] }),
        ...lines(runs, names[0], milli, { label: "t_O outer race [N mm]", colour: SERIES_COLOURS.rotor, width: 1.5 }),
        ...lines(runs, "bearing.steady_moment", milli, { label: "friction moment M of the law [N mm]", colour: SERIES_COLOURS.limit, width: 1.5, dash: [7, 4] }),
      ],
      { label: "moment [N mm]", marks, height: 320 },
    ),
    history("Torque of the clutch", "Dashed: what it can carry.", runs, ["clutch.torque"], [
      ...lines(runs, "clutch.torque", 1, { label: "torque [N m]", colour: SERIES_COLOURS.rotor, width: 1.25 }),
      ...lines(runs, "clutch.capacity", 1, { label: "it can carry [N m]", colour: SERIES_COLOURS.quiet, width: 1, dash: [7, 4] }),
    ], { label: "torque [N m]", marks, height: 190 }),
  );
}

function rigWarmthSection(runs) {
  return section(
    "rig-warmth",
    "Temperature and grease",
    history("Rise of the outer race's temperature", "The thermocouple lags.", runs, ["bearing.temperature_rise"], [
      ...lines(runs, "bearing.temperature_rise", 1, { label: "outer race [K]", colour: SERIES_COLOURS.race, width: 1.25 }),
      ...lines(runs, "thermocouple.temperature_rise", 1, { label: "thermocouple [K]", colour: SERIES_COLOURS.quiet, width: 1.25, dash: [7, 4] }),
    ], { label: "rise [K]", height: 190 }),
    lubricantFigure(runs),
  );
}

// The state of a lubricant that changes, where there is one.
function lubricantFigure(runs) {
  const series = [
    ...lines(runs, "bearing.lubricant.drag_factor", 1, { label: "drag, over that of the law", colour: SERIES_COLOURS.rotor, width: 1.5 }),
    ...lines(runs, "bearing.lubricant.traction_factor", 1, { label: "traction, over that of the law", colour: SERIES_COLOURS.race, width: 1.25, dash: [7, 4] }),
  ];
  return series.length ? figure("State of the lubricant", "Factors on the speed-dependent part of the friction moment and on traction: grease builds up and breaks down, films warm.", timePlot({ series, label: "factor", height: 190 })) : null;
}

function rigVerdict(run) {
  return element("div", { class: "tiles" }, stateTile(run), tilesOf(run));
}

function rigLine(run) {
  const given = (path) => {
    const input = inputOf(run, path);
    return input && String(input.value) !== "not given" ? inputText(input.value).replace("^2", "²") : null;
  };
  const facts = [
    given("bearing.name") || "bearing without a name",
    `${given("rig.program")} at ${given("rig.speed")}`,
    `dead weight ${given("rig.load.radial_load")}`,
    given("bearing.fidelity") && `${given("bearing.fidelity")} fidelity`,
    `arm ${given("rig.arm.natural_frequency")}`,
    "raw file and signals.toml beside this page",
  ];
  return element("p", { class: "machine" }, facts.filter(Boolean).join(" · "));
}

register("rig", {
  line: rigLine,
  verdict: rigVerdict,
  time: "time since the start",
  facts: true,
  sections: (runs) => [[39.5, engagementSection, runs.filter(closeWindow)], [40, rigSpeedSection, runs], [41, rigTorqueSection, runs], [42, rigWarmthSection, runs], [60, mapSection, runs], [61, pressureSection, runs], [80, energySection, runs], ...LIMIT_SECTIONS(runs), ...WARM_SECTIONS(runs)].filter(([, , part]) => part.length),
});
