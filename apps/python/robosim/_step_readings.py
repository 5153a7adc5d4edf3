"""The numbers of a received step as arrays that refer to the message's bytes, without copies.

The generated classes convert each number to an object of Python; here only the positions are computed. A message of
protobuf is a sequence of fields, each a tag (number << 3 | wire type) and a value: 0 a varint, 1 and 5 eight and four
bytes, 2 a length (varint) and so many bytes, such as a message or a packed array, whose numbers are little-endian.

Robots of one sensor set mostly have their numbers at the same places of their readings. These places are determined for
the first robot; for the others it suffices to compare the bytes between the numbers. Otherwise (such as a picture of
another length) each robot's readings are examined.
"""
import struct

import numpy as np

# Fields of Measurement (sensors.proto) with numbers, and their types. Field 4 is a file, 7 a ray-cast picture.
_TYPES = {1: np.dtype("<f4"), 2: np.dtype("<f8"), 3: np.dtype("u1"), 4: np.dtype("u1"), 7: np.dtype("u1")}
_MEASUREMENT_TAG = 1 << 3 | 2  # RobotReadings.measurements
_ROBOT_TAG = 2 << 3 | 2  # StepReadings.robots
_STALLED = (2 << 3, 1)  # bytes of RobotReadings.stalled
_NOTHING = (1, 0, 0)


def read_varint(data, at):
    """The number at a position, and the position after it."""
    number = shift = 0
    while True:
        byte = data[at]
        at += 1
        number |= (byte & 0x7F) << shift
        if byte < 0x80:
            return number, at
        shift += 7


def read_fields(data, at, end):
    """The fields in a range of bytes: number, wire type, begin and end of each value's bytes."""
    while at < end:
        tag, at = read_varint(data, at)
        wire_type = tag & 7
        if wire_type == 0:
            after = read_varint(data, at)[1]
        elif wire_type == 2:
            size, at = read_varint(data, at)
            after = at + size
        elif wire_type in (1, 5):
            after = at + (8 if wire_type == 1 else 4)
        else:
            raise ValueError(f"a message has the wire type {wire_type}, which protobuf 3 does not have")
        if after > end:
            raise ValueError("a message ends within a field")
        yield tag >> 3, wire_type, at, after
        at = after


class _Layout:
    """Places of the numbers in the readings of a robot, relative to their first byte."""

    def __init__(self, data, begin, end, sensors):
        self.numbers = []  # of each sensor: field of Measurement, begin, size
        is_number = bytearray(end - begin)  # by byte: 1: of a number; 2: of a varint that may change
        at = begin
        while at < end and data[at] == _MEASUREMENT_TAG:
            size, inner = read_varint(data, at + 1)
            at = inner + size
            found = _NOTHING
            for number, wire_type, first, after in read_fields(data, inner, at):
                if number in _TYPES and wire_type == 2 and after > first:
                    found = (number, first - begin, after - first)
                    is_number[first - begin:after - begin] = b"\1" * (after - first)
                elif wire_type == 0:
                    is_number[first - begin:after - begin] = b"\2" * (after - first)
            self.numbers.append(found)
        if len(self.numbers) != sensors or at > end:
            raise ValueError(f"readings of {len(self.numbers)} sensors for a robot that has {sensors}")
        self.size = at - begin
        kind = np.frombuffer(is_number, np.uint8)[:self.size]
        self._places = np.flatnonzero(kind != 1)
        # Of a varint only its length is compared.
        self._mask = np.where(kind[self._places] == 2, 0x80, 0xFF).astype(np.uint8)
        self._expected = np.frombuffer(data, np.uint8, self.size, begin)[self._places] & self._mask
        # The same of all bytes, as large numbers: less time than arrays for a single robot.
        masks = np.zeros(self.size, np.uint8)
        masks[self._places] = self._mask
        self._all_masks = int.from_bytes(masks, "little")
        self._all_expected = int.from_bytes(data[begin:at], "little") & self._all_masks

    def fits_one(self, data, begin, end):
        """Whether the readings of one robot have this layout."""
        if end - begin < self.size:
            return False
        return int.from_bytes(data[begin:begin + self.size], "little") & self._all_masks == self._all_expected

    def fits(self, bytes_, begins, ends):
        """Whether the readings that begin there have this layout."""
        if (ends - begins < self.size).any():
            return False
        return bool(((bytes_[begins[:, None] + self._places] & self._mask) == self._expected).all())


