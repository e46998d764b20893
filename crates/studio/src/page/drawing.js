// The machine to scale: a shaft by the scripts of a rotor's page, else the bearing from the front with the rotor in it.

const at = (values, path) => {
  const found = values.find((value) => value.path === path);
  return found && typeof found.si === "number" ? found.si : null;
};

// Axes, balls, races, and the rotor in its clearance, all in one scale; the clearance again, magnified.
function bearingDrawing(values, width) {
  const pitch = at(values, "bearing.pitch_diameter");
  const ball = at(values, "bearing.ball_diameter");
  const count = at(values, "bearing.ball_count");
  const bore = at(values, "contact.bore_diameter") ?? at(values, "bearing.bore_diameter");
  if (!(pitch && ball && count && pitch > ball)) return null;
  const inside = bore || pitch - 2 * ball;
  const outside = at(values, "bearing.outside_diameter") || 2 * pitch - inside;
  const clearance = at(values, "contact.radial_air_clearance");
  const tall = Math.min(300, Math.max(200, 0.42 * width));
  const scale = (tall - 40) / outside;
  const [x, y] = [tall / 2 + 6, tall / 2];
  const circle = (diameter, look) => svg("circle", { cx: x, cy: y, r: ((diameter / 2) * scale).toFixed(2), ...look });
  const edge = { fill: "none", stroke: "#7b8894", "stroke-width": 0.9 };
  const balls = Array.from({ length: Math.round(count) }, (_, k) => {
    const angle = (2 * Math.PI * k) / count + Math.PI / 2;
    return svg("circle", { cx: x + (pitch / 2) * scale * Math.cos(angle), cy: y - (pitch / 2) * scale * Math.sin(angle), r: (ball / 2) * scale, fill: "#c7d0d8", stroke: "#55677a", "stroke-width": 0.8 });
  });
  const parts = [
    circle(outside, { fill: "#d5dde4", stroke: "#7b8894" }),
    circle(pitch + 0.55 * ball, { fill: "#ffffff", stroke: "#7b8894", "stroke-width": 0.8 }),
    circle(pitch - 0.55 * ball, { fill: "#d5dde4", stroke: "#7b8894", "stroke-width": 0.8 }),
    balls,
    circle(inside, { fill: "#ffffff", stroke: "#7b8894", "stroke-width": 0.8 }),
  ];
  if (clearance !== null) parts.push(circle(Math.max(inside - 2 * clearance, 0), { fill: "#e8eef5", stroke: "#1f5fa8", "stroke-width": 1.2 }));
  parts.push(svg("path", { d: `M${x - tall / 2 + 8} ${y}H${x + tall / 2 - 8}M${x} 6V${tall - 6}`, stroke: "#8995a0", "stroke-width": 0.8, "stroke-dasharray": "10 3 2 3" }));
  const text = (left, top, line, size = 12, anchor = "start") => svg("text", { x: left, y: top, "font-size": size, fill: "#22303c", "text-anchor": anchor }, line);
  const facts = [
    ["pitch diameter", FIGURES.text(pitch, "m")],
    ["balls", `${Math.round(count)} × ${FIGURES.text(ball, "m")}`],
    ["bore", FIGURES.text(inside, "m")],
    ["outside", `${FIGURES.text(outside, "m")}${at(values, "bearing.outside_diameter") ? "" : " (estimated)"}`],
    ...(clearance === null ? [] : [["air clearance", FIGURES.text(clearance, "m")]]),
  ];
  const left = tall + 30;
  facts.forEach(([name, value], k) => parts.push(text(left, 30 + 19 * k, name), text(left + 104, 30 + 19 * k, value)));
  if (clearance) {
    const r = 26;
    const top = 30 + 19 * facts.length + 34;
    const drop = [at(values, "levitation.offset_x") || 0, at(values, "levitation.offset_y") || 0];
    parts.push(svg("circle", { cx: left + r, cy: top, r, ...edge, "stroke-dasharray": "3 2" }), svg("circle", { cx: left + r + (drop[0] / clearance) * r, cy: top - (drop[1] / clearance) * r, r: 3, fill: "#1f5fa8" }), text(left + 2 * r + 12, top - 4, "levitated centre in"), text(left + 2 * r + 12, top + 12, "the clearance, magnified"));
  }
  parts.push(text(left, tall - 6, "drawn to scale", 11));
  return svg("svg", { width: Math.max(width, left + 220), height: tall, viewBox: `0 0 ${Math.max(width, left + 220)} ${tall}`, role: "img", "aria-label": "The bearing to scale" }, parts);
}

