// The few milliseconds that matter in a record of many: the first contacts of a drop, the engagement of a test. Paper has no mouse to zoom.

// Begin and end of the close-up of a run, s, or null.
function closeWindow(run) {
  const window = run.closely[run.summary.name || ""] || run.closely[""];
  return Array.isArray(window) && run.time ? window : null;
}

// One window for the runs of a comparison: from the first begin to the last end.
function closeSpan(runs) {
  const windows = runs.map(closeWindow).filter(Boolean);
  return windows.length ? [Math.min(...windows.map(([begin]) => begin)), Math.max(...windows.map(([, end]) => end))] : null;
}

// One line for each run that has the column, cut to the window; time in ms.
function closeLines(runs, [begin, end], name, scale, look) {
  return lines(runs, name, scale, look).map((line) => {
    const rows = line.time.map((_, row) => row).filter((row) => line.time[row] >= begin && line.time[row] <= end);
    return { ...line, dash: Array.isArray(line.dash) ? line.dash.join(" ") : line.dash, x: rows.map((row) => 1e3 * line.time[row]), y: rows.map((row) => line.values[row]) };
  });
}

// The line of the contact force through the begin, the peak and the end of each contact, which are known from dense output: rows lie as far apart
// as run.output_interval, and a contact between two of them shows in none.
function throughPeaks(line, [begin, end]) {
  const known = line.run.contacts.flatMap((contact) => [[contact.start_s, 0], [contact.peak_time_s, contact.peak_force_N], [contact.end_s, 0]]);
  const inside = known.filter(([time, force]) => isNumber(time) && isNumber(force) && time >= begin && time <= end).map(([time, force]) => [1e3 * time, force]);
  const points = [...line.x.map((time, row) => [time, line.y[row]]), ...inside].sort(([one], [other]) => one - other);
  return { ...line, x: points.map(([time]) => time), y: points.map(([, force]) => force) };
}

// Axes of a close-up and the instants inside it.
function closeAxes(upright, marks, height) {
  return { across: `${timeline.words} [ms]`, upright, marks: marks.filter(({ at }) => isNumber(at)).map((mark) => ({ ...mark, at: 1e3 * mark.at })), height };
}

function firstContactsSection(runs) {
  const shown = runs.filter(closeWindow);
  const span = closeSpan(shown);
  if (!span) return section("first-contacts", "First contacts in detail", runs.map((run) => notInThisRun(run.contacts.length ? "it has no time history" : "rotor and race never touched", run)));
  const several = runs.length > 1;
  const look = (label, part, dash) => ({ label, colour: SERIES_COLOURS[part], width: 1.5, dash: several ? dash : undefined });
  const inside = (run) => run.contacts.filter((contact) => isNumber(contact.peak_force_N) && contact.peak_time_s >= span[0] && contact.peak_time_s <= span[1]);
  const peaks = shown.map((run) => ({ x: inside(run).map((contact) => 1e3 * contact.peak_time_s), y: inside(run).map((contact) => contact.peak_force_N), colour: several ? run.colour : SERIES_COLOURS.rotor, fill: "#fff", radius: 3, dots: true, line: false }));
  const starts = several ? [] : shown[0].contacts.map((contact, index) => ({ at: contact.start_s, words: index ? String(index + 1) : "contact 1", colour: PALE_INK }));
  const force = [
    ...closeLines(shown, span, "bearing.contact.force", 1, look("normal force [N]", "rotor")).map((line) => throughPeaks(line, span)),
    ...closeLines(shown, span, "bearing.contact.friction_force", 1, look("friction force [N]", "race", [4, 3])),
    ...peaks,
  ];
  const speeds = [
    ...closeLines(shown, span, "bearing.inner_race.speed", RPM, look("inner race [rpm]", "race")),
    ...closeLines(shown, span, "bearing.cage.speed", RPM, look(`${cageWord(shown)} [rpm]`, "cage", [9, 3])),
  ];
  const pressure = [
    ...closeLines(shown, span, "bearing.inner_pressure", 1e-6, look("inner race [MPa]", "race")),
    ...closeLines(shown, span, "bearing.outer_pressure", 1e-6, look("outer race [MPa]", "rotor", [4, 3])),
  ];
  const upto = `${engineeringText(span[0], "s", 3)} to ${engineeringText(span[1], "s", 3)} of ${engineeringText(timeline.last - timeline.first, "s", 4)}`;
  return section(
    "first-contacts",
    "First contacts in detail",
    figure("Contact force", `${upto}. Circles: the peak of each contact, from dense output.${several ? "" : " Upright lines: contacts begin."}`, curves({ series: force, ...closeAxes("force [N]", starts, 270) })),
    figure("Speeds of race and cage", null, curves({ series: speeds, ...closeAxes("speed [rpm]", starts, 200), right: IN_RADIANS })),
    pressure.length ? figure("Largest Hertz pressure of all balls", null, curves({ series: pressure, ...closeAxes("pressure [MPa]", starts, 200) })) : null,
  );
}

function engagementSection(runs) {
  const shown = runs.filter(closeWindow);
  const span = closeSpan(shown);
  if (!span) return section("engagement", "The engagement, closely", runs.map((run) => notInThisRun("nothing engages in it", run)));
  const look = (label, part, width = 1.5, dash = undefined) => ({ label, colour: SERIES_COLOURS[part], width, dash });
  const marks = instantsOf(shown, PALE_INK).map((mark) => ({ ...mark, at: mark.instant }));
  const draw = (title, note, upright, height, more, series) => (series.length ? figure(title, note, curves({ series, ...closeAxes(upright, marks, height), ...more })) : null);
  const of = (name, scale, ...rest) => closeLines(shown, span, name, scale, look(...rest));
  return section(
    "engagement",
    "The engagement, closely",
    draw("Speed", `${engineeringText(span[0], "s", 4)} to ${engineeringText(span[1], "s", 4)} of ${engineeringText(timeline.last - timeline.first, "s", 4)}.`, "speed [rad/s]", 230, { right: IN_RPM }, [
      ...of("flywheel.speed", 1, "flywheel [rad/s]", "quiet", 1, [7, 4]),
      ...of("bearing.inner_race.speed", 1, "shaft [rad/s]", "rotor"),
      ...of("bearing.cage.speed", 1, "cage [rad/s]", "cage"),
    ]),
    draw("Acceleration of the shaft", null, "acceleration [rad/s²]", 200, {}, of("shaft.acceleration", 1, "acceleration [rad/s²]", "race")),
    draw("Moments on the bearing", null, "moment [N mm]", 260, {}, [
      ...of("arm.reading", 1e3, "arm [N mm]", "quiet", 1),
      ...of("bearing.inner_race.resisting_moment", 1e3, "t_I inner race [N mm]", "race", 1.25, [2, 3]),
      ...of("bearing.outer_race.moment", 1e3, "t_O outer race [N mm]", "rotor"),
      ...of("bearing.steady_moment", 1e3, "friction moment M of the law [N mm]", "limit", 1.5, [7, 4]),
    ]),
  );
}
