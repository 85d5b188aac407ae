/**
 * Path planning in a page or in node, without a server:
 *
 *     const outrider = await load(await (await fetch("planner.wasm")).arrayBuffer());
 *     outrider.setGrid(cells, { columns: 60, rows: 40, resolution: 0.1 });    // cells: 0 free, row 0 lowest
 *     outrider.setPlanner("theta_star");
 *     const plan = outrider.plan([0.55, 3.55], [5.55, 3.55]);                 // checked; throws a Fault
 *
 * A ground and a planner serve until others are set. Lengths are in metres, options as in `outrider plan`.
 */

/** A refusal of Outrider, or the proof that there is no path. */
export class Fault extends Error {
  constructor({ code, sentence, where }) {
    super(where ? `${where}: ${sentence}` : sentence);
    this.code = code;
    this.where = where;
  }
}

const notThere = 52;  // ENOSYS of WASI

/** The calls of the module to the system: the time, and nothing else. */
function system(module, memory) {
  const calls = Object.fromEntries(WebAssembly.Module.imports(module).map(({ name }) => [name, () => notThere]));
  calls.clock_time_get = (clock, precision, at) => {
    new DataView(memory().buffer).setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
    return 0;
  };
  calls.proc_exit = (status) => { throw new Error(`the planner ended with status ${status}`); };
  return { wasi_snapshot_preview1: calls };
}

class Outrider {
  #exports;

  constructor(exports) {
    this.#exports = exports;
  }

  /** Planners with sentence, guarantee, source, grounds and options. */
  catalogue() {
    return this.#answer(this.#exports.catalogue());
  }

  /** Sets the ground: `cells` in rows from the lowest, 0 free, all else blocked. */
  setGrid(cells, { columns, rows, resolution = 1, model = "cells" }) {
    if (cells.length !== columns * rows)
      throw new Fault({ code: "bad_input", sentence: `${cells.length} cells for ${columns} x ${rows}`, where: "cells" });
    this.#give(Uint8Array.from(cells, (cell) => (cell ? 1 : 0)));
    this.#answer(this.#exports.set_grid(columns, rows, resolution, model === "corners" ? 1 : 0));
  }

  /** Sets the ground: the free space within `boundary` and outside `obstacles`, each a list of [x, y], for a disk. */
  setPolygons(boundary, obstacles, radius) {
    const numbers = [boundary, ...obstacles].flatMap((corners) => [corners.length, ...corners.flat()]);
    this.#give(new Uint8Array(Float64Array.from(numbers).buffer));
    this.#answer(this.#exports.set_polygons(radius));
  }

  setPlanner(name, options = {}) {
    const lines = [name, ...Object.entries(options).map(([option, value]) => `${option}=${value}`)];
    this.#give(new TextEncoder().encode(lines.join("\n")));
    this.#answer(this.#exports.set_planner());
  }

  /**
   * Plans from [x, y] to [x, y]: { cost, lower_bound, length, expansions, waypoints, pieces, steps }. A piece is
   * [from x, y, to x, y, centre x, y, turn in rad]: a leg where the turn is 0. `steps` has the first so many steps of
   * the search: [x, y, x and y of the parent, cost so far, priority].
   */
  plan(from, to, { steps = 0 } = {}) {
    return this.#answer(this.#exports.plan(...from, ...to, steps));
  }

  #give(bytes) {
    const at = this.#exports.input(bytes.length);
    new Uint8Array(this.#exports.memory.buffer, at, bytes.length).set(bytes);
  }

  #answer(at) {
    const bytes = new Uint8Array(this.#exports.memory.buffer);
    const answer = JSON.parse(new TextDecoder().decode(bytes.subarray(at, bytes.indexOf(0, at))));
    if (answer.code) throw new Fault(answer);
    return answer;
  }
}

/** Loads planner.wasm from its bytes. */
export async function load(bytes) {
  const module = await WebAssembly.compile(bytes);
  let instance;
  instance = await WebAssembly.instantiate(module, system(module, () => instance.exports.memory));
  instance.exports._initialize?.();
  return new Outrider(instance.exports);
}