class StepDecoder:
    """Decodes the steps of a connection."""

    def __init__(self, sensor_counts, robots_by_set):
        """sensor_counts: sensors of each set. robots_by_set: for each set the array of its robots' indices."""
        self.sensor_counts = sensor_counts
        self.robots_by_set = robots_by_set
        self.robots = sum(len(robots) for robots in robots_by_set)
        self._last = [None] * len(robots_by_set)  # by set: a layout that its robots have had

    def layouts_of(self, index_of_set, data, begins, ends):
        """The layout of the readings of a set's robots; a list with one for each robot if they differ."""
        sensors = self.sensor_counts[index_of_set]
        layout = self._last[index_of_set]
        if len(begins) == 1:
            begin, end = int(begins[0]), int(ends[0])
            if layout is None or not layout.fits_one(data, begin, end):
                layout = self._last[index_of_set] = _Layout(data, begin, end, sensors)
            return layout
        bytes_ = np.frombuffer(data, np.uint8)
        if layout is None or not layout.fits(bytes_, begins, ends):
            layout = _Layout(data, int(begins[0]), int(ends[0]), sensors)
            if not layout.fits(bytes_, begins, ends):
                return [_Layout(data, begin, end, sensors) for begin, end in zip(begins.tolist(), ends.tolist())]
            self._last[index_of_set] = layout
        return layout


