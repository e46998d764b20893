// Colours. The map runs from pale yellow through green and blue to dark violet with evenly falling lightness in
// OKLab, so that equal steps of the value look like equal steps, on screen, on paper and in grey.

const RUN_COLOURS = ["#1f5fa8", "#c2571a", "#2f8f5b", "#8a4fae", "#8a7410", "#b0306a"];
const SERIES_COLOURS = { rotor: "#1f5fa8", race: "#c2571a", cage: "#2f8f5b", quiet: "#8995a0", limit: "#b3261e" };
// Each heat has its colour in every report; what no name stands for here comes in grey.
const HEAT_COLOURS = {
  rotor_race_friction: "#c2571a",
  rotor_race_damping: "#e0a03c",
  mount_damping: "#2f8f5b",
  ball_slip: "#1f5fa8",
  inner_ball_slip: "#1f5fa8",
  outer_ball_slip: "#6d9fd3",
  inner_contact_damping: "#8a7410",
  outer_contact_damping: "#bda93f",
  pocket_friction: "#8a4fae",
  pocket_damping: "#b48fcc",
  land_friction: "#b0306a",
  land_damping: "#d988a9",
  ball_ball_friction: "#5b4a9c",
  ball_ball_damping: "#9d92c8",
  steady_moment: "#287d86",
  inlet_rolling: "#5fb3b3",
  acceleration_loss: "#7d4b2a",
  drag: "#5f8f9c",
  clutch: "#a33a3a",
  belt: "#d48a7a",
  support_bearings: "#4b5a66",
};
const HEAT_WITHOUT_NAME = "#9aa7b4";
const SKID = [206, 44, 38];

function screenColour(lightness, chroma, hue) {
  const a = chroma * Math.cos(hue);
  const b = chroma * Math.sin(hue);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  return linear.map((part) => {
    const x = Math.min(1, Math.max(0, part));
    return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
  });
}

const COLOUR_MAP = Array.from({ length: 256 }, (_, index) => {
  const share = index / 255;
  const chroma = 0.03 + 0.072 * Math.sin(Math.PI * share);
  return screenColour(0.975 - 0.7 * share, chroma, ((105 + 195 * share) * Math.PI) / 180);
});

function mapColour(share) {
  return COLOUR_MAP[Math.round(255 * Math.min(1, Math.max(0, share)))];
}

// Lines on a white page start where the map is dark enough to be seen.
function lineColour(share) {
  return `rgb(${mapColour(0.28 + 0.72 * share).join(",")})`;
}

function paintRamp(pen, left, top, width, height, colourAt, vertical) {
  const steps = Math.round(vertical ? height : width);
  for (let step = 0; step < steps; step++) {
    pen.fillStyle = colourAt(step / Math.max(1, steps - 1));
    if (vertical) pen.fillRect(left, top + height - step - 1, width, 1.5);
    else pen.fillRect(left + step, top, 1.5, height);
  }
  pen.strokeStyle = PALE_INK;
  pen.lineWidth = 0.75;
  pen.strokeRect(left, top, width, height);
}
