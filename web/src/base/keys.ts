// The keyboard: every view says its keys with their words once; the help overlay shows them.

export interface Key {
  /** As KeyboardEvent.key gives it: "n", "ArrowLeft", "Shift+ArrowLeft", "Ctrl+z". */
  key: string;
  words: string;
  act: () => void;
}

const symbols: Record<string, string> = {
  " ": "space", ArrowLeft: "\u2190", ArrowRight: "\u2192", ArrowUp: "\u2191", ArrowDown: "\u2193",
};
export const keyName = (key: string): string =>
  (key === "+" ? key : key.split("+").map((part) => symbols[part] ?? part).join(" "));

/** "Shift+ArrowLeft" or "Ctrl+z" of an event. Shift is told only where the key does not show it itself. */
export function keyOf(event: Pick<KeyboardEvent, "key" | "shiftKey"> & { ctrlKey?: boolean; metaKey?: boolean }): string {
  const held = event.ctrlKey || event.metaKey ? "Ctrl+" : "";
  return event.shiftKey && event.key.length > 1 ? `${held}Shift+${event.key}` : held + event.key;
}

export class Keys {
  private groups = new Map<string, { keys: Key[]; owner: object | null }>();

  /** Replaces the keys of a group, which are their owner's from now on. */
  set(group: string, keys: Key[], owner: object | null = null): void {
    this.groups.set(group, { keys, owner });
  }

  /** Takes away what is still the owner's: a view may close after the next one has opened. */
  drop(owner: object): void {
    for (const [group, held] of this.groups) if (held.owner === owner) this.groups.delete(group);
  }

  list(): [string, Key[]][] {
    return [...this.groups].map(([group, { keys }]) => [group, keys]);
  }

  /** True when a key was known; what is typed into a field is left alone. */
  handle(event: KeyboardEvent): boolean {
    if (event.altKey) return false;
    const at = event.target instanceof Element ? event.target : null;
    if (at?.closest("input:not([type=range]), select, textarea, dialog")) return false;
    if ((event.key === " " || event.key === "Enter") && at?.closest("button, a, summary")) return false;
    const name = keyOf(event);
    for (const { keys } of this.groups.values()) {
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
