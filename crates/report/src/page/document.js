// The drawing of the rotor in a document.

function drawRotor() {
  const [run] = readRuns();
  for (const holder of document.querySelectorAll(".rotor-drawing")) {
    if (run) holder.append(...rotorPicture(run, []));
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
