"""The command cover: the room, published fields, bounds, pictures, areas and the log, scenarios, refusals."""
import json
import math
import unittest
import xml.etree.ElementTree as ElementTree

from mcap_log import xyz
from tool import DATA, PAGE, SOURCE, ToolTest, flat, main
from well_logged import well_logged

ROOM = "(0,0) (1.5,0) (1.5,1.5) (0,1.5)\n---\n"
KEYS = {"status", "planned_fraction", "planned_missed_m2", "planned_overlap_m2", "planned_m", "covered_fraction", "missed_m2",
        "overlap_m2", "length_m", "turned_rad", "stops", "t_min_s", "t_max_s", "time_s", "reach_m2", "clearance_m",
        "sure_fraction", "sure_inner_fraction"}
# A width that suits each area, m.
PUBLISHED = {"ethz_example_l.yaml": 0.08, "ethz_example_polygon_bcd_cell.yaml": 6, "f2c_test_ring.json": 0.6,
             "ethz_example_rectangle_with_hole.yaml": 8, "f2c_test.json": 12, "f2c_Envelope.xml": 24,
             "ethz_example_polygon_epfl.yaml": 4, "f2c_test1.xml": 39}


def area(ring):
    return 0.5 * abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:])))


def signed_area(ring):
    return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1]))


