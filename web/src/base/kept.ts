// Choices that the browser keeps. Without storage, as on a page from a file, a choice lasts until the page closes.

export function kept(name: string): string | null {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

export function keep(name: string, value: string): void {
  try {
    localStorage.setItem(name, value);
  } catch { /* there is no storage */ }
}
