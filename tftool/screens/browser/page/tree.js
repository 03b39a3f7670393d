// @ts-check
// The nested list of frames. Names are set by textContent only.
import { halves, stillness } from "./format.js";
import { kept, led, listed } from "./outline.js";

export class Tree {
  /**
   * @param {any} list
   * @param {{
   *   choose(name: string): void, fly(name: string): void, hover(name: string | undefined): void,
   *   toggle(name: string, shown: boolean): void, fold(name: string, closed: boolean): void,
   *   solid(name: string, shown: boolean): void,
   * }} handlers
   */
  constructor(list, handlers) {
    this.list = list;
    this.handlers = handlers;
    /** @type {any[]} */
    this.rows = [];
    this.filtered = ""; // inputs of the last choice of visible rows
    /** @type {Set<number>} */
    this.kept = new Set();
    this.current = -1; // the only row that is a tab stop
    list.addEventListener("keydown", (event) => this.press(event));
    list.addEventListener("pointerleave", () => handlers.hover(undefined));
  }

  build(model, state) {
    const before = this.model?.names[this.current];
    const held = this.list.contains(document.activeElement);
    this.model = model;
    this.state = state;
    this.filtered = "";
    this.kept = new Set(model.names.keys()); // a key may come before the first refresh
    this.rows = new Array(model.names.length);
    const below = new Map(); // element of a frame's children
    const roots = [];
    this.order = listed(model);
    for (const { index, level } of this.order) {
      const item = this.item(index, level);
      const group = below.get(level === 1 ? -1 : model.parents[index]);
      if (group) group.append(item);
      else roots.push(item);
      if (model.children[index].length) {
        const list = document.createElement("ul");
        list.setAttribute("role", "group");
        item.append(list);
        below.set(index, list);
      }
    }
    this.list.replaceChildren(...roots);
    this.current = -1;
    this.stop(model.index.get(before) ?? this.order[0]?.index ?? -1);
    if (held) this.rows[this.current]?.item.focus();
  }

  item(index, level) {
    const { model, state } = this;
    const name = model.names[index];
    const item = document.createElement("li");
    item.setAttribute("role", "treeitem");
    item.setAttribute("aria-level", String(level));
    item.setAttribute("aria-selected", "false");
    item.tabIndex = -1;
    const row = document.createElement("div");
    row.className = "row";
    const fold = document.createElement("span");
    fold.className = "fold";
    fold.setAttribute("aria-hidden", "true");
    if (model.children[index].length) {
      fold.title = "Open or close";
      fold.onclick = (event) => {
        event.stopPropagation();
        this.open(index, item.classList.contains("closed"));
      };
    }
    const box = document.createElement("input");
    box.type = "checkbox";
    box.tabIndex = -1;
    box.checked = !state.hidden.has(name);
    box.title = "Show this frame";
    box.setAttribute("aria-label", `Show ${name}`);
    box.onclick = (event) => event.stopPropagation();
    box.onchange = () => this.handlers.toggle(name, box.checked);
    const swatch = document.createElement("span");
    swatch.className = "swatch";
    const label = document.createElement("span");
    label.className = "name";
    label.title = name;
    for (const part of halves(name)) {
      const half = document.createElement("span");
      half.textContent = part;
      label.append(half);
    }
    const told = document.createElement("span");
    told.className = "told";
    if (model.parents[index] >= 0 && model.statics[index]) {
      told.classList.add("still");
      told.textContent = stillness(model.statics[index]);
    }
    const solid = document.createElement("button");
    solid.className = "solid plain";
    solid.tabIndex = -1;
    solid.hidden = true;
    solid.onclick = (event) => {
      event.stopPropagation();
      this.handlers.solid(name, state.bare.has(name));
    };
    row.append(fold, box, swatch, label, solid, told);
    row.onclick = () => {
      this.stop(index);
      this.handlers.choose(name);
    };
    row.ondblclick = () => this.handlers.fly(name);
    row.onpointerenter = () => this.handlers.hover(name);
    item.append(row);
    this.rows[index] = { item, row, box, told, solid, fold, swatch };
    if (model.children[index].length) this.open(index, !state.closed.has(name), false);
    return item;
  }

