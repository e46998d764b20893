// A file while it is edited: forms, text and drawing of one text, checked by the program at every change.

// The file that is open.
let open = null;

const MATERIALS = ["steel", "stainless_steel", "titanium", "aluminium", "nickel_alloy"];
const TASKS = { study: [["study", "Run study"]], qualify: [["qualify", "Run qualification"], ["study", "Run study only"]], machine: [["run", "Run"], ["rotor", "Analyse rotor"]], rotor: [["run", "Analyse rotor"]] };

async function openFile(name) {
  if (open && open.name === name) return open.node;
  if (open && open.dirty() && !window.confirm(`${open.name} has changes that are not saved. Give them up?`)) {
    go("edit", open.name);
    return open.node;
  }
  const { text, hash } = await ask(`/api/file?name=${encodeURIComponent(name)}`);
  open = await editorOf(name, text, hash);
  return open.node;
}

async function editorOf(name, text, hash) {
  const past = history(text);
  let saved = { text, hash };
  let made = [];
  let kind = "";
  let forms = null;
  let found = {};
  let checking = 0;
  let soon = 0;
  let later = 0;
  let wanted = null;
  // whether fields show what stands in the text although they are typed in
  let forced = false;
  // Values of fields that are not in the text yet: it is broken, or the studio did not answer.
  let waiting = [];
  const dirty = () => past.now !== saved.text || waiting.length > 0;

  const editor = textEditor((now) => {
    past.change(now, true);
    changed(false);
  });
  const status = el("span", { class: "status" });
  const fault = el("div", { class: "problem", role: "alert", hidden: true });
  const asks = el("div", { class: "asks", hidden: true, role: "alertdialog" });
  const drawing = el("div", { class: "drawing paper" });
  const loop = el("div", { class: "loop paper" });
  const loopBox = el("details", { class: "pane loop-pane", hidden: true, open: state.layout.loop !== false, ontoggle: (event) => keepLayout({ loop: event.target.open }) }, el("summary", {}, "Closed loop"), loop);
  const warnings = el("ul", { class: "warnings" });
  const warningBox = el("details", { class: "pane", hidden: true }, el("summary", {}, "Warnings"), warnings);
  const formPlace = el("div", { class: "form-place" });
  const undo = button("Undo", () => restore(past.undo()), { title: "Ctrl+Z" });
  const redo = button("Redo", () => restore(past.redo()), { title: "Ctrl+Shift+Z" });
  const keep = button("Save", attempt(() => save()), { title: "Ctrl+S", class: "save" });
  const tasks = el("span", { class: "tasks" });
  const views = ["form", "text", "picture"].map((view) => button(words(view), () => show(view), { class: `view view-${view}` }));
  const body = el("div", { class: "editor" }, formPlace, el("div", { class: "side" }, el("section", { class: "pane" }, drawing), loopBox, warningBox, editor.node));
  const show = (view) => {
    body.dataset.view = view;
    views.forEach((one) => one.classList.toggle("on", one.classList.contains(`view-${view}`)));
  };
  show("form");
  const node = el("div", { class: "file" }, el("div", { class: "toolbar" }, el("h1", {}, name), status, el("span", { class: "views" }, views), el("span", { class: "grow" }), undo, redo, keep, tasks), fault, asks, body);

  // The tools as they are now.
  function tools() {
    undo.disabled = !past.canUndo;
    redo.disabled = !past.canRedo;
    keep.disabled = !dirty();
    status.textContent = dirty() ? "changed" : "saved";
    status.className = `status ${dirty() ? "changed" : ""}`;
  }

  function restore(now) {
    forced = true;
    editor.show(now);
    changed(true);
  }

  // After every change: the check at once, what builds when nothing was typed for a while.
  function changed(atOnce) {
    tools();
    clearTimeout(soon);
    clearTimeout(later);
    soon = setTimeout(attempt(check), atOnce ? 0 : 25);
    later = setTimeout(attempt(behind), 450);
  }

  async function check() {
    const number = ++checking;
    const now = past.now;
    const answer = await ask("/api/check", { name, text: now });
    // a later text is on its way
    if (number !== checking) return;
    if (answer.syntax) {
      const { line, message } = answer.syntax;
      editor.mark(line, `Line ${line}: ${message.split("\n")[0]}`);
      shown({ message: `The text is not valid TOML from line ${line} on; fields wait until it is, and keep what they have.`, line });
      if (forms) forms.wait();
      for (const own of [drawing, loop]) own.classList.add("old");
      return;
    }
    found = answer;
    if (!forms || answer.kind !== kind) {
      kind = answer.kind;
      forms = kind ? formsOf(await keysOf(kind), act) : null;
      formPlace.replaceChildren(forms ? forms.node : el("p", { class: "absent" }, "The text does not say which system it is of: format and system are needed."));
      const offered = TASKS[kind] || [["run", "Run"]];
      tasks.replaceChildren(...(kind ? offered.map(([task, label], k) => button(label, attempt(() => run(task)), { class: k ? "" : "first", title: k ? "" : "Ctrl+Enter" })) : []));
    }
    if (forms) forms.show({ ...answer, forced });
    forced = false;
    const known = byId("materials");
    const named = typedAt(answer.typed, ["rotor", "material"]);
    if (known && Array.isArray(named)) {
      const list = [...MATERIALS, ...named.filter((one) => isLeaf(one.name)).map((one) => one.name["="])];
      known.replaceChildren(...list.map((value) => el("option", { value })));
    }
    editor.mark(answer.problem ? answer.problem.line : 0, "");
    shown(answer.problem);
    drawing.parentNode.hidden = kind === "study" || kind === "qualify";
    if (!answer.problem) drawing.classList.toggle("none", !drawMachine(drawing, answer));
    for (const own of [drawing, loop]) own.classList.toggle("old", Boolean(answer.problem));
    const pending = waiting;
    waiting = [];
    for (const [path, value] of pending) await act.edit(path, value);
    if (wanted) {
      const key = wanted;
      wanted = null;
      if (forms) forms.reveal(key);
    }
  }

  function shown(problem) {
    fault.hidden = !problem;
    if (!problem) return;
    const line = problem.line;
    fault.replaceChildren(el("span", {}, problem.message), line ? button(`line ${line}`, () => { show("text"); editor.reveal(line); }) : "", problem.code ? el("code", {}, problem.code) : "");
  }

  // What takes longer: building, and the closed loop. The next change drops it.
  async function behind() {
    const now = past.now;
    if (found.problem || found.kind === "study" || found.kind === "qualify") return;
    const built = await ask("/api/build", { name, text: now });
    if (now !== past.now || built.dropped) return;
    if (built.problem) {
      shown(built.problem);
      editor.mark(built.problem.line, "");
      if (forms) forms.fault(built.problem);
    }
    const list = built.warnings || [];
    warningBox.hidden = !list.length;
    warningBox.firstChild.textContent = `Warnings (${list.length})`;
    warnings.replaceChildren(...list.map((line) => el("li", {}, line)));
    const analysed = await ask("/api/analysis", { name, text: now });
    if (now !== past.now || analysed.dropped) return;
    loopBox.hidden = Boolean(analysed.none);
    if (analysed.run) FIGURES.closedLoop(loop, analysed.run);
    else if (analysed.problem) loop.replaceChildren(el("p", {}, analysed.problem.message));
  }

  // Changes by fields: one after the other, each of the text as it is then; those that cannot be made wait.
  const waits = (path, value) => {
    waiting = [...waiting.filter(([own]) => pathText(own) !== pathText(path)), [path, value]];
    tools();
  };
  let turn = Promise.resolve();
  const inTurn = (make) => {
    turn = turn.then(attempt(async () => {
      const answer = await make(past.now);
      if (answer.made) made = [...made.filter((one) => one.header !== answer.made.header), answer.made];
      past.change(answer.text);
      editor.show(answer.text);
      changed(true);
    }));
    return turn;
  };
  const act = {
    edit: (path, value) => inTurn(async (now) => {
      const there = typedAt(found.typed, path);
      const empty = value.trim() === "";
      if (empty && there === undefined) return { text: now };
      try {
        const answer = await ask(empty ? "/api/unset" : "/api/set", { text: now, kind, path, value, made });
        if (!answer.broken) return answer;
      } catch (problem) {
        if (problem instanceof Away) waits(path, value);
        throw problem;
      }
      waits(path, value);
      return { text: now };
    }),
    add: (path, keys) => inTurn((now) => ask("/api/add", { text: now, kind, path, keys })),
    remove: (path) => inTurn((now) => ask("/api/remove", { text: now, path })),
  };

  // Saves; what somebody else wrote meanwhile is merged where both changed other lines, else asked for.
  async function save() {
    await settled();
    if (!asks.hidden) throw new Refused(`${name} was changed outside: choose first which lines to keep`);
    if (waiting.length) throw new Refused("Not saved: a field waits until the text is valid");
    const now = past.now;
    const answer = await ask("/api/save", { name, text: now, hash: saved.hash });
    if (answer.theirs === undefined) {
      saved = { text: now, hash: answer.hash };
      tools();
      return true;
    }
    return foreign(answer.theirs, answer.hash) && save();
  }

  // The file has another text than the one that was read: whether both are one now.
  function foreign(theirs, theirHash) {
    if (!dirty()) {
      saved = { text: theirs, hash: theirHash };
      past.change(theirs);
      restore(theirs);
      say(`${name} was changed outside: shown as it is now`);
      return true;
    }
    const both = merged(saved.text, past.now, theirs);
    saved = { text: theirs, hash: theirHash };
    if (both !== null) {
      past.change(both);
      restore(both);
      say(`${name} was changed outside: both changes are merged, not saved yet`);
      return true;
    }
    asks.hidden = false;
    const end = (text) => () => {
      asks.hidden = true;
      past.change(text);
      restore(text);
    };
    asks.replaceChildren(el("p", {}, `${name} was changed outside, in lines that were changed here too.`), button("Keep mine", end(past.now)), button("Take theirs", end(theirs)));
    tools();
    return false;
  }

  async function settled() {
    if (forms) forms.flush();
    await turn;
  }

  async function run(task) {
    await settled();
    if (waiting.length) throw new Refused("A field is not in the text yet: it waits until the text is valid and the studio answers");
    if (dirty() && !(await save())) return;
    const { id } = await ask("/api/run", { name, task });
    await refresh();
    go("job", String(id));
  }

  editor.show(text);
  tools();
  await check();
  later = setTimeout(attempt(behind), 100);
  return {
    name,
    node,
    dirty,
    save,
    ask(key) {
      if (!forms || !forms.reveal(key)) wanted = key;
    },
    undo: () => past.canUndo && restore(past.undo()),
    redo: () => past.canRedo && restore(past.redo()),
    run: () => run((TASKS[kind] || [["run"]])[0][0]),
    find: () => forms && forms.filter.focus(),
    redraw: () => found.typed && !found.problem && drawMachine(drawing, found),
    // Compares with the file from time to time.
    async compare() {
      if (!asks.hidden) return;
      // the scenario of a study may be mended by now
      const others = found.problem && (kind === "study" || kind === "qualify");
      if (waiting.length || others) await check();
      const there = await ask(`/api/file?name=${encodeURIComponent(name)}`);
      if (there.hash !== saved.hash) {
        if (there.text === past.now) saved = there;
        else foreign(there.text, there.hash);
        tools();
      }
    },
  };
}
