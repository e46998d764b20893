// The forms of a file: a field for each key of the table, with unit, default and help; parts as rows of fields.

const keysOfKind = new Map();

async function keysOf(kind) {
  if (!keysOfKind.has(kind)) keysOfKind.set(kind, await ask(`/api/keys?kind=${encodeURIComponent(kind)}`));
  return keysOfKind.get(kind);
}

const isLeaf = (value) => value !== null && typeof value === "object" && "=" in value;

// What stands in the text at a path of names and places.
function typedAt(tree, path) {
  return path.reduce((node, step) => (node === null || node === undefined ? undefined : node[step]), tree);
}

const pathText = (path) => path.join(".");

// A field for a value: what is typed goes to `edit(path, value)`, an empty one takes the key away.
function field(path, key, edit) {
  const id = `field-${pathText(path)}`;
  const choices = key.words && key.words.length && !key.several ? key.words : null;
  const input = choices
    ? el("select", { id }, el("option", { value: "" }, "–"), choices.map((word) => el("option", { value: word }, word)))
    : el("input", { id, type: "text", autocomplete: "off", spellcheck: "false", list: key.list || null });
  const mark = el("span", { class: "mark" });
  const fault = el("p", { class: "fault", id: `${id}-fault` });
  const help = el("div", { class: "help", hidden: true });
  const fillHelp = () => help.replaceChildren(el("p", {}, key.doc), el("p", {}, key.needed || ""), key.without ? el("p", {}, `Without it: ${key.without}.`) : "", key.when && key.when.length ? el("p", {}, `Only with ${key.when.join(" and ")}.`) : "", el("p", { class: "origin" }));
  const question = button("?", () => {
    fillHelp();
    help.hidden = !help.hidden;
    question.setAttribute("aria-expanded", String(!help.hidden));
    origin();
  }, { class: "question", "aria-label": `About ${pathText(path)}`, "aria-expanded": "false" });
  let note = "";
  const origin = () => {
    const own = help.querySelector(".origin");
    if (own) own.textContent = note;
  };
  let waiting = 0;
  const send = () => {
    waiting = 0;
    edit(path, input.value);
  };
  const flush = () => {
    if (!waiting) return;
    clearTimeout(waiting);
    send();
  };
  input.addEventListener("input", () => {
    clearTimeout(waiting);
    waiting = setTimeout(send, choices ? 0 : 20);
  });
  input.addEventListener("change", flush);
  const node = el("div", { class: "field", "data-path": pathText(path) }, el("label", { for: id, title: key.doc }, words(key.name || path[path.length - 1])), input, el("span", { class: "unit" }, key.unit || ""), mark, question, fault, help);
  return {
    node,
    input,
    flush,
    // value as typed (none where the text does not give it), what holds without it, its mark and where it comes from
    show({ typed, held, mark: word, note: why, forced }) {
      const text = typed === undefined ? "" : typed;
      if (!waiting && (forced || document.activeElement !== input || choices)) {
        if (choices && text && !choices.includes(text)) input.append(el("option", { value: text }, text));
        input.value = text;
      }
      if (choices) input.options[0].textContent = held ? `${held} (${word})` : "–";
      else input.placeholder = held || (key.example ? `e.g. ${key.example}` : "");
      node.classList.toggle("given", typed !== undefined);
      mark.textContent = typed !== undefined && word !== "assumed" ? "" : word || "";
      mark.className = `mark ${word || ""}`;
      note = why || "";
      mark.title = note;
      origin();
    },
    wrong(message) {
      node.classList.toggle("wrong", Boolean(message));
      fault.textContent = message || "";
      input.setAttribute("aria-invalid", String(Boolean(message)));
      if (message) input.setAttribute("aria-describedby", fault.id);
    },
    wait(broken) {
      node.classList.toggle("waits", broken);
    },
  };
}

