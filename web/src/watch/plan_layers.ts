// The layers of the plan view by the names that people switch them by; the first lies lowest.
import type { SceneAnswer } from "../api";
import type { Box } from "../base/camera";
import type { Run } from "../log/run";
import { believed } from "./belief";
import { blocked } from "./blocked_layer";
import { candidates } from "./candidate_layer";
import { cover } from "./cover_layer";
import { expected } from "./expected_layer";
import { firingMap } from "./firing_map_layer";
import { flights } from "./flight_layer";
import { ground } from "./ground_layer";
import type { Layer, LayerOf } from "./layer";
import { map } from "./map_layer";
import { mapping } from "./mapping_layer";
import { pursuit } from "./pursuit_layer";
import { robot } from "./robot_layer";
import { scales } from "./scale_layer";
import { scan } from "./scan_layer";
import { stations } from "./station_layer";
import { tags } from "./tag_layer";
import { targets } from "./target_layer";
import { tour } from "./tour_layer";
import { way } from "./way_layer";
import { zones } from "./zone_layer";

/** A layer of a run, with its name where it can be switched off. */
export interface Named { name: string; layer: Layer }

const makers: [string, LayerOf][] = [["obstacles", ground], ["pursuit", pursuit], ["covered area", cover], ["map", map], ["zones", zones], ["landmarks", mapping], ["firing map", firingMap], ["planned tour", tour], ["path", way],
  ["range finder", scan], ["blocked flights", blocked], ["shots", flights], ["tags", tags], ["stations", stations], ["targets", targets], ["candidates", candidates], ["robot", robot], ["belief", believed]];

/** Returns the layers that the log has messages for; `bare` ones without scales; with the scenario, until the log tells more. */
export function layersOf(run: Run, area: Box, bare: boolean, scene: SceneAnswer | null): Named[] {
  const told = makers.flatMap(([name, make]) => {
    const layer = make(run);
    return layer ? [{ name, layer }] : [];
  });
  const unnamed = [scene && expected(run, scene), bare ? null : scales(area, run)].filter((one) => one !== null);
  return [...told, ...unnamed.map((layer) => ({ name: "", layer }))];
}
