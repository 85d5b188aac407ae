// The fields of a message, whatever its type: by their names, for reading and for plotting.

export interface Field { path: string; value: string | number | boolean; depth: number; name: string }

const mostItems = 12;  // of an array that are listed
const mostDepth = 6;

const isList = (value: unknown): value is ArrayLike<unknown> => Array.isArray(value) || (ArrayBuffer.isView(value) && "length" in value);

/** All fields, in order; a parent comes before its fields, and of a long array the first items and their number. */
export function fieldsOf(message: unknown, name = "", path = "", depth = 0): Field[] {
  if (typeof message === "bigint") return [{ path, name, depth, value: Number(message) }];
  if (typeof message === "number" || typeof message === "string" || typeof message === "boolean") return [{ path, name, depth, value: message }];
  if (message === null || typeof message !== "object" || depth > mostDepth) return [];
  const items: [string, unknown][] = isList(message) ? Array.from({ length: Math.min(mostItems, message.length) }, (_, i) => [String(i), message[i]]) : Object.entries(message);
  const head: Field[] = name ? [{ path, name, depth, value: isList(message) ? `${message.length.toLocaleString("en")} items` : "" }] : [];
  return [...head, ...items.flatMap(([key, value]) => fieldsOf(value, key, path ? `${path}.${key}` : key, name ? depth + 1 : depth))];
}

/** The paths of the numbers in a message; those of its stamp tell nothing that the axis does not. */
export const numericPaths = (message: unknown): string[] =>
  fieldsOf(message).flatMap(({ path, value }) => (typeof value === "number" && !/(^|\.)stamp\./.test(path) ? path : []));

/** The number at a path; null where there is none. */
export function numberAt(message: unknown, path: string): number | null {
  let value: unknown = message;
  for (const key of path.split(".")) value = (value as Record<string, unknown> | null | undefined)?.[key];
  const number = typeof value === "bigint" ? Number(value) : value;
  return typeof number === "number" && Number.isFinite(number) ? number : null;
}