class Cover(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("room.txt", ROOM)

    def cover(self, *args):
        result = self.run_tool("cover", *args, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        answer = flat(self.json_of(result))
        self.assertLessEqual(KEYS, set(answer))
        self.assertEqual(answer["status"], "done")
        self.assertLessEqual(answer["t_min_s"], answer["time_s"])
        self.assertLessEqual(answer["time_s"], answer["t_max_s"])
        self.assertGreaterEqual(answer["planned_fraction"], 0.995)
        self.assertGreaterEqual(answer["clearance_m"], 0)
        self.assertGreaterEqual(answer["covered_fraction"], answer["sure_fraction"] - 1e-3)
        off = answer["covered_m2"] + answer["missed_m2"] - answer["reach_m2"]
        self.assertLess(abs(off), 1e-8 * answer["reach_m2"])
        return answer

    def test_the_room_beats_the_reference(self):
        for seed in range(1, 6):
            result = self.run_tool("run", SOURCE / "scenarios/cover/cover_room.yaml", "--seed", seed, "--json", "--out", "out")
            self.assertEqual(result.returncode, 0, result.stderr)
            answer = flat(self.json_of(result))
            self.assertLess(answer["time_s"], 176)
            self.assertLessEqual(answer["tracking_error_m"], 0.005)
            self.assertGreaterEqual(answer["covered_fraction"], 0.995)
            self.assertGreaterEqual(answer["sure_inner_fraction"], 0.997)
        well_logged(self, "out")

    def test_the_field_scenario(self):
        answer = self.cover("--scenario", SOURCE / "scenarios/cover/cover_field.yaml", "--out", "out")
        well_logged(self, "out")
        self.assertGreater(answer["area_m2"], 5000)
        self.assertEqual(answer["tracking_error_limit_m"], 0.08)

    def test_published_areas(self):
        folder = DATA / "slam" / "coverage"
        if not folder.exists():
            self.skipTest(f"{folder} is absent; set OUTRIDER_DATA")
        found = {path.name for path in folder.iterdir() if path.suffix in (".json", ".xml", ".yaml")}
        self.assertEqual(found, set(PUBLISHED))
        for name, width in PUBLISHED.items():
            with self.subTest(name):
                self.cover(folder / name, "--width", width, "--method", "boustrophedon", "--tracking-error", 0.02 * width)

    def test_methods_differ_and_repeat(self):
        spiral = self.cover("room.txt", "--method", "spiral")
        sweep = self.cover("room.txt", "--method", "boustrophedon")
        self.assertGreater(spiral["laps"], sweep["laps"])
        self.assertGreater(sweep["lanes"], 0)
        best = self.cover("room.txt")
        self.assertEqual(best["planned_s"], min(spiral["planned_s"], sweep["planned_s"]))
        self.assertEqual(best, self.cover("room.txt"))

    def test_files(self):
        self.cover("room.txt", "--out", "out", "--tracking-error", "0.005")
        self.assertTrue(ElementTree.parse(self.folder / "out/run.svg").getroot().tag.endswith("svg"))
        areas = {f["properties"]["name"]: f for f in
                 json.loads((self.folder / "out/areas.geojson").read_text())["features"]}
        for feature in areas.values():
            total = sum(area(rings[0]) - sum(map(area, rings[1:])) for rings in feature["geometry"]["coordinates"])
            self.assertAlmostEqual(total, feature["properties"]["area_m2"], places=6)
        self.assertAlmostEqual(areas["area"]["properties"]["area_m2"], 2.25, places=6)
        track = json.loads((self.folder / "out/track.json").read_text())
        at = track["start"][:2]
        for piece in track["pieces"]:
            self.assertLess(abs(piece["from"][0] - at[0]) + abs(piece["from"][1] - at[1]), 1e-8)
            at = piece["to"]

    def features(self, name):
        return json.loads((self.folder / name).read_text())["features"]

    def test_a_field_in_utm(self):
        crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
        corners = [[456789.5, 5428123], [456849.5, 5428123], [456849.5, 5428163], [456789.5, 5428163]]
        self.write("utm.geojson", json.dumps({"type": "Polygon", "crs": crs, "coordinates": [corners + corners[:1]]}))
        answer = self.cover("utm.geojson", "--width", "4", "--start", "456819.5,5428143,90", "--out", "out")
        self.assertEqual((answer["origin_x"], answer["origin_y"]), (456789, 5428123))
        self.assertAlmostEqual(answer["area_m2"], 2400, places=3)
        areas = json.loads((self.folder / "out/areas.geojson").read_text())
        self.assertEqual(areas["crs"], crs)
        area = next(f for f in areas["features"] if f["properties"]["name"] == "area")
        self.assertEqual(sorted(area["geometry"]["coordinates"][0][0][:-1]), sorted(corners))
        line = self.features("out/track.geojson")[0]["geometry"]["coordinates"]
        self.assertEqual(line[0], [456819.5, 5428143])
        self.assertIn("metres east and north of (456789, 5428123)",
                      [one.msg for _, one in self.log_of("out").read("/rosout")])
        summary = self.run_tool("cover", "utm.geojson", "--width", "4")
        self.assertEqual(summary.stderr, "")
        self.assertIn("north of (456789, 5428123)", summary.stdout)
        self.refused("cover", "utm.geojson", "--width", "4", "--start", "0,0,0", says=["start", "(0, 0) lies outside"])
        self.refused("cover", "utm.geojson", "--width", "4", "--start", "456790.25,5428143.5,0",
                     says=["start", "cannot stand at (456790.25, 5428143.5), 0.75 m from an edge"])

    def test_places_of_sentences_are_in_the_degrees_of_the_file(self):
        field = SOURCE / "scenarios/cover/field.geojson"
        self.refused("cover", field, "--width", "2", "--start", "8.5,49.00123456789,0",
                     says=["start", "(8.5000000, 49.0012346) lies outside the area"])
        self.refused("cover", field, "--width", "2", "--start", "8.400001,49.000001,0",
                     says=["start", "cannot stand at (8.4000010, 49.0000010), "])

    def test_two_polygons_in_degrees(self):
        def square(lon, lat):
            return [[lon, lat], [lon + 0.0004, lat], [lon + 0.0004, lat + 0.0003], [lon, lat + 0.0003], [lon, lat]]
        squares = [square(8.4, 49.0), square(8.401, 49.0)]
        self.write("two.geojson", json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}} for ring in squares]}))
        self.refused("cover", "two.geojson", "--width", "3", says=["2 areas lie apart", "transfers"])
        answer = self.cover("two.geojson", "--width", "3", "--transfers", "--tracking-error", "0.1", "--out", "out")
        self.assertEqual(answer["areas_apart"], 2)
        self.assertGreater(answer["transfer_m"], 30)
        rows = self.result_of("out")["areas"]
        self.assertEqual(len(rows), 2)
        for row in rows:
            self.assertGreater(row["planned_fraction"], 0.995)
        areas = {f["properties"]["name"]: f["geometry"]["coordinates"] for f in self.features("out/areas.geojson")}
        for (ring,), square_ in zip(sorted(areas["area"]), squares):
            for p, q in zip(sorted(ring[:-1]), sorted(square_[:-1])):
                self.assertLess(math.dist(p, q), 3e-9, "within half a millimetre")
        lines = self.features("out/track.geojson")
        self.assertEqual({line["properties"]["role"] for line in lines} - {"move"}, {"lap", "lane", "transfer"})
        for line in lines:
            for lon, lat in line["geometry"]["coordinates"]:
                self.assertTrue(8.4 <= lon <= 8.4014 and 49.0 <= lat <= 49.0003)

    def test_the_log_is_the_drive(self):
        answer = self.cover("room.txt", "--out", "out", "--tracking-error", "0.005", "--seed", "7")
        self.assertEqual(answer["log"], "out/run.mcap")
        result, log = self.result_of("out"), self.log_of("out")
        self.assertEqual((result["job"], result["status"], log.latest("/run").seed), ("cover", "done", 7))
        self.assertIn(result["settings"]["method"], ("spiral", "boustrophedon"))
        metrics, poses = result["metrics"], log.read("/pose")
        self.assertEqual(metrics, answer["metrics"], "one name has one meaning")
        self.assertAlmostEqual(poses[-1][0], metrics["time_s"], places=5)
        track = [xyz(pose.pose.position)[:2] for _, pose in poses]
        self.assertAlmostEqual(sum(map(math.dist, track, track[1:])), metrics["length_m"], places=3)
        reach = [[xyz(point) for point in outline.points] for outline in log.latest("/coverage_area").reach]
        self.assertAlmostEqual(sum(map(signed_area, reach)), answer["reach_m2"], places=4)
        self.assertAlmostEqual(log.latest("/coverage").covered, metrics["covered_m2"], places=3)
        self.assertEqual([one.role for _, one in log.read("/coverage_passes")].count("lane"), answer["lanes"])
        way = json.loads((self.folder / "out/track.json").read_text())["driven"]
        self.assertLess(math.dist(way[-1], track[-1]), 1e-5)

    def test_the_run_is_replayed(self):
        summary = self.run_tool("cover", "room.txt", "--out", "out", *PAGE).stdout
        self.assertEqual([path.name for path in self.folder.glob("out/*.html")], ["cover.html"] * len(PAGE))
        result = self.run_tool("replay", "out/run.mcap", "--svg", "moving.svg")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertTrue(summary.startswith(result.stdout.split("\n\n  picture")[0]))
        self.assertTrue(ElementTree.parse(self.folder / "moving.svg").getroot().tag.endswith("svg"))
        answer = flat(self.json_of(self.run_tool("replay", "out/run.mcap", "--json")))
        self.assertEqual((answer["job"], answer["log"]), ("cover", "out/run.mcap"))
        self.assertGreater(answer["covered_fraction"], 0.995)

    def test_a_turning_radius(self):
        self.write("meadow.txt", "(0,0) (30,0) (30,18) (0,18)\n---\n")
        steers = ("meadow.txt", "--width", "2", "--turning-radius", "2", "--headland", "2")
        result = self.run_tool("cover", *steers, "--out", "out", "--json")
        self.assertEqual(result.returncode, 1, result.stderr)
        answer = flat(self.json_of(result))
        self.assertEqual((answer["status"], answer["stops"]), ("not_done", 0))
        self.assertIn("4 places", answer["reason"])
        left = [row["area_m2"] for row in self.result_of("out")["missed"]]
        for area_m2 in left:
            self.assertAlmostEqual(area_m2, (1 - math.pi / 4) * (3 ** 2 - 1), delta=0.02)
        self.assertAlmostEqual(sum(left), answer["planned_missed_m2"], delta=0.01 * sum(left))
        for piece in json.loads((self.folder / "out/track.json").read_text())["pieces"]:
            self.assertNotIn("backward", piece)
            if "turn_rad" in piece:
                self.assertGreaterEqual(math.dist(piece["centre"], piece["from"]), 2 - 1e-8)
        accepted = self.run_tool("cover", *steers, "--uncovered", "0.02", "--json")
        self.assertEqual((accepted.returncode, self.json_of(accepted)["status"]), (0, "done"))
        self.cover(*steers, "--reverse", "--out", "both")
        pieces = json.loads((self.folder / "both/track.json").read_text())["pieces"]
        self.assertTrue(any(piece.get("backward") for piece in pieces))
        self.assertIn("not done", self.run_tool("cover", *steers).stdout)
        for radius in ("-1", "nan", "x", "5000"):
            self.refused("cover", "meadow.txt", "--turning-radius", radius, says=["turning-radius", radius])
        self.refused("cover", "meadow.txt", "--width", "2", "--turning-radius", "500", says=["turning_radius", "500 m", "smaller"])
        self.refused("cover", "meadow.txt", "--reverse", says=["reverse", "turning radius"])
        self.refused("cover", "meadow.txt", "--headland", "2", says=["headland", "turning radius"])

    def test_a_bar(self):
        deck = ("--width", "0.6", "--tool-shape", "bar", "--tool-width", "1.2", "--tool-length", "0.3", "--tool-forward", "0.4")
        self.write("yard.txt", "(0,0) (20,0) (20,12) (0,12)\n---\n(8,5) (11,5) (11,7) (8,7)\n---\n")
        answer = self.cover("yard.txt", *deck, "--out", "out")
        self.assertEqual((answer["width_m"], answer["strip_m"]), (0.6, 1.2))
        self.assertEqual(answer["covered_fraction"], answer["planned_fraction"])
        info = self.log_of("out").latest("/run")
        self.assertEqual((info.robot_radius, info.coverage_width, info.coverage_length, info.coverage_forward), (0.3, 1.2, 0.3, 0.4))
        self.assertIn("covered by the bar", (self.folder / "out/run.svg").read_text())
        boom = ("--width", "0.6", "--tool-shape", "bar", "--tool-width", "6", "--tool-length", "0.3")
        wide = self.run_tool("cover", "yard.txt", *boom, "--json")
        self.assertEqual((wide.returncode, self.json_of(wide)["status"]), (1, "not_done"))
        self.assertIn("the bar 6 m wide found no way to cover more", self.json_of(wide)["reason"])
        self.refused("cover", "yard.txt", "--tool-shape", "ring", says=["tool", "shape", "ring", "disk or bar"])
        self.refused("cover", "yard.txt", *deck, "--tracking-error", "0.01", says=["tracking_error", "0.01 m"])
        self.refused("cover", "yard.txt", *deck, "--method", "spiral", says=["method", "boustrophedon"])

    def test_the_mower_scenario(self):
        answer = self.cover("--scenario", SOURCE / "scenarios/cover/cover_mower.yaml", "--out", "out")
        well_logged(self, "out")
        self.assertEqual((answer["strip_m"], answer["width_m"]), (2, 1.2))
        self.assertGreater(answer["planned_fraction"], 0.999)

    def test_people_get_a_summary(self):
        result = self.run_tool("cover", "room.txt")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("% of the reach", result.stdout)

    def test_bad_input(self):
        self.refused("cover", says=["area", "missing"])
        self.refused("cover", "none.txt", says=["none.txt"])
        self.refused("cover", "room.txt", "--html", says=["--html", "--out DIR"])
        self.refused("cover", "room.txt", "--width", "2", says=["fits nowhere", "1.5 m", "width"])
        for width in ("0", "-1", "x"):
            self.refused("cover", "room.txt", "--width", width, says=["--width", width])
        self.refused("cover", "room.txt", "--method", "random", says=["there is no method 'random'"])
        self.refused("cover", "room.txt", "--tracking-error", "0.05", says=["tracking_error", "overlap of at least 0.5"])
        self.refused("cover", "room.txt", "--start", "0,0,0", says=["start", "cannot stand"])
        self.refused("cover", "room.txt", "--units", "feet", says=["units", "metres"])
        self.write("crossed.txt", "(0,0) (1,1) (1,0) (0,1)\n---\n")
        self.refused("cover", "crossed.txt", says=["crossed.txt:2", "boundary"])
        self.write("out.yaml", "hull:\n  points: [{x: 0, y: 0}, {x: 9, y: 0}, {x: 9, y: 9}]\nholes:\n"
                   "- points: [{x: 8, y: 2}, {x: 12, y: 2}, {x: 12, y: 4}]\n")
        self.refused("cover", "out.yaml", says=["out.yaml:4", "hole 1", "outside the boundary"])
        self.write("out.txt", "(0,0) (9,0) # a bend\n(9,9)\n---\n# trees\n(8,2) (8.2,2) (8.2,2.2)\n(8,4) (12,4) (12,5)\n")
        self.refused("cover", "out.txt", says=["out.txt:6", "hole 2", "outside the boundary"])
        self.write("crossed.json", json.dumps({"type": "Polygon",
                                               "coordinates": [[[0, 0], [4, 4], [4, 0], [0, 4], [0, 0]]]}))
        self.refused("cover", "crossed.json", "--units", "metres", says=["crossed.json: $.coordinates[0]"])
        self.write("bad.yaml", "job: cover\narea: room.txt\nwidht: 2\n")
        self.refused("run", "bad.yaml", says=["bad.yaml:3", "widht", "width"])


if __name__ == "__main__":
    main()
