"""A building of many rooms, whose exploration takes some seconds and some thousand messages."""
ROOM = 40  # cells of 0.1 m
SCENARIO = 'job: explore\nworld: building.yaml\nstart: "2,2,90"\nseed: 1\n'


def write_building(test, rooms=6):
    """Writes building.yaml, a map of rooms x rooms rooms with doors between them. Returns the text of a scenario."""
    side = rooms * ROOM + 1
    rows = [bytearray(b"\xfe" * side) for _ in range(side)]
    for wall in range(rooms + 1):
        for i in range(side):
            door = 12 <= i % ROOM < 28 and 0 < wall < rooms
            if not door:
                rows[wall * ROOM][i] = rows[i][wall * ROOM] = 0
    test.write("building.pgm", b"P5 %d %d 255\n" % (side, side) + b"".join(rows))
    test.write("building.yaml", "image: building.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
                                "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
    return SCENARIO
