// Building the page. Texts only ever enter as text nodes, so no input can become markup.

const SVG = "http://www.w3.org/2000/svg";

function fillElement(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  for (const child of children.flat(Infinity)) {
    if (child === null || child === undefined || child === false) continue;
    node.append(child instanceof Node ? child : document.createTextNode(String(child)));
  }
  return node;
}

function element(tag, attributes, ...children) {
  return fillElement(document.createElement(tag), attributes, children);
}

function drawing(tag, attributes, ...children) {
  return fillElement(document.createElementNS(SVG, tag), attributes, children);
}

function section(id, title, ...content) {
  return element("section", { id }, element("h2", {}, title), content);
}

function figure(title, note, ...content) {
  const caption = element("figcaption", {}, element("strong", {}, title), note ? element("span", {}, note) : null);
  return element("figure", {}, caption, content);
}

// Words in a drawing, in the letters of all axes.
function axisText(x, y, anchor, words, more) {
  return drawing("text", { x, y, "text-anchor": anchor, fill: INK, "font-size": 12, ...more }, words);
}

// A table with a head.
function tableOfRows(look, heads, rows) {
  const head = element("tr", {}, heads.map((words) => element("th", {}, words)));
  return element("table", { class: look }, element("thead", {}, head), element("tbody", {}, rows));
}

// What stands where a picture or a number cannot: always with the reason. With several runs it names the one.
function notInThisRun(why, run) {
  return element("p", { class: "absent" }, (run && run.prefix ? `not in run ${run.letter}: ` : "not in this run: ") + why);
}

function list(value) {
  return Array.isArray(value) ? value : [];
}

function isNumber(value) {
  return typeof value === "number" && Number.isFinite(value);
}

// A canvas that knows its size in page pixels, scaled for the screen and for paper.
function sizedCanvas(width, height, canvas) {
  const ratio = window.devicePixelRatio;
  const sheet = canvas || element("canvas");
  sheet.width = Math.round(width * ratio);
  sheet.height = Math.round(height * ratio);
  sheet.style.width = width + "px";
  sheet.style.height = height + "px";
  const pen = sheet.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = FONT;
  return pen;
}

function strokeLine(pen, fromX, fromY, toX, toY) {
  pen.beginPath();
  pen.moveTo(fromX, fromY);
  pen.lineTo(toX, toY);
  pen.stroke();
}

// Words at a place of a canvas.
function penWords(pen, words, x, y, align = "left", baseline = "middle") {
  pen.textAlign = align;
  pen.textBaseline = baseline;
  pen.fillText(words, x, y);
}

const FONT = "12px system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif";
const INK = "#22303c";
const PALE_INK = "#5d6b78";
const RULE = "#dfe4e8";

// Everything that must be drawn anew when the width of the page changes.
const resizable = [];

function redrawAll() {
  for (const redraw of resizable) redraw();
}
