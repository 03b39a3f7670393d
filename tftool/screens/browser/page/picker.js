// @ts-check
// A field for the name of a frame, with matching names below it.
import { offered } from "./match.js";

const MOST = 100; // names shown at once; the user finds further names by typing

export class Picker {
  /** All names, for all pickers. @type {string[]} */
  static names = [];

  /**
   * @param {any} field
   * @param {any} list element for the names, shared by all pickers
   * @param {(name: string) => void} choose called with the chosen name; "" for no frame
   * @param {boolean} optional whether the field may be empty
   */
  constructor(field, list, choose, optional) {
    this.field = field;
    this.list = list;
    this.choose = choose;
    this.optional = optional;
    this.current = "";
    this.at = 0; // number of the offered name that Enter chooses
    /** @type {string[]} */
    this.offers = [];
    for (const [key, value] of Object.entries({
      role: "combobox", autocomplete: "off", spellcheck: "false", placeholder: "type a name…",
      "aria-expanded": "false", "aria-controls": list.id, "aria-autocomplete": "list",
    })) field.setAttribute(key, value);
    field.addEventListener("focus", () => this.open());
    field.addEventListener("click", () => this.open());
    field.addEventListener("input", () => this.offer(field.value));
    field.addEventListener("blur", () => this.close());
    field.addEventListener("keydown", (event) => this.press(event));
  }

  get value() {
    return this.current;
  }

  set value(name) {
    this.current = name;
    this.field.title = name;
    if (!this.isOpen) this.field.value = name;
  }

  get isOpen() {
    return this.field.getAttribute("aria-expanded") === "true";
  }

  open() {
    if (this.isOpen) return;
    this.field.setAttribute("aria-expanded", "true");
    this.field.select();
    this.offer("");
  }

  close() {
    if (!this.isOpen) return;
    this.field.setAttribute("aria-expanded", "false");
    this.field.removeAttribute("aria-activedescendant");
    this.field.value = this.current;
    this.list.hidden = true;
  }

  /** Show the names that match, best first. */
  offer(typed) {
    if (!this.isOpen) this.field.setAttribute("aria-expanded", "true");
    const found = offered(Picker.names, typed);
    this.offers = found.slice(0, MOST);
    if (this.optional && !typed && this.current) this.offers.push("");
    this.at = Math.max(0, this.offers.indexOf(typed ? typed : this.current));
    const lines = this.offers.map((name, place) => {
      const line = document.createElement("li");
      line.id = `offer-${place}`;
      line.setAttribute("role", "option");
      line.textContent = name || "none";
      line.title = name;
      line.onpointerdown = (event) => {
        event.preventDefault(); // the field keeps the focus until a name is chosen
        this.take(name);
      };
      return line;
    });
    const over = found.length - Math.min(found.length, MOST);
    if (over || !lines.length) {
      const line = document.createElement("li");
      line.className = "more";
      line.textContent = over ? `${over} more: type to find them` : "no frame has that name";
      line.onpointerdown = (event) => event.preventDefault();
      lines.push(line);
    }
    this.list.replaceChildren(...lines);
    this.place();
    this.mark();
  }

  /** Place the list below the field, or above the field if there is more room. */
  place() {
    const { left, bottom, top, width } = this.field.getBoundingClientRect();
    const { style } = this.list;
    this.list.hidden = false;
    const wide = Math.min(innerWidth - 16, Math.max(width, 220));
    style.width = `${wide}px`;
    style.left = `${Math.max(8, Math.min(left, innerWidth - wide - 8))}px`;
    const below = innerHeight - bottom - 12;
    const above = top - 12;
    const under = below >= Math.min(240, above);
    style.maxHeight = `${Math.min(360, under ? below : above)}px`;
    style.top = under ? `${bottom + 4}px` : "auto";
    style.bottom = under ? "auto" : `${innerHeight - top + 4}px`;
  }

  mark() {
    this.offers.forEach((_, place) => {
      const line = this.list.children[place];
      line.setAttribute("aria-selected", String(place === this.at));
      if (place !== this.at) return;
      this.field.setAttribute("aria-activedescendant", line.id);
      line.scrollIntoView({ block: "nearest" });
    });
  }

  take(name) {
    this.current = name;
    this.field.blur();
    this.choose(name);
  }

  press(event) {
    const { offers } = this;
    if (event.key === "Escape") this.field.blur();
    else if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      if (!this.isOpen) this.open();
      else if (offers.length) {
        this.at = (this.at + (event.key === "ArrowDown" ? 1 : -1) + offers.length) % offers.length;
        this.mark();
      }
    } else if (event.key === "Enter") {
      if (this.isOpen && offers.length) this.take(offers[this.at]);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
