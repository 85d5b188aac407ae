"""Bombs of each codec, chains of types and deep nestings: (name, file, content, command) of each."""
import bz2
import functools

import hostile_bombs as bombs
from hostile_bombs import MIB, u32
from hostile_seeds import BESIDE, CELLS, FILE, GUARD, POINTS, texts
from tool import YARD

CONVERT = ["convert", FILE, "out.mcap"]
DEEP = 300_000
TREES = {"json": (b'{"a":[', b"]}"), "xml": (b"<a>", b"</a>"), "yaml": (b"{a: [", b"]}")}


def nested(kind, start=b"", end=b"", depth=DEEP):
    opening, closing = TREES[kind]
    return start + opening * depth + closing * depth + end


def gzip_bombs():
    """Each text with one of its lines, again and again, up to 250 MiB, from some hundred kB."""
    for name, file, content, words in texts():
        if content is None:
            continue
        content = content if isinstance(content, bytes) else content.encode()
        rows = content.splitlines(keepends=True)
        row = rows[len(rows) // 2] if len(rows) > 1 else b"\n"
        yield f"gzip of lines: {name}", file, lambda c=content, r=row: bombs.gzipped(c, r, 250 * MIB // len(r)), words
    for name, file, content, words in texts():
        if name in ("sdf", "targets", "movingai map", "carmen", "area json", "tum", "small.g2o", "polygons", "calibration"):
            yield f"gzip of blanks: {name}", file, lambda: bombs.gzipped(b"", b" ", 250 * MIB), words
            yield f"gzip of one line: {name}", file, lambda: bombs.gzipped(b"", b"1 ", 100 * MIB), words


def image_bombs():
    one, half, eight = (functools.partial(bombs.png_bomb, 10000, depth) for depth in (1, 4, 8))
    plan = ["plan", FILE, "--from", "0.1,0.1", "--to", "0.2,0.1", "--radius", "0"]
    for name, png in (("1", one), ("4", half), ("8", eight)):
        yield f"png of 100 million pixels of {name} bit: map", "m.png", png, plan
        yield f"png of 100 million pixels of {name} bit: photo", "p.png", png, ["detect", FILE]
        yield f"png of 100 million pixels of {name} bit: terrain", "h.png", png, [*GUARD, "--targets", "targets.txt", "--terrain", FILE]
        yield f"png of 100 million pixels of {name} bit: costs", "c.png", png, ["plan", "small.map", *CELLS, "--costs", FILE]
        yield f"png of 100 million pixels of {name} bit: heights", "high.png", png, ["plan", "with_high.png.sdf", *POINTS]
        yield f"png of 100 million pixels of {name} bit: explore", "m.png", png, ["explore", FILE, "--start", "1,1,0"]
        yield f"png of 100 million pixels of {name} bit: cover", "image.png", png, ["cover", "map.yaml", "--width", "2"]
    yield "png that states more", "m.png", lambda: bombs.png(100_000, 1000, bombs.zeros(1000)), plan
    for side in (b"100000 100000", b"4294967296 4294967296", b"-1 5", b"99999999999999999999 1"):
        yield f"pgm of {side.decode()}", "m.pgm", lambda s=side: b"P5\n" + s + b"\n255\n" + bytes(5000), plan
    yield "pgm in gzip", "m.pgm", lambda: bombs.gzipped(b"P5\n10000 10000\n255\n", b"\xfe", 100_000_000), plan
    yield "cells in gzip", "m.map", lambda: bombs.gzipped(b"type octile\nheight 10000\nwidth 9999\nmap\n", b"." * 9999 + b"\n", 10000, b""), [
        "plan", FILE, *CELLS]
    for sizes in ("height 100000\nwidth 1000", "height -1\nwidth 4", "height 4294967297\nwidth 1"):
        yield f"cells: {sizes}", "m.map", lambda s=sizes: f"type octile\n{s}\nmap\n....\n".encode(), ["plan", FILE, *CELLS]
    yield "a pursuit of 100000 x 1000", "h.txt", lambda: b"N\n100000,1000\nC\n9\nR\n1,1\nT\n1,1\nM\n1\n", ["pursue", FILE]
    yield "asc of 100000 x 1000", "h.asc", lambda: b"ncols 100000\nnrows 1000\ncellsize 1\n1 2 3\n", [*GUARD, "--targets", "targets.txt", "--terrain", FILE]


def log_bombs():
    size = 250 * MIB
    zeros = functools.cache(lambda: bz2.compress(bytes(size // 4)))
    yield "zstd of zeros", "b.mcap", lambda: bombs.mcap(bombs.chunk(size, bombs.zstd_of_zeros(size), b"zstd")), CONVERT
    message = bombs.message(1, 5, b"")
    count = size // len(message)
    head = bombs.channel(1, 0, b"/t")
    yield "lz4 of messages", "b.mcap", lambda: bombs.mcap(
        head, bombs.chunk(count * len(message), bombs.lz4_of(message, count * len(message)), b"lz4")), CONVERT
    yield "lz4 of messages in many chunks", "b.mcap", lambda: bombs.mcap(
        head, *[bombs.chunk(len(message) * 10**6, bombs.lz4_of(message, len(message) * 10**6), b"lz4")] * 60), CONVERT
    yield "zstd of zeros in many chunks", "b.mcap", lambda: bombs.mcap(*[bombs.chunk(size, bombs.zstd_of_zeros(size), b"zstd")] * 100), CONVERT
    for stated in (0, 1, (1 << 28) - 1, (1 << 32) - 1, 1 << 63, (1 << 64) - 1):
        yield f"zstd that states {stated}", "b.mcap", lambda s=stated: bombs.mcap(bombs.chunk(s, bombs.zstd_of_zeros(MIB), b"zstd")), CONVERT
        yield f"lz4 that states {stated}", "b.mcap", lambda s=stated: bombs.mcap(bombs.chunk(s, bombs.lz4_of(b"abc", MIB), b"lz4")), CONVERT
        yield f"bz2 that states {stated}", "b.bag", lambda s=stated: bombs.bag(bombs.bag_chunk(s & 0xFFFFFFFF, bz2.compress(bytes(MIB)), b"bz2")), CONVERT
    yield "bz2 of zeros", "b.bag", lambda: bombs.bag(bombs.bag_chunk(size // 4, zeros(), b"bz2")), CONVERT
    yield "bz2 of zeros in many chunks", "b.bag", lambda: bombs.bag(*[bombs.bag_chunk(size // 4, zeros(), b"bz2")] * 100), CONVERT
    said = bombs.connection(0, b"/t", b"p/T", b"")
    record = bombs.bag_message(0, 1, b"")
    small = said + record * (MIB // len(record))
    packed = functools.cache(lambda: bz2.compress(small))
    yield "bz2 of messages in many chunks", "b.bag", lambda: bombs.bag(*[bombs.bag_chunk(len(small), packed(), b"bz2")] * 1000), CONVERT
    whole = 200 * MIB // len(record) * len(record)
    yield "lz4 of messages in a bag", "b.bag", lambda: bombs.bag(
        bombs.bag_chunk(len(said), said), bombs.bag_chunk(whole, bombs.lz4_of(record, whole), b"lz4")), CONVERT
    both = bombs.bag_message(0, 1, b"") + bombs.bag_message(0, 2, bytes(1000))
    yield "lz4 of chunks that overlap", "b.bag", lambda: bombs.bag(
        bombs.bag_chunk(len(said), said),
        *[bombs.bag_chunk(len(both) * 200_000, bombs.lz4_of(both, len(both) * 200_000), b"lz4")] * 6), CONVERT
    for kind, content in (("mcap", b"\x00\x01\x00\x00\xff\xff\xff\x7f"), ("mcap", b"\x00\x01\x00\x00" + b"\xff" * 60)):
        yield f"a lying sequence in {kind}", "b.mcap", lambda c=content: bombs.mcap_log(data=(c,), kind=b"nav_msgs/msg/Path"), [
            "convert", FILE, "out.jsonl"]


def chains():
    yield "58,000 types in a chain", "c.bag", lambda: bombs.bag_with(bombs.chain(58_000)), CONVERT
    yield "30 types in a chain", "c.bag", lambda: bombs.bag_with(bombs.chain(30)), CONVERT
    yield "a package with a long name", "c.bag", lambda: bombs.bag_with(b"a b\n====\nMSG: " + b"p" * 500_000 + b"/T\n" + b"a b\n" * 100_000), CONVERT
    yield "a type with a long name", "c.bag", lambda: bombs.bag_with(b"a b\n" * 100_000, kind=b"p" * 500_000 + b"/T"), CONVERT
    yield "doubling types", "c.bag", lambda: bombs.bag_with(
        b"A0 a\nA0 b\n" + b"".join(b"====\nMSG: p/A%d\nA%d a\nA%d b\n" % (i, i + 1, i + 1) for i in range(60)) + b"====\nMSG: p/A60\n"), CONVERT
    yield "4 billion elements without bytes", "c.bag", lambda: bombs.bag_with(b"E[] e\n====\nMSG: p/E\n", u32(0xFFFFFFFF)), CONVERT
    yield "a long array without bytes", "c.bag", lambda: bombs.bag_with(b"E[4294967295] e\n====\nMSG: p/E\n"), CONVERT
    yield "an array of arrays", "c.bag", lambda: bombs.bag_with(b"E[4294967295] e\n====\nMSG: p/E\nE[4294967295] e\n"), CONVERT
    yield "10,000 connections", "c.bag", lambda: bombs.bag(
        *(bombs.bag_chunk(len(said), said) for said in [b"".join(bombs.connection(i, b"/t%d" % i, b"p/T", b"int8 a\n") for i in range(9999))])), CONVERT
    long = b"int8 a\n" * 100_000
    yield "many connections with long definitions", "c.bag", lambda: bombs.bag(*[
        bombs.bag_chunk(len(said), said)
        for i in range(100) for said in [bombs.connection(i, b"/t%d" % i, b"p/T", long)]]), CONVERT
    topics = functools.cache(lambda: b"".join(bombs.channel(i, 1, b"/t") for i in range(1, 60_000)))
    long = bombs.schema(1, b"p/msg/T", b"ros2msg", b"int8 a\n" * 140_000)
    for kind in (b"p/msg/T", b"nav_msgs/msg/Path"):
        for words in (CONVERT, ["convert", FILE, "out.jsonl"], ["replay", FILE]):
            verb = " ".join(word for word in words if word is not FILE)
            yield f"60,000 channels of {kind.decode()}: {verb}", "c.mcap", lambda k=kind: bombs.mcap(
                bombs.schema(1, k, b"ros2msg", b""), topics()), words
            yield f"a long schema of 60,000 channels of {kind.decode()}: {verb}", "c.mcap", lambda: bombs.mcap(
                long, topics()), words
    yield "json messages, nested", "c.mcap", lambda: bombs.mcap_log(b"json", b"{}", (nested("json"),), schema_encoding=b"jsonschema"), [
        "convert", FILE, "out.jsonl"]
    yield "a json schema, nested", "c.mcap", lambda: bombs.mcap_log(b"json", nested("json"), (b"{}",), schema_encoding=b"jsonschema"), [
        "convert", FILE, "out.jsonl"]


def databases():
    def made(*statements):
        return lambda: bytes(bombs.database(*statements))

    topics, messages, many = bombs.TOPICS, bombs.MESSAGES, bombs.many
    rows = many("messages", "topic_id, timestamp", "1, i", 100_000)
    yield "a column rowid", "r.db3", made(topics, messages.replace("id INTEGER PRIMARY KEY", "rowid TEXT"), many(
        "messages", "rowid, topic_id, timestamp, data", "'x', 1, i, ''", 100_000)), CONVERT
    yield "a computed column", "r.db3", made(topics, messages.replace("data BLOB", "data BLOB AS (zeroblob(200000000))"), many(
        "messages", "topic_id, timestamp", "1, i", 100)), CONVERT
    yield "a computed name", "r.db3", made(topics.replace("name TEXT,", "name TEXT AS (printf('%200000000d', 1)),").replace(
        "(1, '/t', ", "(1, "), messages), CONVERT
    yield "a long default", "r.db3", made(
        topics, messages.replace(", data BLOB", ""), rows, f"ALTER TABLE messages ADD COLUMN data TEXT DEFAULT '{'a' * 90000}'"), CONVERT
    yield "a view", "r.db3", made(topics, "CREATE VIEW messages AS WITH RECURSIVE n(i) AS (VALUES(1) UNION ALL SELECT i + 1 FROM n) "
                                          "SELECT 1 AS topic_id, i AS timestamp, '' AS data FROM n"), CONVERT
    yield "an index that computes", "r.db3", made(topics, messages, rows, "CREATE INDEX x ON messages(timestamp, length(zeroblob(1000000)))"), CONVERT
    yield "no rowid", "r.db3", made(topics, messages.replace(");", ") WITHOUT ROWID;"), "INSERT INTO messages VALUES(1, 1, 1, 'a')"), CONVERT
    yield "500 tables", "r.db3", made(topics, messages, "BEGIN;" + "".join(f"CREATE TABLE t{i}(a);" for i in range(500)) + "COMMIT"), CONVERT
    yield "a long schema", "r.db3", made(topics, messages, f"CREATE TABLE t({','.join(f'c{i}' for i in range(1900))});"), CONVERT
    yield "long texts", "r.db3", made(topics, messages, many("topics", "name, type, serialization_format, offered_qos_profiles",
                                                            "hex(randomblob(100)), 'a/msg/B', 'cdr', ''", 9000)), CONVERT
    yield "pages that repeat", "r.db3", bombs.pages_that_repeat, CONVERT


def nestings(every_depth=True):
    for name, file, words in [
            ("area json", "a.json", ["cover", FILE, "--width", "1"]), ("area gml", "a.xml", ["cover", FILE, "--width", "1"]),
            ("area yaml", "a.yaml", ["cover", FILE, "--width", "1"]), ("run.json", "kept/run.json", ["replay", FILE]),
            ("manifest", "swept/manifest.json", ["sweep", "swept", "--merge"]), ("sdf", "w.sdf", ["plan", FILE, *POINTS]),
            ("collada", "mesh.dae", ["plan", "with_mesh.dae.sdf", *POINTS]), ("scenario", "s.yaml", ["run", FILE]),
            ("map yaml", "m.yaml", ["plan", FILE, *POINTS]), ("camera", "cam.yaml", ["detect", "grey.pgm", "--calibration", FILE]),
            ("calibration", "w.yaml", ["drive", "--waypoints", "0,0,0 1,0,0", "--tags", "1=2,0,180", "--calibration", FILE])]:
        kind = {"json": "json", "xml": "xml", "sdf": "xml", "dae": "xml"}.get(file.rsplit(".")[-1], "yaml")
        deepest = DEEP if kind != "yaml" else 100_000
        for depth in (100, 10_000, deepest) if every_depth else (10_000,):
            yield f"{name} nested {depth} deep", file, lambda k=kind, d=depth: nested(k, depth=d), words
        for depth in (100, 10_000, deepest) if every_depth else (deepest,):
            yield f"{name} opened {depth} times", file, lambda k=kind, d=depth: TREES[k][0] * d, words
    cover = ["cover", FILE, "--width", "1"]
    yield "a collection of collections", "a.json", lambda: b'{"type":"GeometryCollection","geometries":[' * DEEP + b"]}" * DEEP, cover
    yield "coordinates nested", "a.json", lambda: b'{"type":"Polygon","coordinates":' + b"[" * DEEP + b"]" * DEEP + b"}", cover
    yield "a crs nested", "a.json", lambda: (b'{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,3],[0,0]]],"crs":{"properties":{"name":"x","y":' +
                                             b"[" * DEEP + b"]" * DEEP + b"}}}"), cover
    yield "json of a million brackets in gzip", "a.json", lambda: bombs.gzipped(b"", b"[", 200 * MIB), cover
    yield "json of a million points in gzip", "a.json", lambda: bombs.gzipped(b'{"type":"Polygon","coordinates":[[', b"[0,0],", 40 * MIB), cover
    yield "models in models", "w.sdf", lambda: YARD.replace(
        "</world>", "".join(f"<model name='m{i}'>" for i in range(5000)) + "</model>" * 5000 + "</world>").encode(), ["plan", FILE, *POINTS]
    yield "an xml of entities", "w.sdf", lambda: (b"<!DOCTYPE x [" + b"".join(
        b'<!ENTITY a%d "%s">' % (i + 1, b"&a%d;" % i * 10) for i in range(12)) + b"]>" + YARD.replace("court", "&a12;").encode()), ["plan", FILE, *POINTS]
    yield "yaml aliases that double", "s.yaml", lambda: b"a0: &a0 [x, x]\n" + b"".join(
        b"a%d: &a%d [*a%d, *a%d]\n" % (i + 1, i + 1, i, i) for i in range(60)), ["run", FILE]
    yield "yaml maps that double", "m.yaml", lambda: BESIDE["map.yaml"].encode() + b"a0: &a0 {x: 1}\n" + b"".join(
        b"a%d: &a%d {x: *a%d, y: *a%d}\n" % (i + 1, i + 1, i, i) for i in range(60)), ["plan", FILE, *POINTS]
    yield "a yaml list that holds itself", "s.yaml", lambda: b"job: &a [*a]\n", ["run", FILE]
    yield "a yaml map that holds itself", "s.yaml", lambda: b"job: plan\nsafest: &a {kept: *a}\n", ["run", FILE]
    yield "yaml of a million keys", "s.yaml", lambda: b"".join(b"k%d: 1\n" % i for i in range(100_000)), ["run", FILE]
    nodes = b"".join(b'<node id="n%d">%s</node>' % (i, b'<instance_node url="#n%d"/>' % (i + 1) * 10) for i in range(40))
    yield "collada nodes that multiply", "mesh.dae", lambda: b'<COLLADA><library_visual_scenes><visual_scene id="s">' + nodes + (
        b'</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>'), ["plan", "with_mesh.dae.sdf", *POINTS]


def made_by_hand():
    for family in (databases, chains, nestings, log_bombs, image_bombs, gzip_bombs):
        for name, file, content, words in family():
            yield name, file, content, [file if word is FILE else word for word in words]
