"""Robots of an environment in another process (robosim serve), driven over one connection with NumPy arrays."""
import queue
import struct

import numpy as np

from ._errors import RemoteError
from ._step_readings import StepAnswer, StepDecoder, StepReadings

_PICTURE_MAGIC = b"RoboSim picture\n"  # begins the bytes of a ray-cast picture, before width, height, range and layers
grpc = v1 = None  # imported when first used: only this class requires them


def _import_grpc():
    global grpc, v1
    try:
        import grpc

        from .v1 import robots_pb2 as v1
    except ImportError as missing:
        raise ImportError("robosim.RemoteRobots requires gRPC and protobuf; install the packages python3-grpcio and "
                          f"python3-protobuf, or grpcio and protobuf with pip ({missing})") from missing


class RemoteRobots:
    """Drives robots of an environment in another process, all over one connection, in its steps.

    address: "HOST:PORT" of robosim serve. names: a robot, or several.
    token: permits the robots (serve --tokens). tls_ca: certificate file (PEM) of a server with TLS, or its content.

    The constructor returns when the first readings have arrived; in lockstep that is when every networked robot of the
    world has a process. Raises RemoteError with the status and its text.

    Arrays have a row for each robot, in the order of the names. They refer to the received message, without a copy as far
    as possible, cannot be written, and keep their values.
    """

    def __init__(self, address, names, *, token=None, tls_ca=None):
        _import_grpc()
        names = [names] if isinstance(names, str) else list(names)
        self._address = address
        self._requests = queue.SimpleQueue()
        self._readings = None
        self._is_over = False
        options = [("grpc.max_receive_message_length", -1)]
        if tls_ca is None:
            self._channel = grpc.insecure_channel(address, options)
        else:
            if not isinstance(tls_ca, bytes):
                with open(tls_ca, "rb") as file:
                    tls_ca = file.read()
            self._channel = grpc.secure_channel(address, grpc.ssl_channel_credentials(tls_ca), options)
        metadata = [("authorization", "Bearer " + token)] if token else None
        # Without serialisers, messages are bytes.
        self._stream = self._channel.stream_stream("/robosim.v1.Robots/Drive")(iter(self._requests.get, None),
                                                                               metadata=metadata)
        try:
            hello = v1.RobotsHello(protocol=1, names=names)
            self._requests.put(v1.DriveRequest(hello=hello).SerializeToString())
            self.welcome = v1.DriveResponse.FromString(self._receive() or b"").welcome
            sets = np.array([robot.sensor_set for robot in self.welcome.robots])
            self._sets = [self.welcome.sensor_sets[index].sensors for index in np.unique(sets)]
            self._robots_by_set = [np.flatnonzero(sets == index) for index in np.unique(sets)]
            self._decoder = StepDecoder([len(sensors) for sensors in self._sets], self._robots_by_set)
            self._sensors_of = {}  # by kind, as _find_sensors() returns them
            self._answer = StepAnswer(len(names))
            self._others = v1.StepAnswer()
            self._read(self._receive())
        except BaseException:
            self.close()
            raise

    @property
    def names(self):
        """Names of the robots."""
        return tuple(robot.name for robot in self.welcome.robots)

    @property
    def step_count(self):
        """Number of the step of the readings."""
        return self._readings.step

    @property
    def time_s(self):
        """Simulated time of the readings [s]."""
        return self.step_count * self.welcome.period_s

    @property
    def winner(self):
        """Name of the robot that has won, upon which all halt; None while there is none."""
        return self._readings.winner or None

    @property
    def stalled(self):
        """Robots whose last motion was stopped by an obstacle: bool, shape (robots,)."""
        return self._readings.stalled

    @property
    def is_too_far(self):
        """Robots that called check_win() and are not near enough to the gold: bool, shape (robots,)."""
        return self._readings.is_too_far

    @property
    def commands(self):
        """Commands of the next step: float64, shape (robots, 2): speed [m/s], turn rate [rad/s]. It can be written, is part
        of the message that step() sends, and keeps its values."""
        return self._answer.commands

    @commands.setter
    def commands(self, value):
        self._answer.commands[...] = value

    def readings(self, kind):
        """Readings of the first sensor of a kind, or of the sensor with this label, of each robot, of shape (robots, values): of range sensors the ranges [m],
        float32; of bumpers and pictures uint8; of others float64. Robots without such a sensor have NaN."""
        return self._assembled(kind, lambda numbers, fields: numbers[..., 0] if fields[:1] == ["range"]
                               else numbers.reshape(len(numbers), -1))

    def points(self, kind):
        """Points [m] of the first range sensor of a kind, or of the one with this label, of each robot in the robot's frame: float32, shape
        (robots, beams, 3). Raises ValueError for a sensor that measures no points."""
        def points(numbers, fields):
            if fields != ["range", "x", "y", "z"]:
                raise ValueError(f"'{kind}' measures no points")
            return numbers[..., 1:]

        return self._assembled(kind, points)

    def picture(self, name, label=""):
        """The newest picture of a robot's camera in this step: bytes of a JPEG file; empty without one.

        label: of the camera; the robot's first one by default. Raises ValueError for a ray-cast camera, which has no file."""
        data = self._picture_bytes(name, label)
        if data.startswith(_PICTURE_MAGIC):
            raise ValueError(f"the camera of robot '{name}' is ray-cast; use pixels()")
        return data

    def pixels(self, name, label=""):
        """The pixels of a robot's ray-cast camera in this step (doc/raycast_cameras.md): a dict of the layers that it has; None
        without a picture.

        "rgb": uint8, shape (height, width, 3); "depth": float32 [m] and "identity": uint32, shape (height, width)."""
        data = self._picture_bytes(name, label)
        if not data:
            return None
        if not data.startswith(_PICTURE_MAGIC):
            raise ValueError(f"the camera of robot '{name}' is not ray-cast; use picture()")
        at = len(_PICTURE_MAGIC)
        width, height, _, bits = struct.unpack_from("<IIfI", data, at)
        at += 16
        layers = {}
        for bit, layer, dtype, shape in ((1, "rgb", "u1", (height, width, 3)), (2, "depth", "<f4", (height, width)),
                                         (4, "identity", "<u4", (height, width))):
            if bits & bit:
                layers[layer] = np.ndarray(shape, dtype, data, at)
                at += layers[layer].nbytes
        return layers

    def _picture_bytes(self, name, label):
        robot = self._index_of(name)
        for index, (sensors, robots) in enumerate(zip(self._sets, self._robots_by_set)):
            if robot in robots:
                for slot, sensor in enumerate(sensors):
                    if sensor.kind == "camera" and label in ("", sensor.label):
                        return self._readings.file(robot, index, slot)
        raise ValueError(f"robot '{name}' has no camera" + (f" '{label}'" if label else ""))

    def inbox(self, name):
        """Messages to a robot that arrived with the readings: list of (sender, text)."""
        return [(sender, text.decode("utf-8", "surrogateescape"))
                for sender, text in self._readings.inboxes.get(self._index_of(name), ())]

    def send(self, sender, receiver, text):
        """Sends a message from a robot to any robot of the world, which is delivered in the next step."""
        self._others.messages.add(process_robot=self._index_of(sender), to=receiver,
                                  text=text.encode("utf-8", "surrogateescape"))

    def broadcast(self, sender, text):
        """Sends a message from a robot to every other robot of the world, which is delivered in the next step to those that
        the radio reaches. It counts as one message."""
        if not self.welcome.takes_broadcasts:  # an environment of an earlier version
            for receiver in self.welcome.all_robots:
                if receiver != sender:
                    self.send(sender, receiver, text)
            return
        self._others.messages.add(process_robot=self._index_of(sender), to_all=True,
                                  text=text.encode("utf-8", "surrogateescape"))

    def check_win(self, name):
        """Requests, with the next step, whether a robot is near enough to the gold to have won."""
        self._others.win_checks.append(self._index_of(name))

    def halt(self, name):
        """Halts a robot with the next step, for the rest of the run, which ends when all robots have halted."""
        self._others.commands.add(process_robot=self._index_of(name),
                                  command=v1.Command(activity=v1.ACTIVITY_HALTED))

    def step(self):
        """Sends the commands and waits for the readings of the next step.

        Returns False when the run is over, after which the readings remain those of the last step received. Raises
        RemoteError when the connection is lost or the environment refuses the commands."""
        if self._is_over:
            return False
        if self._stream is None:
            raise ValueError("the connection is closed; make another one")
        commands = self._answer.commands
        if not np.isfinite(commands).all():
            robot = int(np.flatnonzero(~np.isfinite(commands).all(axis=1))[0])
            raise ValueError(f"the command of robot '{self.names[robot]}' (row {robot}) is not finite")
        others = self._others.SerializeToString()
        if others:
            self._others.Clear()
        self._requests.put(self._answer.message(self._readings.step, others))
        return self._read(self._receive())

    def close(self):
        """Ends the connection; the environment then treats the robots as lost unless they have halted. Arrays remain."""
        if self._stream is not None:
            self._requests.put(None)
            self._stream.cancel()
            self._channel.close()
            self._stream = None

    def __enter__(self):
        return self

    def __exit__(self, *args):
        self.close()

    def __repr__(self):
        return f"<RemoteRobots {', '.join(self.names)} at {self._address}>"

    def _receive(self):
        """The next message; None at the end of the run."""
        try:
            return next(self._stream)
        except StopIteration:
            self._is_over = True
            return None
        except grpc.RpcError as error:
            status, details = error.code().name, error.details()
        self.close()
        hint = "; start robosim serve there, or correct the address" if "connect" in details else ""
        raise RemoteError(f"{self._address}: {details}{hint}", status)

    def _read(self, message):
        if message is None:
            if self._readings is None:
                raise RemoteError(f"{self._address}: the run is over; start another one", "OK")
            return False
        self._readings = StepReadings(message, self._decoder)
        return True

    def _index_of(self, name):
        try:
            return self.names.index(name)
        except ValueError:
            raise ValueError(f"there is no robot '{name}'; this connection drives {', '.join(self.names)}") from None

    def _assembled(self, kind, select):
        sensors_of = self._sensors_of.get(kind)
        if sensors_of is None:
            sensors_of = self._sensors_of[kind] = self._find_sensors(kind)
        parts = [(index, select(self._readings.numbers(index, slot, max(len(fields), 1)), fields))
                 for index, slot, fields in sensors_of]
        if len(self._sets) == 1:
            return parts[0][1]
        shape = np.max([part.shape[1:] for _, part in parts], axis=0)
        dtype = np.result_type(np.float32, *(part.dtype for _, part in parts))
        of_all = np.full((len(self.welcome.robots), *shape), np.nan, dtype)
        for index, part in parts:
            of_all[(self._robots_by_set[index], *(slice(size) for size in part.shape[1:]))] = part
        of_all.flags.writeable = False
        return of_all

    def _find_sensors(self, kind):
        """The first sensor of a kind, or that with a label, in each set that has one: index of the set, index of the sensor, names of the numbers
        of a record."""
        found = []
        for index, sensors in enumerate(self._sets):
            slot = next((slot for slot, sensor in enumerate(sensors) if sensor.kind == kind), None)
            if slot is None:
                slot = next((slot for slot, sensor in enumerate(sensors) if sensor.label == kind), None)
            if slot is not None:
                # Messages have the lateral speed of odometry only where there is one, as of omnidirectional robots.
                found.append((index, slot, [field.name for field in sensors[slot].fields if field.name != "lateral"]))
        if not found:
            names = sorted({name for sensors in self._sets for sensor in sensors for name in (sensor.kind, sensor.label)})
            raise ValueError(f"no robot has a sensor '{kind}'; the sensors are {', '.join(names)}")
        return found
