// Text of the tool, which writes ASCII for terminals, as the page writes it: true exponents of units and signs, thousands apart, no digits that nobody reads.

const figures = 6;  // of a number

/** For example "9485238 flights, 0.3 m2, -26.087855297157624 s" becomes "9,485,238 flights, 0.3 m², −26.0879 s". */
export const typeset = (text: string): string => text
  .replace(/(^|[^\w.])(-?\d+\.\d{6,})(?![\w.]*\/)/g, (_, before: string, number: string) => before + String(+Number(number).toPrecision(figures)))
  .replace(/(\d |\/| per )(m|s)([23])(?!\w)/g, (_, before: string, unit: string, power: string) => before + unit + (power === "2" ? "\u00b2" : "\u00b3"))
  .replace(/(^|[ (])(\d{4,})(?= (?:flights|places|expansions|cells|vertices)\b)/g, (_, before: string, number: string) => before + Number(number).toLocaleString("en"))
  .replace(/(^|[ (])-(?=\d)/g, "$1\u2212");