  /** Open or close the rows below a frame. */
  open(index, open, tell = true) {
    const { item, fold } = this.rows[index];
    item.classList.toggle("closed", !open);
    item.setAttribute("aria-expanded", String(open));
    fold.textContent = open ? "▼" : "▶";
    if (tell) this.handlers.fold(this.model.names[index], !open);
  }

  /** Make a row the only row that the Tab key reaches. */
  stop(index) {
    if (this.rows[this.current]) this.rows[this.current].item.tabIndex = -1;
    this.current = index;
    if (this.rows[index]) this.rows[index].item.tabIndex = 0;
  }

  /** The frames whose rows can be seen, from top to bottom. */
  visible() {
    const { parents } = this.model;
    const hidden = new Set();
    return (this.order ?? [])
      .filter(({ index, level }) => {
        const above = level === 1 ? -1 : parents[index];
        const under = above >= 0 && (hidden.has(above) || this.rows[above].item.classList.contains("closed"));
        if (under || !this.kept.has(index)) hidden.add(index);
        return !hidden.has(index);
      })
      .map(({ index }) => index);
  }

  press(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || !this.rows[this.current]) return;
    const { model, current } = this;
    const name = model.names[current];
    const { item, box } = this.rows[current];
    if (event.key === "Enter") this.handlers.choose(name);
    else if (event.key === " ") box.click();
    else {
      const way = led(event.key, current, {
        visible: this.visible(),
        parents: model.parents,
        opened: (index) =>
          model.children[index].length ? !this.rows[index].item.classList.contains("closed") : null,
      });
      if (way === null) return;
      if (way.open !== undefined) this.open(current, way.open);
      if (way.go !== undefined) {
        this.stop(way.go);
        this.rows[way.go].item.focus();
        this.handlers.hover(model.names[way.go]);
      }
    }
    event.preventDefault();
    event.stopPropagation();
    if (!item.isConnected) this.rows[this.current]?.item.focus();
  }

  /** Hide the rows that a filter leaves out. */
  filter(frames) {
    const key = frames.map(({ filtered }) => Number(filtered)).join("");
    if (key === this.filtered) return;
    this.filtered = key;
    this.kept = kept(this.model, (index) => !frames[index].filtered);
    this.rows.forEach(({ item }, index) => (item.hidden = !this.kept.has(index)));
    if (!this.kept.has(this.current)) this.stop(this.visible()[0] ?? -1);
  }

  /** Highlight the row of one frame. */
  light(name) {
    this.rows.forEach(({ row }, index) => row.classList.toggle("lit", this.model.names[index] === name));
  }

  /**
   * Refresh values that change with time; `frames[index]`: { lost, grey, trouble, told, late, color };
   * `links.has(name)`.
   */
  refresh(frames, state, links) {
    if (frames.length !== this.rows.length) return;
    this.filter(frames);
    this.rows.forEach(({ item, row, box, told, solid, swatch }, index) => {
      const frame = frames[index];
      const name = this.model.names[index];
      const shown = !state.hidden.has(name);
      const chosen = state.chosen === name;
      if (box.checked !== shown) box.checked = shown;
      const looks = `row${!shown || frame.filtered ? " off" : ""}${frame.lost ? " lost" : ""}${
        frame.grey > 0 ? " grey" : ""}${chosen ? " chosen" : ""}${row.classList.contains("lit") ? " lit" : ""}`;
      if (row.className !== looks) row.className = looks;
      if (item.getAttribute("aria-selected") !== String(chosen)) item.setAttribute("aria-selected", String(chosen));
      if (row.title !== frame.trouble) row.title = frame.trouble;
      if (swatch.dataset.color !== frame.color) swatch.style.background = swatch.dataset.color = frame.color;
      const solidShown = links.has(name);
      if (solid.hidden === solidShown) solid.hidden = !solidShown;
      if (solidShown) {
        const drawn = !state.bare.has(name);
        if (solid.getAttribute("aria-pressed") !== String(drawn)) {
          solid.title = drawn ? "Do not draw this link" : "Draw this link";
          solid.textContent = drawn ? "◆" : "◇";
          solid.setAttribute("aria-pressed", String(drawn));
        }
      }
      if (!told.classList.contains("still")) {
        if (told.textContent !== frame.told) told.textContent = frame.told;
        if (told.dataset.late !== frame.late) told.dataset.late = frame.late;
      }
    });
  }
}
