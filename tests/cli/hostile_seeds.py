"""Small valid files of every format that the tool reads, and the verb that reads each.

A word FILE of a command is the file that is made hostile; the other files stay as they are.
"""
import collections
import gzip
import struct

import hostile_bombs as bombs
from tool import COARSE, FENCE, FLOOR, MAP, SOURCE, TARGETS, YARD, world

CORPUS = SOURCE / "tests/fuzz/corpus"
FILE = object()
Seed = collections.namedtuple("Seed", "name file content words binary")

POINTS = ["--from", "0,-2", "--to", "2,-2"]
CELLS = ["--from", "0.5,3.5", "--to", "5.5,3.5"]
GUARD = ["guard", "--world", "yard.sdf", "--start", "0,-2,90", *COARSE]
MESHED = world(FLOOR, *FENCE, """<model name="rock"><static>true</static><pose>1 1 0 0 0 0</pose><link name="link"><collision name="body">
<geometry><mesh><uri>{}</uri></mesh></geometry></collision></link></model>
""")
HILLY = world("""<model name="hill"><static>true</static><link name="link"><collision name="body"><geometry><heightmap>
<uri>{}</uri><size>8 8 0.5</size><pos>0 0 0</pos></heightmap></geometry></collision></link></model>
""")
CAMERA = """image_width: 64
image_height: 64
camera_matrix:
  rows: 3
  cols: 3
  data: [60, 0, 31.5, 0, 60, 31.5, 0, 0, 1]
"""
ROOM = "(0,0) (6,0) (6,4) (0,4)\n---\n(2,1) (3,1) (3,2) (2,2)\n---\n(1,1) (5,3)\n"
MRCLAM = {"Robot1_Odometry.dat": "# t v w\n" + "".join(f"{i} 0.5 0.1\n" for i in range(9)),
          "Robot1_Measurement.dat": "# t id range bearing\n" + "".join(f"{i}.5 14 {3 - 0.2 * i:.1f} 0.2\n" for i in range(8)),
          "Barcodes.dat": "# subject barcode\n1 5\n6 14\n", "Landmark_Groundtruth.dat": "6 3 1 0.01 0.01\n"}
