// Runs: the queue, one that is computed, the table of those that are there, their pages, comparisons.

const STATE_WORDS = { waiting: "waiting", running: "running", stopping: "stopping", done: "done", stopped: "stopped", failed: "failed" };
const ends = (job) => ["done", "stopped", "failed"].includes(job.state);

function bar(share) {
  const meter = el("progress", { max: 1, "aria-label": "share done" });
  meter.value = share;
  return meter;
}

async function stop(id) {
  await ask("/api/stop", { id });
  await refresh();
}

// The first jobs. What can be pressed stays the same element while nothing but the share done changes.
let queued = { key: "", node: null };

function queue() {
  const jobs = state.jobs.slice(0, 12);
  const key = JSON.stringify(jobs.map((job) => [job.id, job.state]));
  if (queued.key !== key) queued = { key, node: queueOf(jobs) };
  const running = jobs.filter((job) => !ends(job));
  queued.node.querySelectorAll("progress").forEach((meter, k) => (meter.value = running[k].share));
  return queued.node;
}

function queueOf(jobs) {
  return el("ol", { class: "queue" }, jobs.map((job) => el("li", { class: `job ${job.state}` },
    el("a", { href: `#/job/${job.id}` }, job.file.replace(/\.toml$/, ""), job.task === "run" ? "" : ` · ${job.task}`),
    el("span", { class: "state" }, STATE_WORDS[job.state]),
    ends(job) ? null : bar(job.share),
    ["waiting", "running"].includes(job.state) ? button("Stop", attempt(() => stop(job.id)), { class: "stop" }) : null)));
}

// One job: progress and pictures while it is computed, then what it left.
function jobView(id) {
  const live = liveView();
  const head = el("div", { class: "toolbar" });
  const line = el("p", { class: "job-line" });
  const place = el("div");
  const node = el("div", { class: "job-view" }, head, line, live.node, place);
  let page = 0;
  let shown = "";
  let meter = null;
  return {
    node,
    async update() {
      const job = state.jobs.find((one) => one.id === id);
      if (!job) {
        node.replaceChildren(el("p", { class: "absent" }, "This run is not in the queue of this session; the table of runs has it where it left a directory."));
        return;
      }
      const now = JSON.stringify([job.state, job.directory]);
      if (now !== shown) {
        shown = now;
        meter = ends(job) ? null : bar(job.share);
        head.replaceChildren(...[
          el("h1", {}, job.file),
          el("span", { class: `status ${job.state}` }, STATE_WORDS[job.state]),
          meter,
          el("span", { class: "grow" }),
          ["waiting", "running"].includes(job.state) ? button("Stop", attempt(() => stop(id)), { class: "stop" }) : null,
          el("a", { class: "button", href: hrefOf("edit", job.file) }, "Edit"),
          ends(job) && job.directory ? el("a", { class: "button first", href: hrefOf("run", job.directory) }, "Results") : null,
        ].filter(Boolean));
        line.classList.toggle("fault", job.state === "failed");
      }
      if (meter) meter.value = job.share;
      const rest = job.state === "stopping" ? "stops at the next step and writes what was computed" : job.share >= 1 && !ends(job) ? "writes its results" : "";
      line.textContent = [job.words, ends(job) || job.seconds ? `${ends(job) ? "took " : ""}${secondsText(job.seconds)}` : "", rest].filter(Boolean).join(" · ");
      // what a study says so far, as often as it is written
      if (job.page && job.page !== page && !ends(job)) {
        page = job.page;
        const file = job.task === "qualify" ? "document.html" : "report.html";
        place.className = "page-place";
        place.replaceChildren(frameOf(`/page/run?run=${encodeURIComponent(job.directory)}&file=${file}&at=${page}`, "Results so far"));
      }
      if (["running", "stopping"].includes(job.state) || (ends(job) && !live.node.children.length)) await live.update(id);
      if (ends(job)) live.ended();
    },
  };
}

