// @ts-check
// Which names something typed may mean.

/**
 * How well a name fits what was typed, smaller is better; null where it does not.
 * @param {string} name
 * @param {string} typed in small letters
 */
function fit(name, typed) {
  const small = name.toLowerCase();
  if (small === typed) return 0;
  const at = small.indexOf(typed);
  if (at === 0) return 1;
  // Where a word begins, as "link" in "laser_link".
  if (at > 0 && /[^a-z0-9]/.test(small[at - 1])) return 2;
  if (at > 0) return 3;
  // The letters in their order, as "lslk" in "laser_link".
  let place = 0;
  for (const letter of small) if (letter === typed[place]) place++;
  return place === typed.length ? 4 : null;
}

/**
 * The names that fit what was typed, best first; all of them where nothing was.
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
