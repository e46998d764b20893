// Puts the page together.

function navigation(sections, zooms) {
  const links = sections.map((part) => element("a", { href: "#" + part.id }, part.querySelector("h2").textContent));
  if (!zooms) return element("nav", {}, element("div", { class: "links" }, links));
  const state = element("span", { class: "window" });
  const reset = element("button", { type: "button", onclick: () => timeline.all() }, "all time");
  const update = () => {
    const zoomed = timeline.begin > timeline.first || timeline.end < timeline.last;
    state.textContent = zoomed ? `${timeline.text(timeline.begin)} to ${timeline.text(timeline.end)}` : "drag in a time plot to zoom all";
    reset.disabled = !zoomed;
  };
  timeline.listeners.push(update);
  update();
  return element("nav", {}, element("div", { class: "links" }, links), element("div", { class: "zoom" }, state, reset));
}

function guarded(build, runs) {
  try {
    return build(runs);
  } catch (problem) {
    return section("failed-" + build.name, "A part of this report", notInThisRun("it could not be drawn (" + problem.message + ")"));
  }
}

function start() {
  const main = document.getElementById("report");
  main.textContent = "";
  const runs = readRuns();
  if (!runs.length) {
    main.append(element("h1", {}, "auxbear report"), notInThisRun("no run was given"));
    return;
  }
  timeline.span(runs);
  const compared = runs.length > 1 && !differentSystems(runs);
  const builders = [
    ...(compared && !ofOneRun(runs) ? [[differenceSection, runs]] : []),
    ...(runs.some((run) => limitsOf(run).length) ? [[limitSection, wholesOf(runs)]] : []),
    ...(runs.some((run) => measuredOf(run).size) ? [[measuredSection, wholesOf(runs).filter((run) => measuredOf(run).size)]] : []),
    ...sectionsOf(runs),
    [quantitySection, runs],
    // bearings of one machine differ as they were given: no finding of a comparison
    ...(compared && ofOneRun(runs) ? [[differenceSection, runs]] : []),
    [inputSection, runs],
    ...[runs.filter((run) => systemOf(run).facts)].filter((some) => some.length).map((some) => [factSection, some]),
  ];
  const sections = builders.map(([build, some]) => guarded(build, some));
  main.append(guarded(header, runs), navigation(sections, runs.some((run) => systemOf(run).time)), ...sections);
  redrawAll();
  let waiting = false;
  window.addEventListener("resize", () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      redrawAll();
    });
  });
  // Paper has its own width: the pictures are drawn for it, not shrunk to it.
  const forPaper = (paper) => () => {
    document.documentElement.classList.toggle("paper", paper);
    redrawAll();
  };
  window.addEventListener("beforeprint", forPaper(true));
  window.addEventListener("afterprint", forPaper(false));
}

start();
