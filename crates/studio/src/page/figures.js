// The drawings of a run's page, for the studio: the same scripts draw there and here.

function inStudio(holder, text, build) {
  const raw = JSON.parse(text);
  const run = { ...readRun(text), letter: "A", label: "", short: "", prefix: "", colour: RUN_COLOURS[0] };
  resizable.length = 0;
  holder.replaceChildren();
  fillElement(holder, {}, build(run, raw));
  redrawAll();
}

window.auxbearFigures = {
  rotor: (holder, text) => inStudio(holder, text, (run, raw) => rotorPicture(run, [], raw.name ? raw.name.split("\n") : [])),
  closedLoop: (holder, text) => inStudio(holder, text, (run) => {
    const grows = tableOf(run, "poles")("Re λ").some((value) => value > 0);
    return [
      element("p", { class: grows ? "grows" : "stable" }, grows ? `Not stable at ${speedText(ratedSpeed(run))}: a mode grows.` : `Stable at ${speedText(ratedSpeed(run))}.`),
      figure("Sensitivity at speed", "Largest |S| of one axis with all others closed; dashed: zones.", sensitivityCurves(run, "rated")),
      figure("Open loops (Bode)", "One axis opened, all others closed.", bodeCurves(run, "rated")),
    ];
  }),
  text: (value, unit) => (isNumber(value) ? engineeringText(value, unit, 4) : "–"),
};
