// @ts-check
// The user's choices: switches, frames, filters, numbers. The page's address contains all of them.

/** Limits of the numbers that the user can type. */
export const LIMITS = { interval: [0, 60], timeout: [1, 1e6], length: [1, 60], side: [180, 640] };

/** Quantities of the pair that can be plotted. */
export const PLOTTED = ["xyz", "distance", "rpy", "none"];

/** Views: three without perspective, and one that turns. */
export const VIEWS = ["top", "side", "front", "orbit"];

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

/**
 * Parse a name filter: the expression, null for an empty field, or the fault.
 * @param {string} text
 * @returns {{ expression: RegExp | null, error: string }}
 */
export function compile(text) {
  try {
    return { expression: text ? new RegExp(text, "u") : null, error: "" };
  } catch (error) {
    return { expression: null, error: error instanceof Error ? error.message : String(error) };
  }
}

export class Choices {
  /**
   * @param {Record<string, any>} given choices in the address, as `share.read` returns them
   * @param {"light" | "dark"} theme the theme this person's system prefers
   */
  constructor(given = {}, theme = "dark") {
    this.names = given.names ?? true;
    this.axes = given.axes ?? true;
    this.arrows = given.arrows ?? true;
    this.grid = given.grid ?? true;
    // opening.js chooses the values that the user has not chosen.
    this.byHand = {
      trails: given.trails !== undefined,
      whole: given.whole !== undefined || given.length !== undefined,
      view: given.view !== undefined,
      pair: given.pair === "none" || given.target !== undefined || given.source !== undefined,
    };
    this.trails = given.trails ?? false;
    this.visuals = given.visuals ?? true; // of the robot
    this.collisions = given.collisions ?? false;
    this.jointaxes = given.jointaxes ?? false;
    this.through = given.through ?? true; // whether axes are visible through solids
    this.opacity = Math.min(1, Math.max(0.1, given.opacity ?? 1));
    this.view = VIEWS.includes(given.view) ? given.view : "top";
    this.theme = given.theme === "light" || given.theme === "dark" ? given.theme : theme;
    this.interval = 0; // seconds
    this.timeout = 15; // seconds
    this.length = 10; // duration of trails, seconds
    this.whole = given.whole ?? false; // whether trails show the whole history
    /** @type {number | undefined} */
    this.side = undefined; // width of the list of frames, pixels; undefined: fits the names
    for (const id of Object.keys(LIMITS)) this.setNumber(id, given[id]);
    this.plot = PLOTTED.includes(given.plot) ? given.plot : "xyz";
    this.speed = SPEEDS.includes(given.speed) ? given.speed : 1;
    /** @type {number | undefined} */
    this.scale = given.scale; // of the markers; undefined: by the size of the scene
    /** @type {string | undefined} */
    this.fixed = given.fixed; // the current fixed frame
    /** @type {string | undefined} */
    this.wanted = given.fixed; // the fixed frame that the user has chosen
    /** @type {string | undefined} */
    this.target = given.target;
    /** @type {string | undefined} */
    this.source = given.source;
    /** @type {string | undefined} */
    this.chosen = given.chosen;
    /** @type {string | undefined} */
    this.followed = given.followed; // the frame that the camera follows
    this.hidden = new Set(given.hidden);
    this.closed = new Set(given.closed);
    this.trailed = new Set(given.trailed);
    this.bare = new Set(given.bare); // frames whose link is not drawn
    this.undrawn = new Set(given.undrawn); // topics that are not drawn
    this.only = "";
    this.not = "";
    /** @type {{ only: RegExp | null, not: RegExp | null }} */
    this.filters = { only: null, not: null };
    for (const id of ["only", "not"]) this.setFilter(id, given[id] ?? "");
  }

  /**
   * Set a number, moved into the permitted limits; ignore a value that is not a number.
   * @param {string} id
   * @param {number | undefined} value
   */
  setNumber(id, value) {
    const [least, most] = LIMITS[id];
    if (value !== undefined && Number.isFinite(value)) this[id] = Math.min(most, Math.max(least, value));
  }

  /**
   * Filter names by a regular expression; if the expression is invalid, the last valid one stays.
   * @param {string} id `only` or `not`
   * @param {string} text
   * @returns {string} what is wrong with the text; empty if it is valid
   */
  setFilter(id, text) {
    const { expression, error } = compile(text);
    this[id] = text;
    if (!error) this.filters[id] = expression;
    return error;
  }

  /**
   * Whether the filters leave a frame out.
   * @param {string} name
   */
  leavesOut(name) {
    const { only, not } = this.filters;
    return (only !== null && !only.test(name)) || (not !== null && not.test(name));
  }

  /** @param {string} name */
  setFixed(name) {
    this.fixed = this.wanted = name;
  }

  /**
   * Choose a fixed frame that exists: the user's choice, else the current one, else
   * the root of the largest tree.
   * @param {import("./model.js").Model} model
   * @returns {boolean} whether the fixed frame has changed
   */
  settleFixed(model) {
    const before = this.fixed;
    if (model.index.has(this.wanted)) this.fixed = this.wanted;
    else if (!model.index.has(before) && model.roots.length) this.fixed = model.biggestRoot();
    return this.fixed !== before;
  }

  /** The fixed frame that the user chose, while another is used because the chosen frame does not exist. */
  get missed() {
    return this.wanted === this.fixed ? undefined : this.wanted;
  }

  /**
   * @param {string | undefined} target
   * @param {string | undefined} source
   * @param {boolean} byHand whether the user has chosen the pair
   */
  setPair(target, source, byHand = true) {
    this.byHand.pair ||= byHand;
    this.target = target || undefined;
    this.source = source || undefined;
  }

  /**
   * Add a name to a set, or remove it.
   * @param {"hidden" | "closed" | "trailed" | "bare" | "undrawn"} set
   * @param {string} name
   * @param {boolean} on
   */
  mark(set, name, on) {
    if (on) this[set].add(name);
    else this[set].delete(name);
  }

  /**
   * All choices that the page's address contains, for `share.write`.
   * @param {number | null} at moment shown; null for the present
   * @param {number[] | undefined} camera undefined while the page moves the camera
   */
  shared(at, camera) {
    return {
      ...this,
      fixed: this.wanted ?? this.fixed,
      ...(this.byHand.trails ? {} : { trails: undefined }),
      ...(this.byHand.whole ? {} : { whole: undefined, length: undefined }),
      ...(this.byHand.view ? {} : { view: undefined }),
      ...(this.byHand.pair ? {} : { target: undefined, source: undefined }),
      pair: this.byHand.pair && !this.target && !this.source ? "none" : undefined,
      hidden: [...this.hidden],
      closed: [...this.closed],
      trailed: [...this.trailed],
      bare: [...this.bare],
      undrawn: [...this.undrawn],
      at: at ?? undefined,
      camera,
    };
  }
}
