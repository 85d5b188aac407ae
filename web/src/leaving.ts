// Work that is not saved is left only by those who say so.

export interface Work { unsaved?: () => boolean }

const question = "What you changed here is not saved. Leave it?";

/** Asks whether to leave a view, if anything in it is not saved. */
export const mayLeave = (view: Work | null): boolean => !view?.unsaved?.() || confirm(question);

/** Has the browser ask before the page is closed or loaded again. */
export function watchLeaving(present: () => Work | null): void {
  addEventListener("beforeunload", (event) => { if (present()?.unsaved?.()) event.preventDefault(); });
}
