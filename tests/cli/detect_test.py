"""detect: tags in photos, on the command line."""
import json
import unittest

from tool import DATA, ToolTest, main

PHOTOS = DATA / "slam" / "apriltag"
CAMERA = """image_width: 64
image_height: 64
camera_matrix:
  rows: 3
  cols: 3
  data: [60, 0, 31.5, 0, 60, 31.5, 0, 0, 1]
"""
GREY = b"P5\n64 64\n255\n" + bytes([128]) * 4096


class Detect(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("camera.yaml", CAMERA)
        self.write("grey.pgm", GREY)

    def test_an_image_without_tags(self):
        result = self.run_tool("detect", "grey.pgm", "--calibration", "camera.yaml", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.json_of(result), {"status": "done", "width": 64, "height": 64,
                                                "families": ["tag36h11"], "tags": []})
        said = self.run_tool("detect", "grey.pgm").stdout
        self.assertIn("0 tags found: none of tag36h11; --family takes tag16h5, tag25h9,", said)
        said = self.run_tool("detect", "grey.pgm", "--family", "all").stdout
        self.assertIn("tagStandard52h13", said)
        self.assertNotIn("--family", said)

    def test_bad_input(self):
        self.write("text.jpg", "no photo")
        self.write("cut.jpg", b"\xff\xd8\xff\xe0\x00\x10JFIF")
        self.write("singular.yaml", "K: [0, 0, 320, 0, 300, 240, 0, 0, 1]\n")
        self.write("other.yaml", CAMERA.replace("64", "640"))
        self.write("empty.yaml", "")
        self.refused("detect", says=["image: it is missing"])
        self.refused("detect", "none.png", says=["none.png"])
        self.refused("detect", "text.jpg", says=["text.jpg", "PNG, JPEG or PGM"])
        self.refused("detect", "cut.jpg", says=["cut.jpg", "damaged"])
        for size in ["0", "-1", "nan", "x"]:
            self.refused("detect", "grey.pgm", "--size", size, says=["--size", f"'{size}'", "0.0001 to 100"])
        for name, remedy in [("singular.yaml", "singular"), ("other.yaml", "640 x 640"),
                             ("empty.yaml", "camera_matrix"), ("none.yaml", "none.yaml")]:
            self.refused("detect", "grey.pgm", "--calibration", name, says=[name, remedy])
        self.refused("detect", "grey.pgm", "--camera", "left", says=["--camera", "'left'", "--calibration FILE"])
        self.refused("detect", "grey.pgm", "--family", "tag36h12", says=["--family", "did you mean 'tag36h10'"])
        self.refused("detect", "grey.pgm", "--family", "", says=["--family", "all"])
        self.refused("detect", "grey.pgm", "--svg", "no/such/folder.svg", says=["folder.svg"])

    @unittest.skipUnless(PHOTOS.exists(), f"{PHOTOS} is absent; set OUTRIDER_DATA")
    def test_published_photo(self):
        photo = PHOTOS / "dt_test_image_rotation_20.png"
        flags = [photo, "--calibration", PHOTOS / "dt_test_info.yaml", "--size", "0.065"]
        self.refused("detect", *flags, says=["rotation_test", "name one of them"])
        result = self.run_tool("detect", *flags, "--camera", "rotation_test", "--json", "--svg", "found.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        tags = self.json_of(result)["tags"]
        self.assertEqual([tag["id"] for tag in tags], [76])
        pose = tags[0]["poses"][0]
        self.assertAlmostEqual(pose["yaw_deg"], 17, delta=2)
        self.assertAlmostEqual(pose["distance_m"], 0.21, delta=0.02)
        self.assertEqual(len(tags[0]["corners"]), 4)
        self.assertIn("data:image/png;base64,", (self.folder / "found.svg").read_text())
        again = self.run_tool("detect", *flags, "--camera", "rotation_test", "--json", "--svg", "found.svg")
        self.assertEqual(again.stdout, result.stdout)
        self.assertIn("76  corners", self.run_tool("detect", photo).stdout)
        other = self.run_tool("detect", photo, "--family", "tag25h9,tagStandard41h12", "--json")
        self.assertEqual(self.json_of(other)["other_families"], {"tag36h11": 1})
        self.assertIn("there is 1 of tag36h11; name the family with --family",
                      self.run_tool("detect", photo, "--family", "tag25h9").stdout)

    @unittest.skipUnless(PHOTOS.exists(), f"{PHOTOS} is absent; set OUTRIDER_DATA")
    def test_both_poses_with_their_odds(self):
        photo = PHOTOS / "dt_test_image_rotation_60.png"
        flags = [photo, "--calibration", PHOTOS / "dt_test_info.yaml", "--camera", "rotation_test"]
        poses = self.json_of(self.run_tool("detect", *flags, "--size", "0.065", "--json"))["tags"][0]["poses"]
        self.assertEqual(len(poses), 2)
        self.assertAlmostEqual(sum(pose["probability"] for pose in poses), 1.0, places=9)
        self.assertGreater(poses[0]["probability"], 0.99)
        self.assertIn("% likely", self.run_tool("detect", *flags, "--size", "0.065").stdout)


if __name__ == "__main__":
    main()
