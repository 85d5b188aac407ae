// Text of the tool, which writes ASCII for terminals, as the page writes it: true exponents of units, no digits that nobody reads.

const figures = 6;  // of a number

/** For example "0.3 m2, 26.087855297157624 s" becomes "0.3 m², 26.0879 s". */
export const typeset = (text: string): string => text
  .replace(/(^|[^\w.])(-?\d+\.\d{6,})(?![\w.]*\/)/g, (_, before: string, number: string) => before + String(+Number(number).toPrecision(figures)))
  .replace(/(\d |\/| per )(m|s)([23])(?!\w)/g, (_, before: string, unit: string, power: string) => before + unit + (power === "2" ? "\u00b2" : "\u00b3"));
