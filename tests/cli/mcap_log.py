"""Reads MCAP files and the CDR messages in them, written from the specifications of MCAP (https://mcap.dev/spec), of ROS 2
message definitions and of CDR (OMG DDS-XTypes 1.3, encoding version 1)."""
import collections
import ctypes
import re
import struct
import types
import zlib

MAGIC = b"\x89MCAP0\r\n"
Channel = collections.namedtuple("Channel", "topic type encoding schema_encoding schema")
Message = collections.namedtuple("Message", "topic time_ns data")
NUMBERS = {"bool": "?", "byte": "B", "char": "B", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
           "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}


def zstd(data, size):
    """The content of a zstd frame, which has `size` bytes; by the library that Outrider links as well."""
    library = ctypes.CDLL("libzstd.so.1")
    library.ZSTD_decompress.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    library.ZSTD_decompress.restype = ctypes.c_size_t
    content = ctypes.create_string_buffer(size)
    assert library.ZSTD_decompress(content, size, data, len(data)) == size
    return content.raw


def text(data, at):
    size = struct.unpack_from("<I", data, at)[0]
    return data[at + 4:at + 4 + size].decode(), at + 4 + size


def records(data):
    """(opcode, content) of each record that is complete."""
    at = 0
    while at + 9 <= len(data):
        op, size = struct.unpack_from("<BQ", data, at)
        if at + 9 + size > len(data):
            return
        yield op, data[at + 9:at + 9 + size]
        at += 9 + size


def types_of(name, definition):
    """The fields of each type of a definition: (name, type, None or [] or [length])."""
    found = {}
    short = name.replace("/msg/", "/")
    for section in ("MSG: " + short + "\n" + definition).split("=" * 80 + "\n"):
        head, *lines = section.split("\n")
        fields = found[head.removeprefix("MSG: ")] = []
        for line in lines:
            words = line.split("#")[0].split()
            if not words or "=" in line.split("#")[0]:  # a constant
                continue
            kind, length = re.fullmatch(r"([\w/]+)(\[\d*\])?", words[0]).groups()
            fields.append((words[1], kind, length and [int(n) for n in re.findall(r"\d+", length)]))
    return found, short


class Decoder:
    """One message; numbers are aligned to their size, counted after the four bytes of the head."""

    def __init__(self, known, data):
        assert data[:4] == b"\x00\x01\x00\x00", data[:4]  # CDR, little-endian
        self.known, self.data, self.at = known, data[4:], 0

    def numbers(self, letter, count):
        size = struct.calcsize("<" + letter)
        if count:
            self.at += -self.at % size
        values = struct.unpack_from(f"<{count}{letter}", self.data, self.at)
        self.at += count * size
        return values

    def values(self, kind, count):
        if kind in NUMBERS:
            return list(self.numbers(NUMBERS[kind], count))
        return [self.value(kind) for _ in range(count)]

    def value(self, kind):
        if kind in NUMBERS:
            return self.numbers(NUMBERS[kind], 1)[0]
        if kind == "string":
            size = self.numbers("I", 1)[0]
            self.at += size
            return self.data[self.at - size:self.at - 1].decode()
        message = types.SimpleNamespace()
        for name, inner, length in self.known[kind]:
            setattr(message, name, self.value(inner) if length is None
                    else self.values(inner, length[0] if length else self.numbers("I", 1)[0]))
        return message


class McapLog:
    """The channels, messages and attachments of a file, or of as much of it as there is."""

    def __init__(self, data):
        assert data[:8] == MAGIC[:len(data[:8])], data[:8]
        self.schemas, self.channels, self.messages, self.attachments = {}, {}, [], {}
        self.complete = len(data) > 16 and data[-8:] == MAGIC
        for op, content in records(data[8:]):
            if op == 0x0f:  # the data end here; the summary repeats them
                break
            self.add(op, content)

    def add(self, op, content):
        if op == 3:
            name, at = text(content, 2)
            encoding, at = text(content, at)
            schema, _ = text(content, at)
            self.schemas[struct.unpack_from("<H", content)[0]] = (name, encoding, schema)
        elif op == 4:
            number, schema = struct.unpack_from("<HH", content)
            topic, at = text(content, 4)
            encoding, _ = text(content, at)
            name, schema_encoding, schema_text = self.schemas[schema]
            self.channels[number] = Channel(topic, name, encoding, schema_encoding, schema_text)
        elif op == 5:
            number, _, time_ns, _ = struct.unpack_from("<HIQQ", content)
            self.messages.append(Message(self.channels[number].topic, time_ns, content[22:]))
        elif op == 6:
            size, crc = struct.unpack_from("<QI", content, 16)
            compression, at = text(content, 28)
            inner = content[at + 8:] if compression == "" else {"zstd": zstd}[compression](content[at + 8:], size)
            assert (len(inner), zlib.crc32(inner)) == (size, crc)
            for inner_op, inner_content in records(inner):
                self.add(inner_op, inner_content)
        elif op == 9:
            name, at = text(content, 16)
            _, at = text(content, at)
            self.attachments[name] = content[at + 8:-4]

    def of(self, topic):
        return [message for message in self.messages if message.topic == topic]

    def read(self, topic):
        """(time in s, decoded message) of each message of a topic."""
        channel = next((one for one in self.channels.values() if one.topic == topic), None)
        if channel is None:
            return []
        known, name = types_of(channel.type, channel.schema)
        decoded = []
        for message in self.of(topic):
            decoder = Decoder(known, message.data)
            decoded.append((message.time_ns / 1e9, decoder.value(name)))
            assert decoder.at == len(decoder.data), (topic, decoder.at, len(decoder.data))
        return decoded

    def latest(self, topic):
        """The newest message of a topic; None if there is none."""
        messages = self.read(topic)
        return messages[-1][1] if messages else None


def xyz(point):
    """The coordinates of a message, two or three."""
    return [getattr(point, axis) for axis in "xyz" if hasattr(point, axis)]


def map_of(log):
    """The final map: its info, and its rows of cells from the lowest."""
    messages = log.read("/map") + log.read("/map_updates")
    info, rows = None, []
    for _, message in sorted(messages, key=lambda pair: pair[0]):  # of one time the whole map comes first
        part = message
        if hasattr(message, "info"):
            info = message.info
            rows = [[-1] * info.width for _ in range(info.height)]
            part = types.SimpleNamespace(x=0, y=0, width=info.width, height=info.height, data=message.data)
        for y in range(part.height):
            rows[part.y + y][part.x:part.x + part.width] = part.data[y * part.width:(y + 1) * part.width]
    return info, rows


def targets_of(log):
    """The newest message of each target by its name, with its `places`: (time in s, position message) in order."""
    found = {message.name: message for _, message in log.read("/targets")}
    for target in found.values():
        target.places = [(time, place) for time, place in log.read("/target_positions") if place.name == target.name]
    return found


def pose_stamped(data):
    """(stamp in s, frame, x, y, z, qx, qy, qz, qw) of a geometry_msgs/msg/PoseStamped in CDR, little-endian."""
    assert data[:4] == b"\x00\x01\x00\x00", data[:4]
    seconds, nanoseconds, size = struct.unpack_from("<iII", data, 4)
    frame = data[16:16 + size].rstrip(b"\x00").decode()
    at = 4 + (12 + size + 7) // 8 * 8  # numbers of 8 bytes are aligned, counted after the first 4 bytes
    assert len(data) == at + 56, len(data)
    return (seconds + 1e-9 * nanoseconds, frame, *struct.unpack_from("<7d", data, at))
