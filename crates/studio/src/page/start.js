// Puts the page together: head, files, queue, and the view that the address names.

let view = null;

const KIND_WORDS = { drop: "rigid rotor dropped", machine: "flexible rotor dropped", rotor: "rotor alone", study: "many runs", spin_up: "bearing brought to speed", torque: "torque of a bearing", rig: "test on a rig", signals: "measurement", identify: "bearing from measurements", coast_down: "coast-down" };

const sideBox = { files: el("div", { class: "files" }), queue: el("div", {}) };
let making = false;

function newFile() {
  const name = el("input", { type: "text", placeholder: "name (optional)", "aria-label": "Name of the new file", spellcheck: "false" });
  const make = attempt(async (kind) => {
    const { name: file } = await ask("/api/new", { kind, name: name.value });
    making = false;
    await refresh();
    files();
    go("edit", file);
  });
  const order = ["drop", "machine", "rotor", "study", ...state.kinds.filter((kind) => !["drop", "machine", "rotor", "study"].includes(kind))];
  return el("div", { class: "new-file" }, name, el("div", { class: "kinds" }, order.map((kind) => button([el("b", {}, words(kind)), el("small", {}, KIND_WORDS[kind] || "")], () => make(kind), { "data-kind": kind }))));
}

function files() {
  const { name } = address();
  const none = !state.files.length;
  sideBox.files.replaceChildren(
    el("div", { class: "side-head" }, el("h2", {}, "Files"), button(making ? "Close" : "New", () => {
      making = !making;
      files();
    }, { class: making ? "" : "first", id: "new" })),
    making || none ? newFile() : "",
    none ? el("p", { class: "absent" }, "This folder has no input file yet: choose what to begin with.") : "",
    el("ul", {}, state.files.map((file) => el("li", { class: address().view === "edit" && file.name === name ? "on" : "" }, el("a", { href: hrefOf("edit", file.name), title: file.title }, file.name.replace(/\.toml$/, "")), el("small", {}, words(file.kind || "?"))))),
  );
}

function head() {
  byId("head").replaceChildren(
    el("a", { class: "brand", href: "#/" }, "auxbear studio"),
    el("a", { href: "#/runs", class: address().view === "runs" ? "on" : "" }, "Runs"),
    el("span", { class: "grow" }),
    el("span", { class: "folder", title: state.folder }, state.folder.split(/[\\/]/).filter(Boolean).pop() || state.folder),
  );
}

let listed = "";

// What the server knows: files and queue.
async function refresh() {
  const found = await ask("/api/state");
  Object.assign(state, found);
  const now = JSON.stringify(found.files);
  if (now !== listed) {
    listed = now;
    if (!making) files();
  }
  const own = state.jobs.length ? queue() : null;
  if (!own || own.parentNode !== sideBox.queue) sideBox.queue.replaceChildren(...(own ? [el("h2", {}, "Queue"), own] : []));
  const busy = state.jobs.filter((job) => !ends(job)).length;
  document.title = busy ? `(${busy}) auxbear studio` : "auxbear studio";
}

// The view that the address names.
const showView = attempt(async () => {
  const { view: wanted, name, key } = address();
  const main = byId("main");
  head();
  view = null;
  let node;
  if (wanted === "edit") node = await openFile(name);
  else if (wanted === "runs") node = await runsView();
  else if (wanted === "run") node = await runView(name);
  else if (wanted === "compare") node = compareView(name.split(","));
  else if (wanted === "job") {
    view = jobView(Number(name));
    node = view.node;
  } else {
    node = state.files.length
      ? el("div", { class: "welcome" }, el("h1", {}, "auxbear studio"), el("p", {}, "Open a file at the left, or begin a new one."), el("p", { class: "absent" }, "Ctrl+S saves, Ctrl+Enter runs, Ctrl+Z takes back, / finds a key."))
      : el("div", { class: "welcome" }, el("h1", {}, "auxbear studio"), el("p", {}, "An empty folder. Choose what to begin with at the left: a starting file reads and runs as it is."));
  }
  const { view: still, name: same } = address();
  if (still !== wanted || same !== name) return;
  if (main.firstChild !== node) main.replaceChildren(node);
  files();
  if (view) await view.update();
  if (wanted === "edit" && open) {
    open.redraw();
    if (key) open.ask(key);
  }
});

const bearingNames = attempt(async () => {
  const list = await ask("/api/bearings");
  const line = (bearing) => `${FIGURES.text(bearing.bore, "m")} × ${FIGURES.text(bearing.outside, "m")}, ${bearing.balls}, ${bearing.type}`;
  document.body.append(el("datalist", { id: "bearings" }, list.map((bearing) => el("option", { value: bearing.name }, line(bearing)))), el("datalist", { id: "materials" }, MATERIALS.map((value) => el("option", { value }))));
});

byId("said").addEventListener("click", () => say(""));
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") say("");
  const control = event.ctrlKey || event.metaKey;
  const typing = ["INPUT", "TEXTAREA", "SELECT"].includes(document.activeElement.tagName);
  if (address().view !== "edit" || !open) return;
  const act = (what) => {
    event.preventDefault();
    attempt(what)();
  };
  if (control && event.key === "s") act(() => open.save());
  else if (control && event.key === "Enter") act(() => open.run());
  else if (control && event.key.toLowerCase() === "z") act(() => (event.shiftKey ? open.redo() : open.undo()));
  else if (control && event.key === "y") act(() => open.redo());
  else if (!control && event.key === "/" && !typing) act(() => open.find());
});

window.addEventListener("message", (event) => {
  const frame = document.querySelector("iframe.page");
  if (frame && event.source === frame.contentWindow && event.data && typeof event.data.input === "string") attempt(inputNamed)(event.data.input, frame);
});
window.addEventListener("hashchange", showView);
window.addEventListener("beforeunload", (event) => {
  if (open && open.dirty()) event.preventDefault();
});
let resizing = 0;
window.addEventListener("resize", () => {
  clearTimeout(resizing);
  resizing = setTimeout(() => address().view === "edit" && open && open.redraw(), 120);
});

// Files and queue from time to time: often while something is computed.
async function follow() {
  let wait = 1500;
  try {
    const before = state.jobs.filter((job) => !ends(job)).length;
    if (before || !document.hidden) await refresh();
    const busy = state.jobs.some((job) => !ends(job));
    if (busy || before) wait = 200;
    if (view) await view.update();
    if (open && address().view === "edit" && !busy) await open.compare();
    if (before && !busy && address().view === "runs") await showView();
  } catch (problem) {
    fail(problem);
  }
  setTimeout(follow, wait);
}

(async () => {
  byId("side").append(sideBox.files, sideBox.queue);
  try {
    state.layout = await ask("/api/layout");
    await refresh();
    files();
    await showView();
    bearingNames();
  } catch (problem) {
    fail(problem);
  }
  setTimeout(follow, 500);
})();
