"""Hostile files made by hand: small ones that unpack to much, chains, deep nestings, and fields that lie."""
import gzip
import io
import sqlite3
import struct
import tempfile
import zlib

MIB = 1 << 20
MAGIC = b"\x89MCAP0\r\n"


def u16(value):
    return struct.pack("<H", value)


def u32(value):
    return struct.pack("<I", value)


def u64(value):
    return struct.pack("<Q", value)


def counted(content):
    return u32(len(content)) + content


def gzipped(start, unit, count, end=b"\n\xff"):
    """A gzip file of `start`, `unit` again and again, and `end`; it is made piece by piece."""
    packed = io.BytesIO()
    with gzip.GzipFile(fileobj=packed, mode="wb", compresslevel=1, mtime=0) as out:
        out.write(start)
        at_once = max(1, MIB // len(unit))
        for left in range(count, 0, -at_once):
            out.write(unit * min(left, at_once))
        out.write(end)
    return packed.getvalue()


# ---- Frames that repeat one byte, or one unit, without the library that would write them ----

def zstd_of_zeros(size):
    """A frame of blocks that repeat a byte (RFC 8878, 3.1.1)."""
    block = 128 << 10
    frame = b"\x28\xb5\x2f\xfd" + bytes([0x00, 0x38])  # without a size; a window of 128 KiB
    for left in range(size, 0, -block):
        head = min(left, block) << 3 | 1 << 1 | (left <= block)
        frame += struct.pack("<I", head)[:3] + b"\x00"
    return frame


def lz4_of(unit, size):
    """A frame of blocks of 4 MiB: a unit, then matches that repeat it (the LZ4 frame and block formats)."""
    frame = b"\x04\x22\x4d\x18\x60\x70\x73"
    while size > 0:
        length = min(size, 4 * MIB // len(unit) * len(unit))
        match, literals = length - len(unit) - 5, len(unit)
        if match < 19:
            return frame + u32(0x80000000 | length) + (unit * length)[:length] + u32(0)
        tail = (unit * (length // len(unit) + 2))[literals + match:][:5]

        def rest(count):
            return b"\xff" * (count // 255) + bytes([count % 255])

        token = min(literals, 15) << 4 | 15
        block = bytes([token]) + (rest(literals - 15) if literals >= 15 else b"") + unit
        block += u16(literals) + rest(match - 4 - 15) + bytes([5 << 4]) + tail
        frame += u32(len(block)) + block
        size -= length
    return frame + u32(0)


# ---- MCAP ----

def record(op, content):
    return bytes([op]) + u64(len(content)) + content


def schema(number, name, encoding, text):
    return record(3, u16(number) + counted(name) + counted(encoding) + counted(text))


def channel(number, schema_number, topic, encoding=b"cdr"):
    return record(4, u16(number) + u16(schema_number) + counted(topic) + counted(encoding) + u32(0))


def message(number, time, data):
    return record(5, u16(number) + u32(0) + u64(time) + u64(time) + data)


def chunk(size, packed, codec=b"", begin=0, end=1 << 62):
    return record(6, u64(begin) + u64(end) + u64(size) + u32(0) + counted(codec) + u64(len(packed)) + packed)


def mcap(*parts):
    return MAGIC + record(1, counted(b"") + counted(b"")) + b"".join(parts) + record(15, u32(0)) + \
        record(2, u64(0) + u64(0) + u32(0)) + MAGIC


def mcap_log(encoding=b"cdr", text=b"", data=(b"\x00\x01\x00\x00" + bytes(8) + b"\x01" + bytes(7) + bytes(48) + b"\x00" * 6 + b"\xf0\x3f",), kind=b"geometry_msgs/msg/PoseStamped",
             schema_encoding=b"ros2msg"):
    """A log without checksums, so that any of its bytes may change."""
    parts = schema(1, kind, schema_encoding, text) + channel(1, 1, b"/pose", encoding)
    parts += b"".join(message(1, i, one) for i, one in enumerate(data))
    return mcap(chunk(len(parts), parts))


# ---- ROS 1 bags ----

def bag_record(op, fields, data):
    head = b"".join(counted(name + b"=" + value) for name, value in [*fields, (b"op", bytes([op]))])
    return counted(head) + counted(data)


def connection(number, topic, kind, definition):
    sent = [(b"topic", topic), (b"type", kind), (b"md5sum", b"0" * 32), (b"message_definition", definition)]
    return bag_record(7, [(b"conn", u32(number)), (b"topic", topic)],
                      b"".join(counted(name + b"=" + value) for name, value in sent))


def bag_message(number, second, data):
    return bag_record(2, [(b"conn", u32(number)), (b"time", u32(second) + u32(0))], data)


def bag_chunk(size, packed, codec=b"none"):
    return bag_record(5, [(b"compression", codec), (b"size", u32(size))], packed)


def bag(*parts):
    """Without an index, which is then made by reading the chunks."""
    return b"#ROSBAG V2.0\n" + bag_record(3, [(b"index_pos", u64(0)), (b"conn_count", u32(0)), (b"chunk_count", u32(0))],
                                          b" " * 100) + b"".join(parts)


def bag_with(definition, data=b"", kind=b"p/T"):
    parts = connection(0, b"/t", kind, definition) + bag_message(0, 1, data)
    return bag(bag_chunk(len(parts), parts))


def chain(count):
    """A definition in which each type has the next one as its field."""
    return b"0 a\n" + b"".join(b"MSG:p/%x\n%x a\n" % (i, i + 1) for i in range(count)) + b"MSG:p/%x\n" % count


# ---- SQLite ----

def database(*statements):
    with tempfile.NamedTemporaryFile(suffix=".db3") as file:
        made = sqlite3.connect(file.name, isolation_level=None)
        for statement in statements:
            made.executescript(statement)
        made.close()
        with open(file.name, "rb") as written:
            return bytearray(written.read())


TOPICS = ("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT, offered_qos_profiles TEXT);"
          "INSERT INTO topics VALUES(1, '/t', 'a/msg/B', 'cdr', '');")
MESSAGES = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);"


def many(table, columns, values, count):
    return (f"WITH RECURSIVE n(i) AS (VALUES(1) UNION ALL SELECT i + 1 FROM n WHERE i < {count}) "
            f"INSERT INTO {table}({columns}) SELECT {values} FROM n;")


def pages_that_repeat(levels=8, width=60, page=512):
    """A database whose tree of messages has the same child again and again on each level: 60^8 rows in 8 kB."""
    data = database(f"PRAGMA page_size={page};", TOPICS, MESSAGES)
    root, first = 3, len(data) // page + 1

    def interior(child):
        cells = b"".join(struct.pack(">I", child) + bytes([key + 1]) for key in range(width))
        at = page - len(cells)
        head = struct.pack(">BHHHBI", 5, 0, width, at, 0, child)
        return (head + b"".join(struct.pack(">H", at + 5 * i) for i in range(width))).ljust(at, b"\0") + cells

    row = bytes([5, 1, 5, 0, 9, 8, 12])  # 5 bytes, row 1: no id, topic 1, time 0, an empty blob
    leaf = (struct.pack(">BHHHBH", 13, 0, 1, page - len(row), 0, page - len(row))).ljust(page - len(row), b"\0") + row
    data[page * (root - 1):page * root] = interior(first)
    for level in range(1, levels):
        data += interior(first + level)
    data += leaf
    data[28:32] = struct.pack(">I", len(data) // page)
    data[92:96] = data[24:28]
    return bytes(data)


# ---- Images ----

def png(width, height, rows, depth=8, colour=0):
    def part(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    return (b"\x89PNG\r\n\x1a\n" + part(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)) +
            part(b"IDAT", rows) + part(b"IEND", b""))


def zeros(size):
    packer = zlib.compressobj(9)
    packed = b"".join(packer.compress(bytes(MIB)) for _ in range(size // MIB))
    return packed + packer.compress(bytes(size % MIB)) + packer.flush()


def png_bomb(side, depth):
    return png(side, side, zeros(side * (side * depth // 8 + 1)), depth)