const numberOf = (result) => (typeof result.value === "number" ? FIGURES.text(result.value, result.unit) : result.value ?? "–");

// Results of the table: the first ones of each system, most of all of that with the most runs.
function resultColumns(rows) {
  const systems = new Map();
  for (const { system, results } of rows) systems.set(system, [...(systems.get(system) || []), (results || []).map(({ short }) => short)]);
  const byRuns = [...systems.values()].sort((one, other) => other.length - one.length);
  const columns = byRuns.flatMap((runs, k) => [...new Set(runs.flat())].slice(0, k ? 3 : 6));
  return [...new Set(columns)].slice(0, 12);
}

// A result of a run: of several bearings each, in their order.
function resultCell(row, short) {
  const own = (row.results || []).filter((one) => one.short === short);
  const several = own.length > 1;
  const title = own.map(({ name, words }, k) => (several ? `${name}: ${numberOf(own[k])}` : words));
  return el("td", { class: "number", title: [several ? own[0].words : "", ...title].filter(Boolean).join("\n") }, own.map(numberOf).join(" · "));
}

async function runsView() {
  const { rows, inputs, more } = await ask("/api/runs");
  if (!rows.length) return el("div", { class: "runs" }, el("h1", {}, "Runs"), el("p", { class: "absent" }, "No run yet: open a file and run it."));
  const chosen = new Set();
  const compare = button("Compare", () => go("compare", [...chosen].join(",")), { disabled: true, class: "first" });
  const choose = (row) => el("input", { type: "checkbox", "aria-label": `Choose ${row.directory}`, disabled: row.study || row.broken, onchange: (event) => {
    if (event.target.checked) chosen.add(row.directory);
    else chosen.delete(row.directory);
    compare.disabled = chosen.size < 2;
    compare.textContent = chosen.size > 1 ? `Compare ${chosen.size} runs` : "Compare";
  } });
  const results = resultColumns(rows);
  const stale = (row) => {
    if (!row.differs) return row.file ? el("span", { class: "stale" }, "the file cannot be read now") : null;
    if (!row.differs.length) return el("span", { class: "fresh" }, "as the file");
    const list = row.differs.map(([path, then, now]) => `${path}: ${then} → ${now}`).join("\n");
    return el("span", { class: "stale", title: list }, `stale: ${row.differs.length === 1 ? row.differs[0][0] : `${row.differs.length} inputs`} changed`);
  };
  const limits = (row) => {
    const { of, pass = 0, fail = 0, open = 0 } = row.limits || {};
    const all = pass + fail + open;
    if (!all) return "";
    const undecided = open ? `${open} of ${all} ${of} undecided` : "";
    if (fail) return el("span", { class: "bad" }, [`${fail} of ${all} ${of} not held`, undecided].filter(Boolean).join(", "));
    return open ? el("span", { class: "stale" }, undecided) : el("span", { class: "good" }, `${pass} ${pass === 1 ? of.replace(/s$/, "") : of} held`);
  };
  const cells = (row) => [
    el("td", {}, choose(row)),
    el("td", { class: "name" }, el("a", { href: hrefOf("run", row.directory) }, row.directory.replace(/^runs\//, "")), el("small", {}, row.broken || row.title || "")),
    el("td", {}, words(row.system || "")),
    el("td", {}, row.complete === false ? [el("span", { class: "stale", title: row.stop }, "not complete"), " ", (row.differs || []).length ? stale(row) : null] : stale(row)),
    ...inputs.map((path) => el("td", {}, (row.inputs || {})[path] || "")),
    ...results.map((name) => resultCell(row, name)),
    el("td", {}, limits(row)),
    el("td", { class: "date" }, dateText(row.date)),
  ];
  const heads = ["", "run", "system", "input", ...inputs, ...results, "limits", "date"];
  return el("div", { class: "runs" },
    el("div", { class: "toolbar" }, el("h1", {}, "Runs"), el("span", { class: "grow" }), more ? el("span", { class: "absent" }, `${more} more inputs differ: compare runs to see all`) : null, compare),
    el("div", { class: "wide" }, el("table", {}, el("thead", {}, el("tr", {}, heads.map((head, k) => el("th", { class: k > 3 && k < 4 + inputs.length ? "input" : "" }, head)))), el("tbody", {}, rows.map((row) => el("tr", {}, cells(row)))))));
}

// The page that a run left, in a frame that reaches nothing.
function frameOf(source, title) {
  return el("iframe", { sandbox: "allow-scripts allow-modals", src: source, title, class: "page" });
}

async function runView(directory) {
  const { rows } = await ask("/api/runs");
  const row = rows.find((one) => one.directory === directory) || {};
  const coded = encodeURIComponent(directory);
  const file = (name, label) => el("a", { class: "button", href: `/file?run=${coded}&file=${name}`, download: "" }, label);
  const page = (name) => frameOf(`/page/run?run=${coded}&file=${name}`, `Page of ${directory}`);
  const place = el("div", { class: "page-place" }, page("report.html"));
  const show = (make) => attempt(async (event) => {
    place.replaceChildren(await make());
    for (const tab of event.target.parentNode.children) tab.classList.toggle("on", tab === event.target);
  });
  const tabs = el("span", { class: "tabs" },
    button("Results", show(() => page("report.html")), { class: "on" }),
    row.document ? button("Document", show(() => page("document.html"))) : null,
    row.study ? null : button("Motion", show(() => motionView(directory))));
  const differs = (row.differs || []).map(([path, then, now]) => `${path}: ${then} → ${now}`).join("\n");
  return el("div", { class: "run-view" },
    el("div", { class: "toolbar" }, el("h1", {}, directory), differs ? el("span", { class: "status stale", title: differs }, "stale: the file has changed") : null, tabs, el("span", { class: "grow" }),
      row.file ? el("a", { class: "button", href: hrefOf("edit", row.file) }, "Edit input") : null,
      row.file ? button("Run again", attempt(() => again(row)), { title: "with the file as it is now" }) : null,
      file("report.html", "Page"), row.document ? file("document.html", "Document") : null, row.study ? null : file("run.xlsx", "Workbook")),
    row.file ? el("p", { class: "hint" }, "Click the name of an input in the page to change it and run again.") : null,
    place);
}

async function again(row) {
  const file = state.files.find((one) => one.name === row.file) || {};
  const task = row.document ? "qualify" : row.study ? "study" : file.kind === "machine" && row.system === "rotor" ? "rotor" : "run";
  const { id } = await ask("/api/run", { name: row.file, task });
  await refresh();
  go("job", String(id));
}

function compareView(names) {
  const source = `/page/compare?${names.map((name) => `run=${encodeURIComponent(name)}`).join("&")}`;
  return el("div", { class: "run-view" }, el("div", { class: "toolbar" }, el("h1", {}, `${names.length} runs side by side`)), el("div", { class: "page-place" }, frameOf(source, "Comparison")));
}

// An input named in the page of a run: its file opens there. What a study varies stands in the file that it names.
async function inputNamed(path, frame) {
  const { view, name } = address();
  if (view !== "run" || !frame) return;
  const { rows } = await ask("/api/runs");
  const row = rows.find((one) => one.directory === name);
  if (!row || !row.file) return;
  let file = row.file;
  if (row.study) {
    const { text } = await ask(`/api/file?name=${encodeURIComponent(file)}`);
    const { typed } = await ask("/api/check", { name: file, text });
    if (typed && isLeaf(typed.scenario)) file = [...file.split("/").slice(0, -1), typed.scenario["="]].join("/");
  }
  const known = state.files.find((one) => one.name === file);
  if (!known || !known.kind) return;
  const keys = await keysOf(known.kind);
  const all = keys.sections.flatMap((section) => section.keys.map((key) => key.path));
  if (all.includes(path)) go("edit", file, path);
}
