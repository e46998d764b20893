// What every part of the studio uses: elements, requests, the state, the address of what is shown.

const state = { files: [], jobs: [], kinds: [], folder: "", version: "", layout: {} };
const FIGURES = window.auxbearFigures;

// Texts enter as text nodes alone, so no input becomes markup.
function el(tag, attributes, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (name === "value") node.value = value;
    else node.setAttribute(name, value === true ? "" : value);
  }
  for (const child of children.flat(Infinity)) {
    if (child === null || child === undefined || child === false) continue;
    node.append(child instanceof Node ? child : String(child));
  }
  return node;
}

const byId = (id) => document.getElementById(id);

function button(words, act, attributes = {}) {
  return el("button", { type: "button", onclick: act, ...attributes }, words);
}

let fading = 0;
// Whether the line says that the studio does not answer.
let answeredNot = false;

// A line that is read and goes away; a fault stays until the next thing that is asked for, a click on it or Esc.
function say(words, fault = false) {
  const line = byId("said");
  answeredNot = false;
  line.textContent = words;
  line.className = words ? (fault ? "fault shown" : "shown") : "";
  clearTimeout(fading);
  if (!fault) fading = setTimeout(() => (line.className = ""), 4000);
}

class Refused extends Error {}
// Nothing came of what was asked, and it may later.
class Away extends Refused {}

async function ask(path, body) {
  const given = body === undefined ? {} : { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
  let answer;
  try {
    answer = await fetch(path, given);
  } catch {
    document.body.classList.add("away");
    throw new Away("The studio does not answer: the program has ended. Start it again and open the address that it prints.");
  }
  const found = await answer.json();
  const away = answer.status === 403;
  if (document.body.classList.toggle("away", away)) throw new Away(found.error);
  if (answeredNot) say("");
  if (!answer.ok) throw new Refused(found.error || `status ${answer.status}`);
  return found;
}

function fail(problem) {
  say(problem.message, true);
  answeredNot = problem instanceof Away;
}

// Does what a person asked for, and names what was wrong with it.
function attempt(act) {
  return async (...given) => {
    if (byId("said").classList.contains("fault") && !answeredNot) say("");
    try {
      return await act(...given);
    } catch (problem) {
      fail(problem);
      if (!(problem instanceof Refused)) throw problem;
    }
  };
}

// The address behind the #: a view and what it shows, ? a key of it.
function address() {
  const [path, key = ""] = location.hash.slice(2).split("?");
  const [view, ...rest] = path.split("/").map(decodeURIComponent);
  return { view, name: rest.join("/"), key: decodeURIComponent(key) };
}

const hrefOf = (view, name, key = "") => `#/${view}/${name.split("/").map(encodeURIComponent).join("/")}${key ? `?${encodeURIComponent(key)}` : ""}`;

function go(view, name, key) {
  location.hash = hrefOf(view, name, key);
}

const dateText = (seconds) => new Date(1000 * seconds).toLocaleString(undefined, { dateStyle: "medium", timeStyle: "short" });
const secondsText = (seconds) => (seconds < 60 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`);
const words = (name) => name.replaceAll("_", " ");

let keeping = 0;

// What the arrangement of the page is stands in the folder.
function keepLayout(change) {
  Object.assign(state.layout, change);
  clearTimeout(keeping);
  keeping = setTimeout(attempt(() => ask("/api/layout", state.layout)), 400);
}

const SVG = "http://www.w3.org/2000/svg";

function svg(tag, attributes, ...children) {
  const node = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) if (value !== null) node.setAttribute(name, value);
  node.append(...children.flat(Infinity).filter((child) => child !== null));
  return node;
}
