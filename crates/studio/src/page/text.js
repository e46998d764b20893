// The text of a file beside its forms: line numbers, marks, and changes that can be taken back.

// Changes within this time are one for undo, ms.
const ONE_CHANGE = 700;

function textEditor(changed) {
  const gutter = el("div", { class: "gutter", "aria-hidden": "true" });
  const area = el("textarea", { class: "toml", spellcheck: "false", autocomplete: "off", autocapitalize: "off", wrap: "off", "aria-label": "Text of the file" });
  const note = el("p", { class: "line-note", role: "alert" });
  let marked = 0;
  let lines = 0;
  const number = () => {
    const count = area.value.split("\n").length;
    if (count !== lines) {
      lines = count;
      gutter.replaceChildren(...Array.from({ length: count }, (_, k) => el("span", {}, k + 1)));
    }
    [...gutter.children].forEach((line, k) => line.classList.toggle("wrong", k + 1 === marked));
    gutter.scrollTop = area.scrollTop;
  };
  area.addEventListener("scroll", () => (gutter.scrollTop = area.scrollTop));
  area.addEventListener("input", () => {
    number();
    changed(area.value);
  });
  return {
    node: el("div", { class: "text" }, el("div", { class: "sheet" }, gutter, area), note),
    area,
    show(text) {
      if (area.value !== text) {
        const [at, top] = [area.selectionStart, area.scrollTop];
        area.value = text;
        area.setSelectionRange(at, at);
        area.scrollTop = top;
      }
      number();
    },
    mark(line, message) {
      marked = line;
      note.textContent = message || "";
      number();
    },
    reveal(line) {
      area.scrollTop = Math.max(0, (line - 6) * (area.scrollHeight / Math.max(lines, 1)));
    },
  };
}

// Texts that were, and that were taken back.
function history(first) {
  const past = [];
  let future = [];
  let now = first;
  let last = 0;
  return {
    get now() {
      return now;
    },
    get canUndo() {
      return past.length > 0;
    },
    get canRedo() {
      return future.length > 0;
    },
    change(text, typed = false) {
      if (text === now) return;
      const time = Date.now();
      if (!(typed && time - last < ONE_CHANGE && past.length)) past.push(now);
      last = typed ? time : 0;
      now = text;
      future = [];
    },
    undo() {
      if (past.length) {
        future.push(now);
        now = past.pop();
        last = 0;
      }
      return now;
    },
    redo() {
      if (future.length) {
        past.push(now);
        now = future.pop();
        last = 0;
      }
      return now;
    },
  };
}

// The lines from the first to the last in which two texts differ: [first, end in one, end in other].
function changedLines(one, other) {
  let first = 0;
  while (first < one.length && first < other.length && one[first] === other[first]) first += 1;
  let [a, b] = [one.length, other.length];
  while (a > first && b > first && one[a - 1] === other[b - 1]) [a, b] = [a - 1, b - 1];
  return [first, a, b];
}

// Both changes of a text in one, where they stand apart; null where both changed the same lines.
function merged(base, mine, theirs) {
  const [lines, own, foreign] = [base, mine, theirs].map((text) => text.split("\n"));
  const [mineFrom, mineTo, mineEnd] = changedLines(lines, own);
  const [from, to, end] = changedLines(lines, foreign);
  if (to < mineFrom) return [...foreign.slice(0, end), ...lines.slice(to, mineFrom), ...own.slice(mineFrom, mineEnd), ...lines.slice(mineTo)].join("\n");
  if (mineTo < from) return [...own.slice(0, mineEnd), ...lines.slice(mineTo, from), ...foreign.slice(from, end), ...lines.slice(to)].join("\n");
  return null;
}
