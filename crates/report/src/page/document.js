// The drawing of the rotor in a document.

function drawRotor() {
  const runs = readRuns();
  for (const holder of document.querySelectorAll(".rotor-drawing")) {
    if (runs.length) holder.append(...rotorPicture(runs[0], [], runs.map((run) => run.summary.name || "")));
  }
  const forPaper = (paper) => () => {
    document.documentElement.classList.toggle("paper", paper);
    redrawAll();
  };
  window.addEventListener("beforeprint", forPaper(true));
  window.addEventListener("afterprint", forPaper(false));
  redrawAll();
}

drawRotor();