// The first line of what stands in a part of the text.
function lineOf(tree) {
  if (isLeaf(tree)) return tree.line;
  return Object.values(tree || {}).reduce((least, value) => Math.min(least, typeof value === "object" ? lineOf(value) : Infinity), Infinity);
}

// Entries of a table as the text has them.
const inOrder = (tree) => Object.entries(tree || {}).sort(([, one], [, other]) => lineOf(one) - lineOf(other));

// Fields of all leaves of a table, however deep: [[path, typed]].
function leavesOf(tree, path = []) {
  if (isLeaf(tree)) return [[path, tree["="]]];
  if (Array.isArray(tree) || tree === null || typeof tree !== "object") return [];
  return inOrder(tree).flatMap(([name, value]) => leavesOf(value, [...path, name]));
}

// Keys whose values are picked from lists: bearings of the catalogue, materials known by name.
const pickers = { name: "bearings", material: "materials" };

// The schema of what a path leads to.
function schemaAt(schema, path) {
  let node = schema;
  for (const step of path) {
    if (!node) return null;
    if (node.anyOf) node = node.anyOf.find((one) => one.type === "array" || one.properties) || node.anyOf[0];
    node = typeof step === "number" ? node.items : (node.properties || {})[step];
  }
  return node;
}

function keyOfSchema(schema, name) {
  const own = schema || {};
  const plain = own.anyOf ? own.anyOf[0] : own;
  const example = (own.examples || [])[0];
  return { name, words: own.enum || plain.enum || [], doc: own.description || "", example: example === undefined ? "" : typeof example === "string" ? example : JSON.stringify(example) };
}

