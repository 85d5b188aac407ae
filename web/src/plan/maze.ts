// A maze on a grid: every place is joined to every other by one way (a spanning tree, grown depth first).

/** Numbers from 0 to 1, the same for the same seed (mulberry32). */
function numbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** The cells in the middle of its first and its last room. */
export function mazeEnds(width: number, height: number, wide: number): [[number, number], [number, number]] {
  const far = (size: number): number => 1 + (wide + 1) * Math.max(0, Math.floor((size - 1) / (wide + 1)) - 1) + (wide >> 1);
  return [[1 + (wide >> 1), 1 + (wide >> 1)], [far(width), far(height)]];
}

/** Cells of a maze (1 is wall), row by row, with ways that are `wide` cells wide between walls of one cell. */
export function maze(width: number, height: number, wide: number, seed: number): Uint8Array {
  const cells = new Uint8Array(width * height).fill(1);
  const pitch = wide + 1;
  const [across, down] = [Math.floor((width - 1) / pitch), Math.floor((height - 1) / pitch)];
  if (across < 1 || down < 1) return cells.fill(0);
  const random = numbers(seed);
  /** Frees the cells of a room, or of a room and its way to the next one. */
  const carve = (x: number, y: number, w: number, h: number): void => { for (let v = y; v < y + h; ++v) cells.fill(0, v * width + x, v * width + x + w); };
  const seen = new Uint8Array(across * down);
  const stack = [0];
  seen[0] = 1;
  carve(1, 1, wide, wide);
  while (stack.length > 0) {
    const at = stack.at(-1)!;
    const [x, y] = [at % across, Math.floor(at / across)];
    const open = ([[1, 0], [-1, 0], [0, 1], [0, -1]] as const).filter(([dx, dy]) => {
      const [u, v] = [x + dx, y + dy];
      return u >= 0 && v >= 0 && u < across && v < down && !seen[v * across + u];
    });
    if (open.length === 0) {
      stack.pop();
      continue;
    }
    const [dx, dy] = open[Math.floor(random() * open.length)]!;
    const next = (y + dy) * across + x + dx;
    seen[next] = 1;
    const [left, low] = [1 + pitch * Math.min(x, x + dx), 1 + pitch * Math.min(y, y + dy)];
    carve(left, low, wide + pitch * Math.abs(dx), wide + pitch * Math.abs(dy));
    stack.push(next);
  }
  return cells;
}
