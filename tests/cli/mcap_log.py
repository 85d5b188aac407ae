"""Reads MCAP files whose chunks are not compressed, written from the specification (https://mcap.dev/spec)."""
import collections
import struct
import zlib

MAGIC = b"\x89MCAP0\r\n"
Channel = collections.namedtuple("Channel", "topic type encoding schema_encoding schema")
Message = collections.namedtuple("Message", "topic time_ns data")


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


class McapLog:
    """The channels, messages and attachments of a file, or of as much of it as there is."""

    def __init__(self, data):
        assert data[:8] == MAGIC[:len(data[:8])], data[:8]
        self.schemas, self.channels, self.messages, self.attachments = {}, {}, [], {}
        self.complete = len(data) > 16 and data[-8:] == MAGIC
        for op, content in records(data[8:]):
            if op == 0x0f:  # the data end here; the summary repeats them
                break
            self.read(op, content)

    def read(self, op, content):
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
            inner = content[at + 8:]
            assert (compression, len(inner), zlib.crc32(inner)) == ("", size, crc)
            for inner_op, inner_content in records(inner):
                self.read(inner_op, inner_content)
        elif op == 9:
            name, at = text(content, 16)
            _, at = text(content, at)
            self.attachments[name] = content[at + 8:-4]

    def of(self, topic):
        return [message for message in self.messages if message.topic == topic]


def pose_stamped(data):
    """(stamp in s, frame, x, y, z, qx, qy, qz, qw) of a geometry_msgs/msg/PoseStamped in CDR, little-endian."""
    assert data[:4] == b"\x00\x01\x00\x00", data[:4]
    seconds, nanoseconds, size = struct.unpack_from("<iII", data, 4)
    frame = data[16:16 + size].rstrip(b"\x00").decode()
    at = 4 + (12 + size + 7) // 8 * 8  # numbers of 8 bytes are aligned, counted after the first 4 bytes
    assert len(data) == at + 56, len(data)
    return (seconds + 1e-9 * nanoseconds, frame, *struct.unpack_from("<7d", data, at))
