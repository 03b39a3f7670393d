// @ts-check
// Names that match typed text.

/**
 * Score of a name for typed text, smaller is better; null if it does not match.
 * @param {string} name
 * @param {string} typed in small letters
 */
function fit(name, typed) {
  const small = name.toLowerCase();
  if (small === typed) return 0;
  const at = small.indexOf(typed);
  if (at === 0) return 1;
  // At the beginning of a word, as "link" in "laser_link".
  if (at > 0 && /[^a-z0-9]/.test(small[at - 1])) return 2;
  if (at > 0) return 3;
  // The letters in order, as "lslk" in "laser_link".
  let place = 0;
  for (const letter of small) if (letter === typed[place]) place++;
  return place === typed.length ? 4 : null;
}

/**
 * Names that match typed text, best first; all if nothing was typed.
 * @param {string[]} names
 * @param {string} typed
 * @returns {string[]}
 */
export function offered(names, typed) {
  const wanted = typed.trim().toLowerCase();
  if (!wanted) return names;
  return names
    .map((name, order) => ({ name, order, rank: fit(name, wanted) }))
    .filter(({ rank }) => rank !== null)
    .sort((one, other) => Number(one.rank) - Number(other.rank) || one.order - other.order)
    .map(({ name }) => name);
}
