// The title of the window: what is shown, before the name of the tool.
export function entitle(what: string | null | undefined): void {
  document.title = what ? `${what} \u2013 Outrider` : "Outrider";
}
