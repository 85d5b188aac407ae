// The map that exploring found, as it was known at any instant.

class Discovery {
  /** Colours of cells as 0xaabbggrr: unknown, free, occupied. */
  constructor(map, { unknown, free, occupied }) {
    this.map = map;
    this.colours = [free, occupied];
    this.unknown = unknown;
    this.cells = cellsInOrder(map);
    this.shown = 0;  // of the cells
    this.image = new ImageData(Math.max(1, map.columns), Math.max(1, map.rows));
    this.words = new Uint32Array(this.image.data.buffer).fill(unknown);
    this.paper = Object.assign(document.createElement("canvas"), { width: this.image.width, height: this.image.height });
    this.paper.getContext("2d").putImageData(this.image, 0, 0);
  }

  /** How many cells were known then. */
  count(until) {
    let [low, high] = [0, this.cells.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.cells[middle].time <= until) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  area(until) { return this.count(until) * this.map.cell_m ** 2; }

  /** A canvas with a pixel a cell, the top row first. */
  at(until) {
    const wanted = this.count(until);
    if (wanted === this.shown) return this.paper;
    if (wanted < this.shown) {
      this.words.fill(this.unknown);
      this.shown = 0;
    }
    const { columns, rows } = this.map;
    for (; this.shown < wanted; this.shown += 1) {
      const { cell, state } = this.cells[this.shown];
      this.words[(rows - 1 - Math.floor(cell / columns)) * columns + (cell % columns)] = this.colours[state];
    }
    this.paper.getContext("2d").putImageData(this.image, 0, 0);
    return this.paper;
  }
}

/** The cells in the order in which they were known: their places, states and times. */
function cellsInOrder({ columns, rows, state_runs: states, known_runs: known, step_s: step }) {
  const count = columns * rows;
  const expand = (runs) => {
    const values = new Int32Array(count);
    let at = 0;
    for (let i = 0; i + 1 < runs.length && at < count; i += 2) {
      values.fill(runs[i], at, at + runs[i + 1]);
      at += runs[i + 1];
    }
    return values;
  };
  const [state, time] = [expand(states), expand(known)];
  const seen = [...state.keys()].filter((cell) => state[cell] < 2).sort((a, b) => time[a] - time[b]);
  return seen.map((cell) => ({ cell, state: state[cell], time: time[cell] * step }));
}
