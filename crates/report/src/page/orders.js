// The orders of the whirl at a bearing over time, as a map.

const ORDER_BOX = { left: 64, right: 16, top: 10, bottom: 42 };
// What is a thousandth of the largest is as pale as nothing.
const ORDER_DEPTH = 3;

function orderDrawing(run, width) {
  const [orders, times, sizes] = ["order", "time", "amplitude"].map(tableOf(run, "whirl_map"));
  const height = 280;
  const [wide, high] = [width - ORDER_BOX.left - ORDER_BOX.right, height - ORDER_BOX.top - ORDER_BOX.bottom];
  const long = times[times.length - 1] >= 2;
  const factor = long ? 1 : 1e3;
  const half = times.length > 1 ? (times[1] - times[0]) / 2 : times[0];
  const [first, last] = [times[0] - half, times[times.length - 1] + half];
  const [least, most] = [orders[0], orders[orders.length - 1]];
  const step = orders[1] - orders[0];
  const toX = (time) => ORDER_BOX.left + ((time - first) / (last - first)) * wide;
  const toY = (order) => ORDER_BOX.top + ((most + step / 2 - order) / (most - least + step)) * high;
  const largest = Math.max(...sizes);
  const cells = times.flatMap((time, window) =>
    orders.map((order, at) => {
      const size = sizes[window * orders.length + at];
      const share = size > 0 ? 1 + Math.log10(size / largest) / ORDER_DEPTH : 0;
      if (!(share > 0.02)) return null;
      return drawing("rect", { x: toX(time - half).toFixed(1), y: toY(order + step / 2).toFixed(1), width: (toX(time + half) - toX(time - half) + 0.5).toFixed(1), height: (toY(order - step / 2) - toY(order + step / 2) + 0.5).toFixed(1), fill: `rgb(${mapColour(share).join(",")})` });
    }),
  );
  const middle = ORDER_BOX.top + high / 2;
  return drawing(
    "svg",
    { width, height, viewBox: `0 0 ${width} ${height}` },
    drawing("rect", { x: ORDER_BOX.left, y: ORDER_BOX.top, width: wide, height: high, fill: "#fff", stroke: RULE }),
    cells,
    axisSteps(first * factor, last * factor, 8).map((x) => [drawing("line", { x1: toX(x / factor), x2: toX(x / factor), y1: ORDER_BOX.top + high, y2: ORDER_BOX.top + high + 4, stroke: INK }), axisText(toX(x / factor), ORDER_BOX.top + high + 18, "middle", numberText(x, 5))]),
    [-3, -2, -1, 0, 1, 2, 3].filter((order) => order >= least && order <= most).map((order) => [drawing("line", { x1: ORDER_BOX.left, x2: ORDER_BOX.left + wide, y1: toY(order), y2: toY(order), stroke: "#8995a0", "stroke-width": order === 0 ? 1 : 0.4, "stroke-dasharray": order === 0 ? null : "2 3" }), axisText(ORDER_BOX.left - 8, toY(order) + 4, "end", numberText(order, 2))]),
    axisText(ORDER_BOX.left + wide / 2, height - 6, "middle", `time after ${countedFrom(run)} [${long ? "s" : "ms"}]`),
    axisText(16, middle, "middle", "order: whirl over spin", { transform: `rotate(-90 16 ${middle})` }),
  );
}

function orderFigure(run, runs) {
  const title = shareOfRun(run, runs, "Orders of the whirl");
  const sizes = tableOf(run, "whirl_map")("amplitude");
  if (!sizes.length) return figure(title, null, notInThisRun("orders: it is shorter than eight turns, or run.output_interval is longer than a sixteenth of one", run));
  const holder = element("div", { class: "curves" });
  resizable.push(() => holder.replaceChildren(orderDrawing(run, holder.clientWidth || 900)));
  const largest = Math.max(...sizes);
  const note = `What the orbit holds of each multiple of the spin, in windows of eight turns: above 0 it turns as the rotor spins, 1 is unbalance, below 0 it runs backward. Darkest ${engineeringText(largest, "m", 3)}, each shade paler is less, down to a thousandth.`;
  return figure(title, note, holder);
}

function orderSection(runs) {
  return section("orders", "Orders", runs.map((run) => orderFigure(run, runs)));
}