// Forms of a file. `act` has edit(path, value), add(path, keys), remove(path).
function formsOf(table, act) {
  const fields = new Map();
  const sections = new Map();
  const node = el("div", { class: "forms" });
  const lists = el("div", { class: "lists" });
  const filter = el("input", { type: "search", class: "filter", placeholder: "find a key ( / )", "aria-label": "Find a key" });
  const own = (path, key) => {
    const name = pathText(path);
    if (!fields.has(name)) fields.set(name, field(path, key, act.edit));
    return fields.get(name);
  };
  for (const section of table.sections) {
    const rows = section.keys.filter((key) => key.name !== "format" && key.path !== "system").map((key) => {
      const list = key.path === "bearing.name" ? pickers.name : null;
      return own(key.path.split("."), { ...key, list }).node;
    });
    if (!rows.length) continue;
    const box = el("details", { class: "section" }, el("summary", {}, el("b", {}, section.path || "file"), el("span", { class: "about" }, section.path ? section.doc : "")), rows);
    sections.set(section.path, box);
    node.append(box);
  }
  const find = () => {
    const wanted = filter.value.toLowerCase().split(/[\s_.]+/).filter(Boolean);
    for (const box of node.querySelectorAll(".section")) {
      let any = false;
      for (const row of box.querySelectorAll(".field")) {
        const own = `${row.dataset.path} ${row.querySelector("label").title}`.toLowerCase();
        const hit = wanted.every((word) => own.includes(word));
        row.classList.toggle("missed", !hit);
        any = any || (hit && !row.classList.contains("idle"));
      }
      box.classList.toggle("missed", wanted.length > 0 && !any);
      if (wanted.length && any) box.open = true;
    }
  };
  filter.addEventListener("input", find);
  node.append(lists);

  // Rows of a list of tables: the keys that each gives, those that it may have, and the way to take it out.
  const ofList = (path, list, keys, about) => {
    const several = Array.isArray(list);
    // a table of its own beside a list of its kind, such as a rotor with a single disk
    const cards = (several ? list : [list]).map((one, k) => {
      const at = several ? [...path, k] : path;
      const given = leavesOf(one);
      const rows = given.map(([inner, typed]) => {
        const whole = [...at, ...inner];
        const key = keys.find((known) => known.inner === pathText(inner)) || { name: pathText(inner), doc: "", words: [] };
        const row = own(whole, { ...key, name: pathText(inner), list: pickers[inner[inner.length - 1]] && (inner.length > 1 || inner[0] === "material") ? pickers[inner[inner.length - 1]] : null });
        row.show({ typed });
        return row.node;
      });
      const left = keys.filter((key) => !given.some(([inner]) => pathText(inner) === key.inner));
      const more = el("select", { "aria-label": "Add a key", onchange: (event) => {
        const key = keys.find((known) => known.inner === event.target.value);
        if (key) act.edit([...at, ...key.inner.split(".")], key.example || "");
      } }, el("option", { value: "" }, "+ key"), left.map((key) => el("option", { value: key.inner, title: key.doc }, words(key.inner))));
      const title = isLeaf(one.name) ? one.name["="] : several ? k + 1 : "";
      return el("div", { class: "card" }, el("div", { class: "card-head" }, el("b", {}, title), left.length ? more : null, several ? button("×", () => act.remove(at), { class: "remove", "aria-label": `Remove ${pathText(path)} ${title}` }) : null), rows);
    });
    const start = () => act.add(path, about.start || keys.filter((key) => key.required).map((key) => [key.inner, key.example]));
    return el("details", { class: "section", open: state.layout[`open:${pathText(path)}`] ?? cards.length > 0, ontoggle: (event) => keepLayout({ [`open:${pathText(path)}`]: event.target.open }) }, el("summary", {}, el("b", {}, several ? `${pathText(path)} (${cards.length})` : pathText(path)), el("span", { class: "about" }, about.doc || "")), el("div", { class: "cards" }, cards), several ? button(`+ ${words(path[path.length - 1])}`, start, { class: "add" }) : null);
  };

  // Everything of a text that no table of keys names: by its schema.
  const byScheme = (tree, path) => inOrder(tree).map(([name, value]) => {
    const at = [...path, name];
    const scheme = schemaAt(table.schema, at);
    if (isLeaf(value)) {
      if (name === "format") return null;
      const row = own(at, keyOfSchema(scheme, pathText(at)));
      row.show({ typed: value["="] });
      return row.node;
    }
    const properties = Array.isArray(value) ? (schemaAt(table.schema, [...at, 0]) || {}).properties : (scheme || {}).properties;
    const keys = Object.entries(properties || {}).map(([inner, one]) => ({ inner, ...keyOfSchema(one, inner) }));
    return ofList(at, value, keys, { doc: (scheme || {}).description });
  });

  const listsOf = (tree) => {
    if (!table.sections.length) return byScheme(tree, []);
    const parts = table.parts.map((part) => {
      const path = part.path.split(".");
      const list = typedAt(tree, path);
      const keys = part.keys.map((key) => ({ ...key, inner: key.name }));
      return ofList(path, list === undefined || isLeaf(list) ? [] : list, keys, { ...part, start: part.start.length ? part.start : null });
    });
    const bearings = tree.auxiliary_bearing;
    const each = table.sections.filter((section) => /^(contact|mount|bearing)/.test(section.path)).flatMap((section) => section.keys.map((key) => ({ ...key, inner: key.path })));
    const name = { inner: "name", name: "name", doc: "Its name, in results and messages.", words: [], example: "drive_end" };
    const rest = ["limit", "measured"].filter((word) => Array.isArray(tree[word]) || (word === "limit" && (table.schema.properties || {}).limit));
    return [
      ...parts,
      Array.isArray(bearings) ? ofList(["auxiliary_bearing"], bearings, [name, ...each], { doc: "Auxiliary bearings that differ.", start: [["name", `bearing_${bearings.length + 1}`]] }) : null,
      ...rest.map((word) => {
        const items = (schemaAt(table.schema, [word, 0]) || {}).properties || {};
        const keys = Object.entries(items).map(([inner, one]) => ({ inner, ...keyOfSchema(one, inner) }));
        const start = word === "limit" ? table.limit : null;
        return ofList([word], tree[word] || [], keys, { doc: ((table.schema.properties || {})[word] || {}).description, start });
      }),
    ];
  };

  let shape = "";
  let lastValues = [];
  let lastTree = {};
  return {
    node: el("div", { class: "form-side" }, el("div", { class: "form-tools" }, filter), node),
    filter,
    // Fields after a check that could read the text; those of a text that cannot be read keep what they have.
    show({ typed: tree, values, problem, forced }) {
      // beside a mistake the values from before it
      lastValues = values || lastValues;
      lastTree = tree || lastTree;
      const held = new Map(lastValues.filter((value) => !value.bearing).map((value) => [value.path, value]));
      for (const value of lastValues) if (value.bearing && !held.has(value.path)) held.set(value.path, value);
      const active = document.activeElement && document.activeElement.closest(".field");
      // rows are put in anew only where keys came or were taken out
      const now = JSON.stringify(tree, (name, value) => (name === "=" || name === "line" ? 0 : value));
      if (now !== shape) {
        shape = now;
        const [focus, at] = active && lists.contains(active) ? [active.dataset.path, document.activeElement.selectionStart] : [null, 0];
        for (const path of [...fields.keys()]) if (lists.contains(fields.get(path).node)) fields.delete(path);
        lists.replaceChildren(...listsOf(tree).filter(Boolean));
        if (focus && fields.has(focus)) {
          const { input } = fields.get(focus);
          input.focus();
          if (input.setSelectionRange) input.setSelectionRange(at, at);
        }
      }
      for (const [name, row] of fields) {
        row.wait(false);
        const value = typedAt(tree, row.node.dataset.path.split("."));
        const leaf = isLeaf(value) ? value : undefined;
        const known = held.get(name);
        if (lists.contains(row.node)) {
          const inList = typedAt(tree, name.split("."));
          row.show({ typed: isLeaf(inList) ? inList["="] : undefined, note: leaf && (leaf.source || leaf.assumed), mark: leaf && leaf.assumed ? "assumed" : "", forced });
        } else {
          row.show({ typed: leaf && !leaf.from ? leaf["="] : undefined, held: known ? known.text : leaf && leaf["="], mark: known && known.text ? known.mark : "", note: known ? known.note : "", forced });
          // a key without a meaning now stands aside
          if (values) row.node.classList.toggle("idle", !known && leaf === undefined);
        }
        row.wrong("");
      }
      for (const box of sections.values()) {
        box.hidden = !box.querySelector(".field:not(.idle)");
        if (box.dataset.shown === undefined) {
          box.dataset.shown = "";
          box.open = Boolean(box.querySelector(".given"));
        }
      }
      this.fault(problem);
      find();
    },
    fault(problem) {
      if (!problem || !problem.key) return false;
      const pathOf = (one) => one.node.dataset.path;
      // a value that all bearings share has its mistake in one of them
      const onLine = (one) => {
        const own = typedAt(lastTree, pathOf(one).split("."));
        return isLeaf(own) && own.line === problem.line;
      };
      const all = [...fields.values()];
      const row = fields.get(problem.key) || all.find((one) => pathOf(one).replace(/\.(\d+)\./g, (_, k) => `.${Number(k) + 1}.`) === problem.key) || all.find(onLine);
      if (!row) return false;
      row.wrong(problem.message);
      const box = row.node.closest("details");
      if (box) {
        box.hidden = false;
        box.open = true;
      }
      row.node.classList.remove("idle");
      return true;
    },
    // What was typed just now is a change before anything else happens.
    flush() {
      for (const row of fields.values()) row.flush();
    },
    wait() {
      for (const row of fields.values()) row.wait(true);
    },
    reveal(path) {
      const row = fields.get(path);
      if (!row) return false;
      row.node.classList.remove("idle", "missed");
      const box = row.node.closest("details");
      if (box) [box.open, box.hidden] = [true, false];
      row.node.scrollIntoView({ block: "center" });
      row.input.focus();
      row.node.classList.add("asked");
      return true;
    },
  };
}
