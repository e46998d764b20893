// Numbers as an engineer writes them.

const SUPERSCRIPT = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

// Prefixed units, largest first: [unit, size in SI].
const PREFIXED = {
  N: [["kN", 1e3], ["N", 1], ["mN", 1e-3]],
  m: [["m", 1], ["mm", 1e-3], ["µm", 1e-6], ["nm", 1e-9]],
  s: [["s", 1], ["ms", 1e-3], ["µs", 1e-6], ["ns", 1e-9]],
  Pa: [["MPa", 1e6], ["kPa", 1e3], ["Pa", 1]],
  "N m": [["N m", 1], ["N mm", 1e-3]],
  "m^2/s": [["mm²/s", 1e-6]],
  J: [["kJ", 1e3], ["J", 1], ["mJ", 1e-3], ["µJ", 1e-6], ["nJ", 1e-9]],
  W: [["kW", 1e3], ["W", 1], ["mW", 1e-3]],
  "rad/s": [["rpm", Math.PI / 30]],
  rad: [["°", Math.PI / 180]],
  "m/s": [["m/s", 1], ["mm/s", 1e-3]],
};

function numberText(value, digits = 5) {
  if (!isNumber(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e7) return thousandsApart(String(value));
  if (size >= 1e6 || size < 1e-3) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${trimmed(mantissa)} × ${powerOfTen(Number(exponent))}`;
  }
  const text = value.toPrecision(digits);
  // more digits before the point than asked for: 11 530, not 1.153e+4
  return text.includes("e") ? thousandsApart(String(Number(text))) : trimmed(text);
}

// Thousands apart from 10 000 on.
function thousandsApart(text) {
  const [whole, ...rest] = text.replace("-", "−").split(".");
  const digits = whole.replace("−", "").length;
  return [digits > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole, ...rest].join(".");
}

function powerOfTen(exponent) {
  return "10" + [...String(exponent)].map((sign) => SUPERSCRIPT[sign]).join("");
}

function trimmed(text) {
  return thousandsApart(text.includes(".") ? text.replace(/\.?0+$/, "") : text);
}

function unitText(unit) {
  return unit === "1" || !unit ? "" : unit.replace(/\^([0-9])/g, (_, power) => SUPERSCRIPT[power]);
}

// The prefixed unit in which a value of this size reads best.
function readableUnit(size, unit) {
  const choices = PREFIXED[unit];
  if (!choices) return [unitText(unit), 1];
  return choices.find(([, scale]) => Math.abs(size) >= scale) || choices[choices.length - 1];
}

// Of these units such values are what rounding leaves of zero.
const ROUNDING = { "rad/s": 1e-12, "N m": 1e-15 };

function engineeringText(value, unit, digits) {
  if (!isNumber(value)) return "–";
  if (value !== 0 && Math.abs(value) < (ROUNDING[unit] || 0)) return "0";
  const [name, scale] = value === 0 ? [unitText(unit), 1] : readableUnit(value, unit);
  const gap = name && name !== "°" ? " " : "";
  return numberText(value / scale, digits) + gap + name;
}

function siText(value, unit) {
  if (!isNumber(value)) return "–";
  return (numberText(value, 6) + " " + unitText(unit)).trim();
}

function percentText(share, digits = 3) {
  return numberText(100 * share, digits) + " %";
}

// A number with a fixed count of decimals, never with a power of ten.
function decimalText(value, decimals) {
  return isNumber(value) ? value.toFixed(Math.min(20, Math.max(0, decimals))).replace("-", "−") : "–";
}

// Power of ten of the leading digit.
function leadingPower(value) {
  return value === 0 ? 0 : Math.floor(Math.log10(Math.abs(value)));
}

// A value and what it may be off, with the digits that this leaves: two of the band, the value to the same place.
function bandParts(value, band) {
  if (!isNumber(value)) return ["–", null];
  if (!isNumber(band)) return [numberText(value, 4), "?"];
  if (!(band > 0)) return [numberText(value, 5), null];
  const size = leadingPower(Math.max(Math.abs(value), band));
  if (size > 6 || size < -3) return bandParts(value / 10 ** size, band / 10 ** size).map((part) => `${part} × ${powerOfTen(size)}`);
  const decimals = 1 - leadingPower(Number(band.toPrecision(2)));
  const text = (number) => thousandsApart(decimals >= 0 ? decimalText(number, decimals) : String(Math.round(number * 10 ** decimals) * 10 ** -decimals));
  return [text(value), text(band)];
}

// The same in one line.
function bandNumbers(value, band) {
  const [number, spread] = bandParts(value, band);
  if (spread === null) return number;
  const power = / × 10\S+$/.exec(number);
  return power ? `(${number.slice(0, power.index)} ± ${spread.replace(power[0], "")})${power[0]}` : `${number} ± ${spread}`;
}

// One unit for a whole column of values, and as many decimals as give the largest of them so many digits.
function columnScale(values, unit, digits) {
  const largest = values.filter(isNumber).reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  const [name, scale] = readableUnit(largest, unit);
  const decimals = digits - 1 - leadingPower(largest / scale);
  return { name, text: (value) => decimalText(isNumber(value) ? value / scale : null, decimals) };
}

// A speed in both of its units.
function speedText(value, digits = 4) {
  return isNumber(value) ? `${numberText((value * 30) / Math.PI, digits)} rpm (${numberText(value, digits)} rad/s)` : "–";
}

// The frequency of a mode in both of its units.
function frequencyText(value, digits = 5) {
  return isNumber(value) ? `${numberText(value / (2 * Math.PI), digits)} Hz (${numberText(value, digits)} rad/s)` : "–";
}

// The value of an input as people say it: without float noise, speeds in rpm and rad/s, angles in degrees.
function inputText(value) {
  const text = plainInput(value);
  const [, size, own] = /^([+-]?[\d.]+(?:[eE][+-]?\d+)?) (.+)$/.exec(text) || [];
  if (own && Math.abs(Number(size)) < 0.01) return engineeringText(Number(size), own, 6);
  const match = /^([+-]?[\d.]+(?:[eE][+-]?\d+)?) (rpm|rad\/s|rad)$/.exec(text);
  if (!match) return text;
  const [number, unit] = [Number(match[1]), match[2]];
  if (unit === "rad") return `${numberText((number * 180) / Math.PI, 5)}°`;
  return unit === "rpm" ? `${text} (${numberText((number * Math.PI) / 30, 5)} rad/s)` : `${text} (${numberText((number * 30) / Math.PI, 5)} rpm)`;
}

// Numbers of more than six digits are rounded, counts and words stay.
function plainInput(value) {
  const text = String(value);
  if (!/^[[+-]?\d/.test(text)) return text;
  const short = text.replace(/(\d+\.\d*)([eE][+-]?\d+)?/g, (number, mantissa, exponent = "") => {
    const digits = mantissa.replace(".", "").replace(/^0+/, "");
    return digits.length > 6 ? String(Number(Number(mantissa).toPrecision(6))) + exponent : number;
  });
  return short.replace(/\bum\b/, "µm");
}

// "bearing.inner_race.time_to_50_percent" reads "bearing inner race: time to 50 %".
function wordsOf(name) {
  const parts = String(name).split(".");
  const last = parts.pop().replace(/_/g, " ").replace(/\bpercent\b/g, "%");
  return parts.length ? parts.join(" ").replace(/_/g, " ") + ": " + last : last;
}