class StepReadings:
    """The readings of a step, of all robots of a connection."""

    def __init__(self, data, decoder):
        """data: bytes of a DriveResponse with readings."""
        self.step, self.winner = 0, ""
        self._data = data
        self._robots_by_set = decoder.robots_by_set
        begins, ends = self._find_robots(data)
        if len(begins) != decoder.robots:
            raise ValueError(f"readings of {len(begins)} robots; there are {decoder.robots}")
        self.stalled, self.is_too_far = np.zeros(len(begins), bool), np.zeros(len(begins), bool)
        self.inboxes = {}  # by robot, if there are messages: list of (sender, bytes)
        self._layouts = []  # by set, as StepDecoder.layouts_of() returns them
        self._begins = begins if len(begins) == 1 else np.array(begins, np.intp)
        if len(begins) == 1:
            layout = decoder.layouts_of(0, data, begins, ends)
            self._layouts.append(layout)
            if begins[0] + layout.size < ends[0]:
                self._read_rest(0, begins[0] + layout.size, ends[0])
            return
        all_ends = np.array(ends, np.intp)
        for index_of_set, robots in enumerate(self._robots_by_set):
            first, after = self._begins[robots], all_ends[robots]
            layouts = decoder.layouts_of(index_of_set, data, first, after)
            self._layouts.append(layouts)
            size = [layout.size for layout in layouts] if isinstance(layouts, list) else layouts.size
            self._read_rests(robots, first + size, after)

    def _find_robots(self, data):
        begins, ends = [], []
        for number, _, begin, end in read_fields(data, 0, len(data)):
            if number != 2:
                continue
            at = begin
            while at < end:
                if data[at] == _ROBOT_TAG:
                    size, first = data[at + 1], at + 2
                    if size >= 0x80:
                        size, first = read_varint(data, at + 1)
                    at = first + size
                    begins.append(first)
                    ends.append(at)
                    continue
                for of_step, _, first, at in read_fields(data, at, end):
                    if of_step == 1:
                        self.step = read_varint(data, first)[0]
                    elif of_step == 3:
                        self.winner = data[first:at].decode()
                    break
            if at > end:
                raise ValueError("a message ends within a field")
        return begins, ends

    def _read_rests(self, robots, begins, ends):
        """Reads what follows the measurements of some robots: mostly nothing, or `stalled` only."""
        sizes = ends - begins
        if not sizes.any():
            return
        bytes_ = np.frombuffer(self._data, np.uint8)
        is_stalled = sizes == 2
        is_stalled[is_stalled] = ((bytes_[begins[is_stalled]] == _STALLED[0]) &
                                  (bytes_[begins[is_stalled] + 1] == _STALLED[1]))
        self.stalled[robots[is_stalled]] = True
        others = (sizes > 0) & ~is_stalled
        for robot, begin, end in zip(robots[others].tolist(), begins[others].tolist(), ends[others].tolist()):
            self._read_rest(robot, begin, end)

    def _read_rest(self, robot, begin, end):
        for number, _, first, after in read_fields(self._data, begin, end):
            if number == 2:
                self.stalled[robot] = self._data[first] != 0
            elif number == 5:
                self.is_too_far[robot] = self._data[first] != 0
            elif number == 4:
                message = {1: b"", 2: b""}
                for part, _, at, to in read_fields(self._data, first, after):
                    message[part] = self._data[at:to]
                self.inboxes.setdefault(robot, []).append((message[1].decode(), message[2]))

    def numbers(self, index_of_set, sensor, width):
        """Numbers of a sensor of the robots of a set: shape (robots, records, width), read-only; numbers beyond whole records,
        such as the lateral speed of odometry, are left out. A view of the message if
        the robots' readings have equal distances, which is so unless one of several robots is stalled or has messages."""
        layouts, robots = self._layouts[index_of_set], self._robots_by_set[index_of_set]
        begins = self._begins if len(self._begins) == 1 else self._begins[robots]
        if isinstance(layouts, list):
            places = [layout.numbers[sensor] for layout in layouts]
            rows = [np.frombuffer(self._data, np.uint8, size, begin + first)
                    for begin, (_, first, size) in zip(begins.tolist(), places)]
            field = next((field for field, _, size in places if size), 1)
            size = max(size // (_TYPES[field].itemsize * width) for _, _, size in places) * _TYPES[field].itemsize * width
            # A robot without a measurement has NaN, or 0.
            blank = np.full(size // _TYPES[field].itemsize, np.nan if field < 3 else 0, _TYPES[field]).view(np.uint8)
            gathered = np.stack([row[:size] if len(row) >= size else blank for row in rows]).view(_TYPES[field])
            return _read_only(gathered.reshape(len(begins), -1, width))
        field, first, size = layouts.numbers[sensor]
        dtype = _TYPES[field]
        size -= size % (dtype.itemsize * width)
        shape = (len(begins), size // (dtype.itemsize * width), width)
        if size == 0:
            return _read_only(np.empty(shape, dtype))
        distance = int(begins[1] - begins[0]) if len(begins) > 1 else 0
        if len(begins) < 3 or (begins[1:] - begins[:-1] == distance).all():
            return np.ndarray(shape, dtype, self._data, int(begins[0]) + first,
                              (distance, dtype.itemsize * width, dtype.itemsize))
        windows = np.lib.stride_tricks.sliding_window_view(np.frombuffer(self._data, np.uint8), size)
        return _read_only(windows[begins + first].view(dtype).reshape(shape))

    def file(self, robot, index_of_set, sensor):
        """Bytes of a camera's picture; empty in steps without one."""
        layouts, robots = self._layouts[index_of_set], self._robots_by_set[index_of_set]
        layout = layouts[int(np.flatnonzero(robots == robot)[0])] if isinstance(layouts, list) else layouts
        _, first, size = layout.numbers[sensor]
        begin = int(self._begins[robot]) + first
        return self._data[begin:begin + size]


def _read_only(array):
    array.flags.writeable = False
    return array


class StepAnswer:
    """The answer to a step: a message whose commands are an array. A robot's command has a fixed length, because its index
    is a varint of three bytes."""

    _COMMAND = struct.Struct("<BBB3sBBBdBd")

    def __init__(self, robots):
        def index(i):
            return bytes((i & 0x7F | 0x80, i >> 7 & 0x7F | 0x80, i >> 14))

        size = self._COMMAND.size
        # StepAnswer.commands: RobotCommand of process_robot and command: Command of speed_mps and turn_radps.
        self._bytes = bytearray().join(
            self._COMMAND.pack(0x12, size - 2, 0x08, index(i), 0x12, 18, 0x09, 0.0, 0x11, 0.0) for i in range(robots))
        self.commands = np.ndarray((robots, 2), "<f8", self._bytes, 9, (size, 9))

    def message(self, step, others=b""):
        """Bytes of a DriveRequest. others: bytes of a StepAnswer with further fields."""
        head = b"\x08" + _varint(step)
        size = len(head) + len(self._bytes) + len(others)
        return b"".join((b"\x12", _varint(size), head, self._bytes, others))


def _varint(number):
    out = bytearray()
    while number >= 0x80:
        out.append(number & 0x7F | 0x80)
        number >>= 7
    out.append(number)
    return bytes(out)
