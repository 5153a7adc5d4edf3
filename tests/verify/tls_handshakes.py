#!/usr/bin/env python3
"""Sends mutated TLS handshakes to the ports of `robosim serve` (gRPC) and `robosim remote` (the console).

Each handshake is recorded from OpenSSL's client, mutated (bits, bytes, lengths, cuts, repetitions, other records) and
sent on a separate connection, 16 at a time. Both programs must keep serving: every 500 handshakes a correct one must
succeed, at the end their memory must not have grown by more than 100 MB, and they must end with exit code 0.

Usage: tls_handshakes.py ROBOSIM [--count N] [--seed N]      N handshakes for each port; 2,000 by default
"""

import argparse
import concurrent.futures
import pathlib
import random
import re
import signal
import socket
import ssl
import subprocess
import sys
import tempfile
import threading
import time

PARALLEL = 16
REPLY_WITHIN_S = 10
MAX_GROWTH_MB = 100


def start(program, arguments, pattern):
    process = subprocess.Popen([program, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, errors="backslashreplace")
    for line in process.stderr:
        found = re.search(pattern, line)
        if found:
            threading.Thread(target=lambda: [None for _ in process.stderr], daemon=True).start()  # a full pipe blocks
            return process, int(found.group(1))
    sys.exit(f"{arguments[0]} ended before it listened")


def resident_mb(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", status).group(1)) / 1024


def client_context(protocol, version):
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    context.minimum_version = context.maximum_version = version
    context.set_alpn_protocols([protocol])
    return context


def flights(port, protocol, version):
    """Flights of a client in a correct handshake: the ClientHello, and the reply to the server's flight."""
    incoming, outgoing = ssl.MemoryBIO(), ssl.MemoryBIO()
    tls = client_context(protocol, version).wrap_bio(incoming, outgoing, server_hostname="localhost")
    sent = []
    with socket.create_connection(("127.0.0.1", port), timeout=REPLY_WITHIN_S) as connection:
        while True:
            try:
                tls.do_handshake()
                done = True
            except ssl.SSLWantReadError:
                done = False
            data = outgoing.read()
            if data:
                sent.append(data)
                connection.sendall(data)
            if done:
                return sent
            incoming.write(connection.recv(65536))


def mutated(data, rng):
    data = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 8))):
        kind = rng.randrange(9)
        at = rng.randrange(len(data)) if data else 0
        if not data:
            data += rng.randbytes(rng.randrange(1, 64))
        elif kind == 0:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            data[at] = rng.choice((0, 1, 0x7F, 0x80, 0xFF, rng.randrange(256)))
        elif kind == 2:
            del data[at:]
        elif kind == 3:
            del data[at:at + rng.randrange(1, 32)]
        elif kind == 4:
            data[at:at] = rng.randbytes(rng.randrange(1, 64))
        elif kind == 5:
            data[at:at] = data[at:at + rng.randrange(1, 64)]
        elif kind == 6:  # a length field
            data[at:at + 2] = rng.choice((0, 1, len(data), 0x4000, 0x4001, 0x8000, 0xFFFF)).to_bytes(2, "big")
        elif kind == 7:  # another record before it
            body = rng.randbytes(rng.randrange(0, 64))
            data[0:0] = bytes((rng.choice((20, 21, 22, 23, 24, rng.randrange(256))), 3, rng.randrange(5))) + \
                len(body).to_bytes(2, "big") + body
        else:
            data += data[:rng.randrange(1, len(data) + 1)]
    return bytes(data)


def attack(port, parts, rng):
    """One connection: all flights as recorded except a mutated one; then the end of the stream."""
    which = rng.randrange(len(parts)) if rng.randrange(4) == 0 else 0
    with socket.create_connection(("127.0.0.1", port), timeout=REPLY_WITHIN_S) as connection:
        try:
            for i, part in enumerate(parts):
                connection.sendall(mutated(part, rng) if i == which else part)
                if i == which:
                    break
                connection.recv(65536)
            connection.shutdown(socket.SHUT_WR)
            while connection.recv(65536):
                pass
        except TimeoutError:
            return "is still open after 10 s"
        except OSError:
            pass  # reset
    return ""


def handshakes(name, process, port, protocol, count, seed):
    parts = [flights(port, protocol, version) for version in (ssl.TLSVersion.TLSv1_2, ssl.TLSVersion.TLSv1_3)]
    before_mb = resident_mb(process)
    begun = time.monotonic()
    open_still = 0

    def one(i):
        rng = random.Random(f"{seed} {i}")
        return attack(port, parts[rng.randrange(2)], rng)

    with concurrent.futures.ThreadPoolExecutor(PARALLEL) as pool:
        for first in range(0, count, 500):
            open_still += sum(map(bool, pool.map(one, range(first, min(first + 500, count)))))
            if process.poll() is not None:
                sys.exit(f"{name}: ended with {process.returncode} within the 500 handshakes from {first}")
            flights(port, protocol, ssl.TLSVersion.TLSv1_3)
    flights(port, protocol, ssl.TLSVersion.TLSv1_2)
    growth_mb = resident_mb(process) - before_mb
    took_s = time.monotonic() - begun
    print(f"{name}: {count} mutated handshakes in {took_s:.0f} s, {growth_mb:+.1f} MB, {open_still} not closed within 10 s")
    if growth_mb > MAX_GROWTH_MB or open_still:
        sys.exit(f"{name}: memory may grow by {MAX_GROWTH_MB} MB, and every connection must be closed")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("robosim")
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="robosim_tls_") as name:
        folder = pathlib.Path(name)
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                        "-days", "1", "-subj", "/CN=localhost", "-keyout", folder / "key.pem", "-out",
                        folder / "cert.pem"], check=True, stderr=subprocess.DEVNULL)
        (folder / "team.xml").write_text("<RobotInfo><robot><hostname>127.0.0.1</hostname><port>9</port><name>A</name>"
                                         "<primary>1</primary></robot></RobotInfo>")
        tls = ["--tls-cert", str(folder / "cert.pem"), "--tls-key", str(folder / "key.pem"), "--listen", "127.0.0.1:0"]
        for what, protocol, words, pattern in (
                ("the console's port", "http/1.1", ["remote", str(folder / "team.xml"), *tls],
                 r"the console is at https://\S+:(\d+)/"),
                ("the environment's port", "h2", ["serve", "worlds/small_maze.xml", "--paused", *tls],
                 r"listening on \S+:(\d+)")):
            process, port = start(arguments.robosim, words, pattern)
            try:
                handshakes(what, process, port, protocol, arguments.count, arguments.seed)
                process.send_signal(signal.SIGINT)
                if process.wait(60) != 0:
                    sys.exit(f"{what}: exit code {process.returncode} instead of 0")
            finally:
                process.kill()


main()
