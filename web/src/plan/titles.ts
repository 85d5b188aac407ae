// Titles that people use for a planner: "A*" for a_star, "JPS+" for jps_plus, "Visibility graph, implicit".

const whole: Record<string, string> = {
  visibility_graph_implicit: "Visibility graph, implicit", visibility_graph_reduced: "Visibility graph, reduced", lazy_theta_star: "Lazy Theta*", hybrid_a_star: "Hybrid A*", d_star_lite: "D* Lite",
  terrain_a_star: "Terrain A*", terrain_theta_star: "Terrain Theta*",
};
const capitals = new Set(["a", "jps", "lpa", "prm", "rrt", "bit"]);

export function titleOf(planner: string): string {
  if (whole[planner]) return whole[planner];
  const [, stem = planner, mark = ""] = planner.match(/^(.*?)(_star|_plus)?$/) ?? [];
  const word = capitals.has(stem) ? stem.toUpperCase() : stem.charAt(0).toUpperCase() + stem.slice(1);
  return word.replaceAll("_", " ") + { "": "", _star: "*", _plus: "+" }[mark]!;
}

/** Returns the title of a choice of an option: "Euclidean", "Largest g". */
export const choiceTitle = (name: string): string => name.charAt(0).toUpperCase() + name.slice(1).replaceAll("_", " ");