// Draws what a check found; what it cannot draw stays as it was.
function drawMachine(holder, found) {
  if (found.drawing) {
    FIGURES.rotor(holder, found.drawing);
    return true;
  }
  const picture = found.values && bearingDrawing(found.values, holder.clientWidth || 600);
  if (picture) holder.replaceChildren(picture);
  return Boolean(picture);
}

// The orbit of the rotor in the clearance circle, and the balls around it, darker the more they carry.
function drawOrbit(canvas, { clearance, path, force, balls }) {
  const size = canvas.clientWidth || 280;
  const ratio = window.devicePixelRatio || 1;
  canvas.width = canvas.height = size * ratio;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  const reach = path.slice(-3000).reduce((most, [x, y]) => Math.max(most, Math.hypot(x, y)), Math.max(clearance || 0, 1e-9));
  const middle = size / 2;
  const scale = (0.6 * middle) / reach;
  const disc = (x, y, r, fill) => {
    pen.fillStyle = fill;
    pen.beginPath();
    pen.arc(x, y, r, 0, 2 * Math.PI);
    pen.fill();
  };
  pen.strokeStyle = "#8995a0";
  pen.lineWidth = 1;
  pen.beginPath();
  pen.arc(middle, middle, (clearance || 0) * scale, 0, 2 * Math.PI);
  pen.stroke();
  pen.strokeStyle = "#1f5fa8";
  pen.beginPath();
  path.forEach(([x, y], n) => (n ? pen.lineTo(middle + x * scale, middle - y * scale) : pen.moveTo(middle + x * scale, middle - y * scale)));
  pen.stroke();
  const last = path[path.length - 1];
  if (last) disc(middle + last[0] * scale, middle - last[1] * scale, 4, force > 0 ? "#b3261e" : "#22303c");
  const most = balls.reduce((largest, [, load]) => Math.max(largest, load), 1e-9);
  const r = Math.max(3, Math.min(11, (1.7 * middle) / Math.max(balls.length, 6)));
  for (const [angle, load] of balls) disc(middle + 0.84 * middle * Math.cos(angle), middle - 0.84 * middle * Math.sin(angle), r, load > 0 ? `rgba(194,87,26,${0.25 + (0.75 * load) / most})` : "#c7d0d8");
}

// The orbits and balls of a run that is computed.
function liveView() {
  const holder = el("div", { class: "live" });
  const paths = [];
  let [round, from] = [0, 0];
  return {
    node: holder,
    // The run is over: its results are elsewhere.
    ended() {
      const instant = holder.querySelector(".instant");
      if (instant && !instant.dataset.last) [instant.dataset.last, instant.textContent] = ["1", `last picture while it was computed, ${instant.textContent}`];
    },
    async update(id) {
      const live = await ask(`/api/live?id=${id}&round=${round}&from=${from}`);
      if (!live.bearings.length) return;
      live.bearings.forEach((bearing, k) => (paths[k] = live.from ? [...(paths[k] || []), ...bearing.path] : bearing.path));
      [round, from] = [live.round, live.next];
      if (holder.children.length !== live.bearings.length + 1) {
        holder.replaceChildren(el("p", { class: "instant" }), ...live.bearings.map((bearing) => el("figure", {}, el("figcaption", {}), el("canvas", { role: "img", "aria-label": `Orbit and balls ${bearing.name}` }))));
      }
      holder.querySelector(".instant").textContent = `at ${FIGURES.text(live.time, "s")}: rotor ${FIGURES.text(live.speed, "rad/s")}`;
      live.bearings.forEach((bearing, k) => {
        const figure = holder.children[k + 1];
        figure.firstChild.textContent = `${words(bearing.name || "orbit and balls")}: contact force ${FIGURES.text(bearing.force, "N")}`;
        drawOrbit(figure.lastChild, { ...bearing, path: paths[k], balls: bearing.balls || [] });
      });
    },
  };
}
