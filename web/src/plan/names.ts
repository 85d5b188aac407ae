// Names that the page suggests.

/** "rooms/hall_plan.yaml" of "rooms/hall.txt" and the ending "_plan": beside it, and in letters that the server takes. */
export function suggestedName(path: string, ending: string): string {
  const [, folder = "", name = ""] = path.match(/^(.*\/)?(.*)$/) ?? [];
  const stem = name.replace(/\.gz$/, "").replace(/\.[^.]*$/, "").replace(/[^\w.-]+/g, "_");
  return `${folder}${stem}${stem.endsWith(ending) ? "" : ending}.yaml`;
}

/** A name that no target has. */
export function newName(targets: readonly { name: string }[]): string {
  let number = 1;
  while (targets.some(({ name }) => name === `new_${number}`)) ++number;
  return `new_${number}`;
}
