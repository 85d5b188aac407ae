// The keyboard: every view says its keys with their words once; the help overlay shows them.

export interface Key {
  /** As KeyboardEvent.key gives it: "n", "ArrowLeft", "Shift+ArrowLeft". */
  key: string;
  words: string;
  act: () => void;
}

const symbols: Record<string, string> = {
  " ": "space", ArrowLeft: "\u2190", ArrowRight: "\u2192", ArrowUp: "\u2191", ArrowDown: "\u2193",
};
export const keyName = (key: string): string =>
  (key === "+" ? key : key.split("+").map((part) => symbols[part] ?? part).join(" "));

/** "Shift+ArrowLeft" of an event. Shift is told only where the key does not show it itself. */
export function keyOf(event: Pick<KeyboardEvent, "key" | "shiftKey">): string {
  return event.shiftKey && event.key.length > 1 ? `Shift+${event.key}` : event.key;
}

export class Keys {
  private groups = new Map<string, Key[]>();

  /** Replaces the keys of a group; an empty list removes it. */
  set(group: string, keys: Key[]): void {
    if (keys.length > 0) this.groups.set(group, keys);
    else this.groups.delete(group);
  }

  list(): [string, Key[]][] {
    return [...this.groups];
  }

  /** True when a key was known; what is typed into a field is left alone. */
  handle(event: KeyboardEvent): boolean {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    const at = event.target instanceof Element ? event.target : null;
    if (at?.closest("input:not([type=range]), select, textarea, dialog")) return false;
    if ((event.key === " " || event.key === "Enter") && at?.closest("button, a, summary")) return false;
    const name = keyOf(event);
    for (const [, keys] of this.groups) {
      const found = keys.find((one) => one.key === name);
      if (!found) continue;
      event.preventDefault();
      found.act();
      return true;
    }
    return false;
  }
}

export const keys = new Keys();
