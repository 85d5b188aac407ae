// Creates elements in one line. Text from files becomes text nodes, never markup.

export type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

function apply(made: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") made.addEventListener(name.slice(2), value as (event: Event) => void);
    else made.setAttribute(name, value === true ? "" : String(value));
  }
}

/** Creates an HTML element; attributes that begin with "on" are listeners. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  apply(made, attributes);
  made.append(...children.filter((child): child is Node | string => !!child));
  return made;
}

export function svg(tag: string, attributes: Attributes = {}, ...children: SVGElement[]): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  apply(made, attributes);
  made.append(...children);
  return made;
}

const icons: Record<string, string> = {
  play: "M6 3.6v12.8L16.6 10z",
  pause: "M5.2 3.8h3.4v12.4H5.2zM11.4 3.8h3.4v12.4h-3.4z",
  back: "M15 4.2v11.6L7.6 10zM5 4.2h1.8v11.6H5z",
  next: "M5 4.2v11.6l7.4-5.8zM13.2 4.2H15v11.6h-1.8z",
  in: "M10 4v12M4 10h12",
  out: "M4 10h12",
  fit: "M3.5 8V3.5H8M12 3.5h4.5V8M16.5 12v4.5H12M8 16.5H3.5V12",
  follow: "M10 2.5v3M10 14.5v3M2.5 10h3M14.5 10h3M10 5.5a4.5 4.5 0 1 0 0 9a4.5 4.5 0 1 0 0-9",
  theme: "M10 3a7 7 0 1 0 0 14a7 7 0 1 0 0-14M10 3v14M10 6h5.5M10 10h7M10 14h5.5",
  help: "M7.2 7.4a2.8 2.8 0 1 1 4.3 2.4c-1 .6-1.5 1.2-1.5 2.4M10 15.2v.1",
  save: "M10 3v9M6.2 8.6L10 12.4l3.8-3.8M4 16.5h12",
  film: "M3.5 4.5h13v11h-13zM7 4.5v11M13 4.5v11M3.5 8.2h3.5M3.5 11.8h3.5M13 8.2h3.5M13 11.8h3.5",
  undo: "M7.5 4L3.8 7.7l3.7 3.7M4 7.7h7.6a4.4 4.4 0 0 1 0 8.8H7",
  redo: "M12.5 4l3.7 3.7l-3.7 3.7M16 7.7H8.4a4.4 4.4 0 0 0 0 8.8H13",
  layers: "M10 3.2l7 3.6-7 3.6-7-3.6zM3.6 10.2l6.4 3.3 6.4-3.3M3.6 13.5l6.4 3.3 6.4-3.3",
  ruler: "M3 13.4L13.4 3l3.6 3.6L6.6 17zM6 10.4l1.8 1.8M8.6 7.8l1.8 1.8M11.2 5.2l1.8 1.8",
  near: "M10 5a5 5 0 1 0 0 10a5 5 0 1 0 0-10M10 2v4M10 14v4M2 10h4M14 10h4",
};
const solid = new Set(["play", "pause", "back", "next"]);

export function icon(name: string): SVGElement {
  const path = svg("path", { d: icons[name] ?? "", class: solid.has(name) ? "solid" : "" });
  return svg("svg", { viewBox: "0 0 20 20", class: "icon", "aria-hidden": "true" }, path);
}

/** Creates a button with an icon; its words are for screen readers and the tooltip. */
export function iconButton(name: string, words: string, act: () => void, key = ""): HTMLButtonElement {
  const title = key ? `${words} (${key})` : words;
  return h("button", { type: "button", class: "quiet", title, "aria-label": words, onclick: act }, icon(name));
}
