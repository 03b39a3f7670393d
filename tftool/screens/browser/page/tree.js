// @ts-check
// The nested list of frames. Names go in by textContent and no other way.

export class Tree {
  /** Handlers: choose(name), toggle(name, shown), fold(name, closed), solid(name, shown). */
  constructor(list, handlers) {
    this.list = list;
    this.handlers = handlers;
    this.rows = [];
  }

  build(model, state) {
    this.model = model;
    this.rows = new Array(model.names.length);
    const seen = new Set();
    const items = new Map();
    const make = (index) => {
      seen.add(index);
      const item = this.item(index, state);
      items.set(index, item);
      return item;
    };
    const roots = [...model.roots, ...model.looped].map(make);
    // Level by level, not by recursion: a chain may be thousands of frames long.
    for (const index of model.order) {
      const children = model.children[index].filter((child) => !seen.has(child));
      if (!children.length) continue;
      const below = document.createElement("ul");
      below.setAttribute("role", "group");
      below.append(...children.map(make));
      items.get(index).append(below);
    }
    this.list.replaceChildren(...roots);
  }

  item(index, state) {
    const { model } = this;
    const name = model.names[index];
    const item = document.createElement("li");
    item.setAttribute("role", "treeitem");
    const row = document.createElement("div");
    row.className = "row";
    const fold = document.createElement("button");
    fold.className = "fold";
    fold.tabIndex = -1;
    if (model.children[index].length) {
      const closed = state.closed.has(name);
      item.classList.toggle("closed", closed);
      fold.textContent = closed ? "▶" : "▼";
      fold.title = "Open or close";
      fold.onclick = (event) => {
        event.stopPropagation();
        const now = item.classList.toggle("closed");
        fold.textContent = now ? "▶" : "▼";
        this.handlers.fold(name, now);
      };
    }
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = !state.hidden.has(name);
    box.title = "Show this frame";
    box.onclick = (event) => event.stopPropagation();
    box.onchange = () => this.handlers.toggle(name, box.checked);
    const label = document.createElement("span");
    label.className = "name";
    label.textContent = name;
    label.title = name;
    const told = document.createElement("span");
    told.className = "told";
    if (model.parents[index] >= 0 && model.statics[index]) {
      told.classList.add("still");
      told.textContent = "static";
    }
    const solid = document.createElement("button");
    solid.className = "solid plain";
    solid.textContent = "◆";
    solid.hidden = true;
    solid.onclick = (event) => {
      event.stopPropagation();
      this.handlers.solid(name, state.bare.has(name));
    };
    row.append(fold, box, label, solid, told);
    row.onclick = () => this.handlers.choose(name);
    row.tabIndex = 0;
    row.onkeydown = (event) => {
      if (event.target === row && event.key === "Enter") this.handlers.choose(name);
    };
    item.append(row);
    this.rows[index] = { row, box, told, solid };
    return item;
  }

  /** Refresh what changes with time; `frames[index]`: { lost, grey, trouble, told }; `links.has(name)`. */
  refresh(frames, state, links) {
    this.rows.forEach(({ row, box, told, solid }, index) => {
      const frame = frames[index];
      const name = this.model.names[index];
      const shown = !state.hidden.has(name);
      if (box.checked !== shown) box.checked = shown;
      row.classList.toggle("off", !shown || frame.filtered);
      row.classList.toggle("lost", frame.lost);
      row.classList.toggle("grey", frame.grey > 0);
      row.classList.toggle("chosen", state.chosen === name);
      row.title = frame.trouble;
      solid.hidden = !links.has(name);
      solid.title = state.bare.has(name) ? "Draw this link" : "Do not draw this link";
      solid.setAttribute("aria-pressed", String(!state.bare.has(name)));
      if (!told.classList.contains("still") && told.textContent !== frame.told) told.textContent = frame.told;
    });
  }
}
