// @ts-check
// Placement of names beside their frames; a name is moved aside if another name covers its place.

const CELL = 8; // pixels
const GAP = 2; // pixels between two names

/**
 * @typedef {{ x: number, y: number, width: number, height: number, first?: boolean, was?: number }} Wanted
 *   x, y: the frame's pixel; width, height: of the name; first: always placed;
 *   was: place in the previous picture
 * @typedef {{ left: number, top: number, place: number, moved: boolean }} Stand
 *   place: number of the place, for the next picture; moved: needs a line to its frame
 */

/** Places around a frame: shifts of the name's middle, in units of its half size, below first. */
const PLACES = [[0, 1, 9], [0, -1, 9], [1, 0, 10], [-1, 0, 10]];
for (const ring of [24, 40, 58, 80]) {
  for (let step = 0; step < 8; step++) {
    const angle = Math.PI / 2 + ((step % 2 ? -1 : 1) * Math.ceil(step / 2) * Math.PI) / 4;
    PLACES.push([Math.cos(angle), Math.sin(angle), ring]);
  }
}
/** Number of names above which no name is moved far away. */
export const MANY = 80;
const FEW = 12;
const NEAREST = 4; // number of places that need no line to the frame

/** @param {number[]} one left, top, width and height @param {number[]} other */
export function overlap([left, top, width, height], other) {
  return left < other[0] + other[2] && other[0] < left + width && top < other[1] + other[3] && other[1] < top + height;
}

class Grid {
  /** @param {{ width: number, height: number }} picture */
  constructor({ width, height }) {
    this.width = width;
    this.height = height;
    /** @type {Set<number>} */
    this.taken = new Set();
  }

  *cells(left, top, width, height) {
    const last = { x: Math.floor((left + width + GAP) / CELL), y: Math.floor((top + height) / CELL) };
    for (let x = Math.floor((left - GAP) / CELL); x <= last.x; x++) {
      for (let y = Math.floor(top / CELL); y <= last.y; y++) yield x * 65_536 + y;
    }
  }

  free(...box) {
    const [left, top, width, height] = box;
    if (left < 0 || top < 0 || left + width > this.width || top + height > this.height) return false;
    for (const cell of this.cells(...box)) if (this.taken.has(cell)) return false;
    return true;
  }

  take(...box) {
    for (const cell of this.cells(...box)) this.taken.add(cell);
  }
}

/**
 * A name at one of the places.
 * @param {Wanted} wanted
 * @param {number} place
 * @returns {Stand}
 */
export function standAt({ x, y, width, height }, place) {
  const [right, down, far] = PLACES[place];
  const left = Math.round(x + right * (far + width / 2) - width / 2);
  return { left, top: Math.round(y + down * (far + height / 2) - height / 2), place, moved: place >= NEAREST };
}

/**
 * Give every name a place in the picture, in the order of the list; null if no place is free.
 * @param {Wanted[]} wanted
 * @param {{ width: number, height: number }} picture
 * @param {number[][]} [reserved] left, top, width and height of areas that no name may cover
 * @returns {(Stand | null)[]}
 */
export function arrange(wanted, picture, reserved = []) {
  const grid = new Grid(picture);
  for (const box of reserved) grid.take(...box);
  const places = wanted.length > MANY ? FEW : PLACES.length;
  return wanted.map((one) => {
    const { width, height, first, was } = one;
    const stand = (place) => standAt(one, place);
    // A name keeps a good place, because jumping names cannot be read.
    for (let turn = was ? -1 : 0; turn < places; turn++) {
      const place = turn < 0 ? (was ?? 0) : turn;
      const found = stand(place);
      if (!grid.free(found.left, found.top, width, height)) continue;
      grid.take(found.left, found.top, width, height);
      return found;
    }
    if (!first) return null;
    const found = stand(0);
    grid.take(found.left, found.top, width, height);
    return found;
  });
}
