// The keyboard: every view declares its keys with their descriptions once; the help overlay shows them.

export interface Key {
  /** The key as in KeyboardEvent.key: "n", "ArrowLeft", "Shift+ArrowLeft", "Ctrl+z". */
  key: string;
  words: string;
  act: () => void;
}

const symbols: Record<string, string> = {
  " ": "space", ArrowLeft: "\u2190", ArrowRight: "\u2192", ArrowUp: "\u2191", ArrowDown: "\u2193",
};
export const keyName = (key: string): string =>
  (key === "+" ? key : key.split("+").map((part) => symbols[part] ?? part).join(" "));

/**
 * Returns the name of a key event, such as "Shift+ArrowLeft" or "Ctrl+z". Includes Shift only if the key itself does
 * not show it.
 */
export function keyOf(event: Pick<KeyboardEvent, "key" | "shiftKey"> & { ctrlKey?: boolean; metaKey?: boolean }): string {
  const held = event.ctrlKey || event.metaKey ? "Ctrl+" : "";
  return event.shiftKey && event.key.length > 1 ? `${held}Shift+${event.key}` : held + event.key;
}

const isLetter = (name: string): boolean => name.length === 1 && name !== " ";

export class Keys {
  /** True if keys of a single character act: they are in the way of people who speak to the computer. */
  letters = true;
  private groups = new Map<string, { keys: Key[]; owner: object | null }>();

  /** Replaces the keys of a group and gives the group to `owner`. */
  set(group: string, keys: Key[], owner: object | null = null): void {
    this.groups.set(group, { keys, owner });
  }

  /** Removes the groups that the owner still has: a view may close after the next one has opened. */
  drop(owner: object): void {
    for (const [group, held] of this.groups) if (held.owner === owner) this.groups.delete(group);
  }

  list(): [string, Key[]][] {
    return [...this.groups].map(([group, { keys }]) => [group, keys]);
  }

  /** From now on handles keys. A button that was clicked lets go of the keyboard, so that the space key is no click on it. */
  listen(): void {
    addEventListener("keydown", (event) => this.handle(event));
    addEventListener("click", (event) => {
      if (event.detail > 0 && event.target instanceof Element) event.target.closest<HTMLElement>("button, summary, input[type=checkbox]")?.blur();
    });
  }

  /** Handles a key event; returns true if the key is known. Ignores keys typed into a field. */
  handle(event: KeyboardEvent): boolean {
    if (event.altKey) return false;
    const at = event.target instanceof Element ? event.target : null;
    if (at?.closest("input:not([type=range], [type=checkbox]), select, textarea, dialog")) return false;
    if ((event.key === " " || event.key === "Enter") && at?.closest("button, a, summary, input[type=checkbox]")) return false;
    const name = keyOf(event);
    if (!this.letters && isLetter(name)) return false;
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
