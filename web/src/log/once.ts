/** Makes a value for each key once: what is worked out of a run is worked out when it is first drawn. */
export function once<K extends object, V>(make: (key: K) => V): (key: K) => V {
  const made = new WeakMap<K, { value: V }>();
  return (key) => {
    let held = made.get(key);
    if (!held) {
      held = { value: make(key) };
      made.set(key, held);
    }
    return held.value;
  };
}