TUM = "".join(f"{i} {i} 0 0 0 0 0 1\n" for i in range(9))
PLAN = 'job: plan\nmap: small.map\nfrom: "0.5,0.5"\nto: "5.5,0.5"\nplanner: theta_star\n'
STL = b"solid".ljust(80) + struct.pack("<I", 4) + b"".join(
    struct.pack("<12fH", 0, 0, 1, *a, *b, *c, 0) for a, b, c in [((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (1, 0, 0), (0, 0, 1)),
                                                                 ((0, 0, 0), (0, 1, 0), (0, 0, 1)), ((1, 0, 0), (0, 1, 0), (0, 0, 1))])
STL_TEXT = "solid a\n" + "".join(f"facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 {z}\nvertex 0 1 {z}\nendloop\nendfacet\n"
                                for z in (0, 1)) + "endsolid a\n"
DAE = """<?xml version="1.0"?>
<COLLADA><asset><unit meter="1"/></asset><library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="a" count="12">0 0 0 1 0 0 1 1 0 0 1 1</float_array><technique_common><accessor stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 1 2 0 2 3</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">
<translate>0.1 0 0</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""
IMAGE = bombs.png(8, 8, bombs.zlib.compress(b"".join(b"\0" + bytes([255] * 6 + [90, 0]) for _ in range(8))))
PGM = b"P5\n8 8\n255\n" + bytes([254] * 56 + [0] * 8)
ASC = "ncols 9\nnrows 9\nxllcorner -4\nyllcorner -4\ncellsize 1\n" + "0 0.1 0.2 0.3 0.3 0.2 0.1 0 0\n" * 9
BESIDE = {"yard.sdf": YARD, "targets.txt": TARGETS, "walkers.txt": "type=1 x=-1.5 y=1\nname=fox size=0.3,0.3,0.3 x=1.8 y=1.9\n", "small.map": MAP, "camera.yaml": CAMERA, "grey.pgm": b"P5\n64 64\n255\n" + bytes([128]) * 4096, "plan.yaml": PLAN,
          "image.png": IMAGE, "map.yaml": "image: image.png\nresolution: 0.5\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.2\n",
          "room.txt": ROOM, **MRCLAM}


def corpus(name):
    return (CORPUS / name).read_bytes()


def scenario(*lines):
    return f"job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\nplan: {{resolution: 0.2, iterations: 50}}\n" + "\n".join(lines)


def texts():
    """(name, file, content, command)."""
    laser = gzip.decompress((SOURCE / "scenarios/slam/office.log.gz").read_bytes()).splitlines(keepends=True)
    yield "sdf", "world.sdf", YARD, ["plan", FILE, *POINTS]
    for kind, content in (("mesh.stl", STL_TEXT), ("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1/1 2/2 4/4\nf -4 -2 -1\n"),
                          ("mesh.dae", DAE)):
        yield f"mesh {kind[-3:]}", kind, content, ["plan", f"with_{kind}.sdf", *POINTS]
    yield "targets", "list.txt", TARGETS, [*GUARD, "--targets", FILE]
    yield "arrivals", "list.txt", "t=1 at=1_0 by=gate\nt=5 at=fox by=gate # late\n", [
        *GUARD, "--targets", "targets.txt", "--arrivals-entrances", "gate=0,-2.5", "--arrivals-list", FILE]
    yield "history", "history.csv", "t,id,x,y\n0,fox,1,2\n1,fox,1.5,2\n2,fox,1.8,1.9\n", [
        *GUARD, "--targets", "walkers.txt", "--wander-speed", "0.5", "--wander-history", FILE]
    yield "scenario guard", "guard.yaml", scenario("supplies: {stations: 'well=-2,-2,water dock=0,-2.3,charge'}"), ["run", FILE]
    yield "scenario moved", "guard.yaml", scenario("moved: crate=1.5,-2,90", "removed: north"), ["run", FILE]
    yield "scenario plan", "plan2.yaml", PLAN, ["run", FILE]
    yield "map yaml", "m.yaml", BESIDE["map.yaml"], ["plan", FILE, "--from", "1,2", "--to", "2,2"]
    yield "pgm text", "m.pgm", "P2\n6 6\n255\n" + "254 254 254 254 254 0\n" * 6, ["plan", FILE, "--from", "0.1,0.1", "--to", "0.2,0.1", "--radius", "0"]
    yield "movingai map", "m.map", MAP, ["plan", FILE, *CELLS]
    yield "movingai scen", "m.scen", "version 1\n0 small.map 6 4 0 0 5 0 7\n0 small.map 6 4 1 1 5 3 6\n", ["fleet", "small.map", "--agents", FILE]
    yield "camera", "cam.yaml", CAMERA, ["detect", "grey.pgm", "--calibration", FILE]
    yield "terrain", "hill.asc", ASC, [*GUARD, "--targets", "targets.txt", "--terrain", FILE]
    yield "costs", "mud.asc", "ncols 6\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + "1 2 3 1 1 1\n" * 4, [
        "plan", "small.map", *CELLS, "--costs", FILE, "--planner", "terrain_a_star"]
    yield "polygons", "room2.txt", ROOM, ["plan", FILE, "--query", "1"]
    yield "slices", "walls.csv", "0,0,3,0\n3,0,3,2\n3,2,0,2\n0,2,0,0\nhouse,box,1,1,1.2,1,1.2,1.2,1,1.2\n", [
        "explore", FILE, "--start", "0.6,0.6,0"]
    yield "carmen", "scan.log", b"".join(laser[:60]), ["slam", FILE]
    for name in ("small.g2o", "space.g2o", "toro.graph"):
        yield name, name, corpus(f"pose_graph/{name}"), ["slam", FILE]
    yield "pyfg", "graph.pyfg", ("VERTEX_SE2 0.0 A0 0 0 0\nVERTEX_SE2 1.0 A1 1 0 0\nVERTEX_SE2 2.0 A2 2 0 0\n"
                                 "EDGE_SE2 0.0 A0 A1 1 0 0 0.1 0 0 0.1 0 0.1\nEDGE_SE2 1.0 A1 A2 1 0 0 0.1 0 0 0.1 0 0.1\n"), ["slam", FILE]
    yield "freiburg", "log.dat", corpus("landmark_logs/freiburg.log"), ["slam", FILE]
    yield "chain", "chain.dat", "".join(f"ODOMETRY {i} {i + 1} 1 0 0.1 0.1 0 0 0.1 0 0.1\n" for i in range(5)), ["slam", FILE]
    for name, content in MRCLAM.items():
        yield f"mrclam {name}", name, content, ["slam", "Robot1_Odometry.dat"]
    for ending in ("json", "xml", "yaml", "txt"):
        yield f"area {ending}", f"a.{ending}", corpus(f"cover_area/area.{ending}"), ["cover", FILE, "--width", "0.5"]
    yield "area feature", "f.geojson", (b'{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"a":[1,{"b":null}]},'
                                        b'"geometry":{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,3],[0,0]]]}}]}'), ["cover", FILE, "--width", "0.5"]
    yield "pursuit", "hunt.txt", corpus("pursuit_map/small.txt"), ["pursue", FILE]
    yield "calibration", "runs.csv", b"".join((SOURCE / "scenarios/waypoints/runs.csv").read_bytes().splitlines(keepends=True)[:40]), ["calibrate", FILE]
    yield "calibration result", "wheels.yaml", (SOURCE / "scenarios/waypoints/calibration.yaml").read_bytes()[:1500], [
        "drive", "--waypoints", "0,0,0 0.2,0,0", "--tags", "1=2,0,180", "--calibration", FILE]
    yield "tum", "way.tum", TUM, ["convert", FILE, "out.mcap"]
    yield "kitti", "way.kitti", "1 0 0 1 0 1 0 0 0 0 1 0\n" * 9, ["convert", FILE, "out.tum"]
    yield "run.json", "kept/run.json", None, ["replay", FILE]
    yield "manifest", "swept/manifest.json", None, ["sweep", "swept", "--merge"]


def binaries():
    for name, content in (("binary.stl", STL),):
        yield "mesh binary", name, content, ["plan", f"with_{name}.sdf", *POINTS]
    yield "map png", "m.png", IMAGE, ["plan", FILE, "--from", "0.1,0.1", "--to", "0.2,0.1", "--radius", "0"]
    yield "map pgm", "m.pgm", PGM, ["plan", FILE, "--from", "0.1,0.1", "--to", "0.2,0.1", "--radius", "0"]
    yield "photo png", "p.png", IMAGE, ["detect", FILE]
    yield "photo jpeg", "p.jpg", (SOURCE / "docs/tags-rendered.jpg").read_bytes(), ["detect", FILE]
    yield "terrain png", "hill.png", bombs.png(9, 9, bombs.zlib.compress((b"\0" + bytes(range(9))) * 9)), [
        *GUARD, "--targets", "targets.txt", "--terrain", FILE, "--terrain-size", "8,8,0.2"]
    yield "heightmap png", "high.png", bombs.png(9, 9, bombs.zlib.compress((b"\0" + bytes(range(9))) * 9)), ["plan", "with_high.png.sdf", *POINTS]
    yield "costs png", "mud.png", bombs.png(6, 4, bombs.zlib.compress((b"\0" + bytes(range(6))) * 4)), [
        "plan", "small.map", *CELLS, "--costs", FILE, "--planner", "terrain_a_star"]
    for planner in ("octile_labels", "hub_labels"):
        yield f"index {planner}", f"{planner}.index", None, [
            "plan", "small.map", "--model", {"octile_labels": "cells", "hub_labels": "corners"}[planner], "--from", "0,0", "--to", "5,3",
            "--planner", planner, "--index", FILE]
    for name in ("none", "lz4", "zstd", "attachment", "unchunked"):
        yield f"mcap {name}", f"{name}.mcap", corpus(f"mcap/{name}.mcap"), ["convert", FILE, "out.mcap"]
    yield "mcap plain", "plain.mcap", bombs.mcap_log(), ["convert", FILE, "out.jsonl"]
    yield "mcap numpy", "plain.mcap", bombs.mcap_log(), ["convert", FILE, "out.npz"]
    yield "mcap poses", "plain.mcap", bombs.mcap_log(), ["convert", FILE, "out.tum"]
    yield "run.mcap", "kept/run.mcap", None, ["replay", FILE, "--svg", "out.svg"]
    for name in ("none", "bz2", "lz4", "unindexed"):
        yield f"bag {name}", f"{name}.bag", corpus(f"bag/{name}.bag"), ["convert", FILE, "out.jsonl"]
    yield "bag plain", "plain.bag", bombs.bag_with(b"int8 a\nstring b\np/E[] e\n====\nMSG: p/E\nfloat64[2] x\n",
                                                   b"\x01" + bombs.counted(b"ab") + bombs.u32(1) + bytes(16)), ["convert", FILE, "out.mcap"]
    for name in ("humble", "jazzy"):
        yield f"db3 {name}", f"{name}.db3", corpus(f"db3/{name}.db3"), ["convert", FILE, "out.mcap"]


def beside(folder, run_tool):
    """Writes the files that the commands need into a folder, and what the tool itself leaves of a run and a sweep."""
    for name, content in BESIDE.items():
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    for name in ("mesh.stl", "mesh.obj", "mesh.dae", "binary.stl"):
        (folder / f"with_{name}.sdf").write_text(MESHED.format(name))
    (folder / "with_high.png.sdf").write_text(HILLY.format("high.png"))
    for words in (["plan", "small.map", *CELLS, "--out", "kept"], ["sweep", "plan.yaml", "--runs", "4", "--out", "swept"],
                  *([*words[:-1], file] for name, file, _, words in binaries() if name.startswith("index "))):
        done = run_tool(words)
        assert done.status == 0, (words, done.output)


def seeds(folder):
    """All of them; `folder` is where beside() wrote."""
    for binary, made in ((False, texts()), (True, binaries())):
        for name, file, content, words in made:
            if content is None:
                content = (folder / file).read_bytes()
            elif isinstance(content, str):
                content = content.encode()
            yield Seed(name, file, content, [file if word is FILE else word for word in words], binary)
