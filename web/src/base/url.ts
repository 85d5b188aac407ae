// The address of a view: #watch/out/run.mcap?t=12.5&view=plan. Everything after # stays in the browser.

export interface Address {
  view: string;
  path: string;
  query: Record<string, string>;
}

export function parseAddress(hash: string): Address {
  const text = hash.replace(/^#\/?/, "");
  const [place = "", query = ""] = text.split(/\?(.*)/s);
  const [view = "", ...path] = place.split("/");
  return { view, path: path.map(decoded).join("/"), query: Object.fromEntries(new URLSearchParams(query)) };
}

/** Decodes a part of the path; leaves an invalid escape as it is. */
function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

export function formatAddress({ view, path, query }: Address): string {
  const place = [view, ...path.split("/").filter(Boolean).map(encodeURIComponent)].join("/");
  const text = new URLSearchParams(Object.entries(query).filter(([, value]) => value !== "")).toString()
    .replaceAll("%2C", ",").replaceAll("%2F", "/");
  return `#${place}${text ? `?${text}` : ""}`;
}

const rest_ms = 250;
const placeOf = (hash: string): string => hash.split("?")[0]!;
let pending = { place: "", query: {} as Record<string, string> };
let resting = false;

/**
 * Changes the query of the current address without a history entry; an empty value removes its key. Acts at once, but
 * at most four times a second, since each change costs a browser some milliseconds. Drops pending changes if the view
 * changes.
 */
export function keepInAddress(changes: Record<string, string>): void {
  const place = placeOf(location.hash);
  pending = { place, query: pending.place === place ? { ...pending.query, ...changes } : changes };
  if (resting) return;
  const address = parseAddress(location.hash);
  const next = formatAddress({ ...address, query: { ...address.query, ...pending.query } });
  if (next !== location.hash) history.replaceState(history.state, "", next);
  pending.query = {};
  resting = true;
  setTimeout(() => {
    resting = false;
    if (Object.keys(pending.query).length > 0) keepInAddress({});
  }, rest_ms);
}
