// Every member as a line over all inputs and results; a range drawn on an axis keeps the members inside it.

(() => {
  "use strict";
  const holder = document.getElementById("parallel");
  const { members, axes, command } = JSON.parse(holder.querySelector("script[type='application/json']").textContent);
  const [INK, RULE, LINE, PALE, MARK] = ["#1c2733", "#8995a0", "31, 95, 168", "120, 130, 140", "#b3261e"];
  const BOX = { left: 70, right: 70, top: 58, bottom: 30 };
  const HEIGHT = 380;
  const REACH = 14; // of an axis to the pointer, in pixels
  const canvas = holder.querySelector("canvas");
  const told = holder.querySelector("output");
  const clear = holder.querySelector("button");
  const pen = canvas.getContext("2d");
  const ranges = axes.map(() => null);
  let width = 0;
  let picked = -1; // place of the member that was clicked
  let drawn = null; // axis and shares of the range that is being drawn

  const toX = (axis) => BOX.left + (axes.length > 1 ? (axis / (axes.length - 1)) * (width - BOX.left - BOX.right) : 0);
  const high = HEIGHT - BOX.top - BOX.bottom;
  const shareOf = (axis, value) => {
    const [low, top] = axes[axis].range;
    return top > low ? (value - low) / (top - low) : 0.5;
  };
  const toY = (share) => BOX.top + (1 - share) * high;
  const number = (value) => (value === 0 ? "0" : Math.abs(value) >= 1e5 || Math.abs(value) < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(4))));
  const textOf = (axis, value) => (value === null ? "none" : axes[axis].texts ? axes[axis].texts[value] : number(value));
  const inside = (place) =>
    ranges.every((range, axis) => {
      if (!range) return true;
      const value = axes[axis].values[place];
      return value !== null && shareOf(axis, value) >= range[0] && shareOf(axis, value) <= range[1];
    });

  function path(place) {
    pen.beginPath();
    let open = false;
    axes.forEach((axis, k) => {
      const value = axis.values[place];
      if (value === null) open = false;
      else if (open) pen.lineTo(toX(k), toY(shareOf(k, value)));
      else pen.moveTo(toX(k), toY(shareOf(k, value)));
      open = value !== null;
    });
    pen.stroke();
  }

  function axisOf(axis, k) {
    const x = toX(k);
    pen.strokeStyle = RULE;
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(x, BOX.top);
    pen.lineTo(x, BOX.top + high);
    pen.stroke();
    pen.fillStyle = INK;
    pen.textAlign = k === 0 ? "left" : k === axes.length - 1 ? "right" : "center";
    const at = k === 0 ? 4 : k === axes.length - 1 ? width - 4 : x;
    // neighbouring names stand at two heights
    axis.label.split("\n").forEach((line, row) => pen.fillText(line, at, (k % 2 ? 12 : 30) + 13 * row - (k % 2 ? 0 : 2), 1.9 * (toX(1) - toX(0) || width)));
    pen.textAlign = "left";
    const steps = axis.texts ? axis.texts.map((_, value) => value) : [0, 0.25, 0.5, 0.75, 1].map((share) => axis.range[0] + share * (axis.range[1] - axis.range[0]));
    for (const value of steps) {
      const y = toY(shareOf(k, value));
      pen.fillRect(x - 3, y, 6, 1);
      const words = textOf(k, value);
      const room = pen.measureText(words).width;
      pen.fillStyle = "rgba(255, 255, 255, 0.8)";
      pen.fillRect(x + 5, y - 8, room + 4, 14);
      pen.fillStyle = INK;
      pen.fillText(words, x + 7, y + 4);
    }
    const range = drawn && drawn.axis === k ? drawn.range : ranges[k];
    if (range) {
      pen.fillStyle = "rgba(179, 38, 30, 0.18)";
      pen.strokeStyle = MARK;
      pen.fillRect(x - 9, toY(range[1]), 18, (range[1] - range[0]) * high);
      pen.strokeRect(x - 9, toY(range[1]), 18, (range[1] - range[0]) * high);
    }
  }

  function draw() {
    const style = getComputedStyle(holder);
    const room = holder.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
    width = Math.max(room, 110 * axes.length);
    const sharp = window.devicePixelRatio || 1;
    canvas.width = width * sharp;
    canvas.height = HEIGHT * sharp;
    canvas.style.display = "block";
    canvas.style.width = `${width}px`;
    canvas.style.height = `${HEIGHT}px`;
    pen.setTransform(sharp, 0, 0, sharp, 0, 0);
    pen.clearRect(0, 0, width, HEIGHT);
    pen.font = "12px system-ui, sans-serif";
    pen.lineWidth = 1;
    const kept = [];
    pen.strokeStyle = `rgba(${PALE}, 0.07)`;
    members.forEach((_, place) => {
      if (inside(place)) kept.push(place);
      else path(place);
    });
    pen.strokeStyle = `rgba(${LINE}, ${Math.min(0.7, Math.max(0.08, 40 / (kept.length || 1)))})`;
    kept.forEach(path);
    if (picked >= 0) {
      pen.strokeStyle = MARK;
      pen.lineWidth = 2;
      path(picked);
    }
    axes.forEach(axisOf);
    const some = kept.slice(0, 8).map((place) => members[place]).join(", ");
    const all = ranges.every((range) => !range);
    const count = all ? `${members.length} members` : `${kept.length} of ${members.length} members inside: ${some}${kept.length > 8 ? ", …" : ""}`;
    const one = picked < 0 ? "" : ` · member ${members[picked]}: ${axes.map((axis, k) => `${axis.name} ${textOf(k, axis.values[picked])}`).join(", ")}. Its full report: ${command} --member ${members[picked]}`;
    told.textContent = count + one;
    clear.hidden = all && picked < 0;
  }

  function placeOf(event) {
    const box = canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const axis = axes.findIndex((_, k) => Math.abs(toX(k) - x) < REACH);
    return { x, y, axis, share: Math.min(1, Math.max(0, 1 - (y - BOX.top) / high)) };
  }

  // The member whose line passes nearest, of those inside all ranges.
  function nearest({ x, y }) {
    const left = Math.max(0, Math.min(axes.length - 2, axes.findIndex((_, k) => toX(k + 1) >= x)));
    let best = [-1, 8];
    if (axes.length < 2) return -1;
    members.forEach((_, place) => {
      const [a, b] = [axes[left].values[place], axes[left + 1].values[place]];
      if (a === null || b === null || !inside(place)) return;
      const part = (x - toX(left)) / (toX(left + 1) - toX(left));
      const on = toY(shareOf(left, a)) * (1 - part) + toY(shareOf(left + 1, b)) * part;
      if (Math.abs(on - y) < best[1]) best = [place, Math.abs(on - y)];
    });
    return best[0];
  }

  canvas.addEventListener("pointerdown", (event) => {
    const at = placeOf(event);
    if (at.axis >= 0) {
      drawn = { axis: at.axis, from: at.share, range: [at.share, at.share] };
      canvas.setPointerCapture(event.pointerId);
    } else {
      picked = nearest(at);
    }
    draw();
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = placeOf(event);
    canvas.style.cursor = at.axis >= 0 || drawn ? "ns-resize" : "crosshair";
    if (!drawn) return;
    drawn.range = [Math.min(drawn.from, at.share), Math.max(drawn.from, at.share)];
    draw();
  });
  canvas.addEventListener("pointerup", () => {
    if (!drawn) return;
    // a click on an axis takes its range away
    ranges[drawn.axis] = drawn.range[1] - drawn.range[0] > 0.01 ? drawn.range : null;
    drawn = null;
    draw();
  });
  clear.addEventListener("click", () => {
    ranges.fill(null);
    picked = -1;
    draw();
  });
  window.addEventListener("resize", draw);
  draw();
})();
