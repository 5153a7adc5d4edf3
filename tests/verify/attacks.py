#!/usr/bin/env python3
"""Floods of HTTP/2 frames from one and from many loopback addresses at `robosim serve`: prints the pace of a lockstep run
under each attack relative to that alone, the memory of the server, whether `control pause` succeeds, and evicted robots.

usage: attacks.py ROBOSIM [--seconds S] [--addresses N] [--tls FOLDER] [--tokens] [--kinds KIND,…]
FOLDER contains cert.pem and key.pem for 127.0.0.1. Exits with 1 if a robot is evicted, a pause fails, or the mean pace is
below half.
"""
import argparse
import os
import pathlib
import re
import select
import socket
import ssl
import struct
import subprocess
import sys
import tempfile
import threading
import time

TOKENS = {'operator': 'operator-0123456789abcdef', 'robot': 'robots-0123456789abcdef'}


def frame(kind, flags, stream, payload=b''):
    return struct.pack('>I', len(payload))[1:] + struct.pack('>BBI', kind, flags, stream) + payload


def field(name, value):
    return b'\0' + bytes([len(name)]) + name + bytes([len(value)]) + value


CALL = b''.join(field(*pair) for pair in [
    (b':method', b'POST'), (b':scheme', b'http'), (b':path', b'/robosim.v1.ControlPanel/GetStatus'),
    (b':authority', b'localhost'), (b'te', b'trailers'), (b'content-type', b'application/grpc')])
PREFACE = b'PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n' + frame(4, 0, 0)
STREAMS = range(1, 2 * 10_000, 2)
KINDS = {  # what is sent once, what is repeated, whether answers are read
    'empty DATA': (frame(1, 4, 1, CALL), frame(0, 0, 1) * 2000, True),
    'empty CONTINUATION': (frame(1, 0, 1, CALL), frame(9, 0, 1) * 2000, True),
    'PING': (b'', frame(6, 0, 0, bytes(8)) * 1000, True),
    'HEADERS': (b''.join(frame(1, 4, s, CALL) for s in STREAMS), b'', True),
    'HEADERS, answers unread': (b''.join(frame(1, 4, s, CALL) for s in STREAMS), b'', False),
    'rapid reset': (b''.join(frame(1, 4, s, CALL) + frame(3, 0, s, bytes([0, 0, 0, 8])) for s in STREAMS), b'', True),
    'GOAWAY': (b'', frame(7, 0, 0, bytes(8)) * 1000, True),
}


class Attacker:
    """Connections from several addresses, each of which floods until it is closed, and then connects again."""

    def __init__(self, port, kind, addresses, tls):
        self.port, self.tls, self.kind, self.addresses = port, tls, KINDS[kind], addresses
        self.is_over = False
        self.opened = 0
        self.sent = 0

    def run(self):
        epoll = select.epoll()
        open_ones = {}
        waiting = list(self.addresses)
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        context.set_alpn_protocols(['h2'])
        chunk = 16384
        while not self.is_over:
            again, waiting = waiting[:64], waiting[64:]
            for address in again:
                s = socket.socket()
                try:
                    s.bind((address, 0))
                    s.setblocking(False)
                    s.connect_ex(('127.0.0.1', self.port))
                    if self.tls:
                        s = context.wrap_socket(s, do_handshake_on_connect=False, server_side=False)
                except OSError:
                    s.close()
                    waiting.append(address)
                    continue
                self.opened += 1
                epoll.register(s.fileno(), select.EPOLLIN | select.EPOLLOUT)
                open_ones[s.fileno()] = [s, address, memoryview(PREFACE + self.kind[0]), 0, not self.tls]
            for number, _ in epoll.poll(0.01, 256):
                entry = open_ones.get(number)
                if not entry:
                    continue
                s, address = entry[0], entry[1]
                try:
                    if not entry[4]:
                        s.do_handshake()
                        entry[4] = True
                    if self.kind[2]:
                        try:
                            if not s.recv(65536):
                                raise ConnectionError
                        except (BlockingIOError, ssl.SSLWantReadError):
                            pass
                    if entry[3] >= len(entry[2]):
                        if not self.kind[1]:
                            raise ConnectionError
                        entry[2], entry[3] = memoryview(self.kind[1]), 0
                    size = s.send(entry[2][entry[3]:entry[3] + chunk])
                    entry[3] += size
                    self.sent += size
                except (BlockingIOError, ssl.SSLWantReadError, ssl.SSLWantWriteError):
                    continue
                except OSError:
                    epoll.unregister(number)
                    del open_ones[number]
                    s.close()
                    waiting.append(address)
        for entry in open_ones.values():
            entry[0].close()


def resident_mib(pid):
    return int(re.search(r'VmRSS:\s+(\d+)', pathlib.Path(f'/proc/{pid}/status').read_text()).group(1)) / 1024


class Run:
    """A lockstep run in the small maze whose robots another process drives."""

    def __init__(self, robosim, tls, with_tokens, folder):
        self.robosim = robosim
        self.log_path = folder / 'log'
        arguments = ['serve', 'worlds/small_maze.xml', '--listen', '127.0.0.1:0', '--wait-for-robots', '--time', '1000000']
        self.client = []
        environment = dict(os.environ)
        if tls:
            arguments += ['--tls-cert', f'{tls}/cert.pem', '--tls-key', f'{tls}/key.pem']
            self.client += ['--tls-ca', f'{tls}/cert.pem']
        self.tokens = {role: [] for role in TOKENS}
        if with_tokens:
            names = {'operator': 'operator', 'robot': 'robot Pioneer1 Scout1'}
            tokens = folder / 'tokens'
            tokens.write_text(''.join(f'{TOKENS[role]} {names[role]}\n' for role in TOKENS))
            tokens.chmod(0o600)
            arguments += ['--tokens', str(tokens)]
            for role, token in TOKENS.items():
                file = folder / role
                file.write_text(token + '\n')
                file.chmod(0o600)
                self.tokens[role] = ['--token-file', str(file)]
        self.server = subprocess.Popen([robosim, *arguments], stderr=self.log_path.open('w'), env=environment)
        self.await_log('listening on ')
        self.address = re.search(r'listening on (\S+)', self.log_path.read_text()).group(1)
        self.robots = subprocess.Popen(
            [robosim, 'robot', 'Pioneer1', 'Scout1', '--controller', 'wander', '--environment', self.address, *self.client,
             *self.tokens['robot']], stderr=subprocess.DEVNULL)
        self.await_log('all robots are connected')
        self.watch = subprocess.Popen(
            [robosim, 'control', self.address, 'status', '--watch', '--interval', '0.05', *self.client,
             *self.tokens['operator']], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.step, self.when = 0, time.monotonic()
        threading.Thread(target=self.follow, daemon=True).start()
        while self.step == 0:
            time.sleep(0.05)

    def follow(self):
        for line in self.watch.stdout:
            if found := re.match(r'step ([\d,]+)', line):
                self.step, self.when = int(found.group(1).replace(',', '')), time.monotonic()

    def await_log(self, text):
        while text not in self.log_path.read_text():
            if self.server.poll() is not None:
                raise RuntimeError(self.log_path.read_text())
            time.sleep(0.02)

    def pace(self, seconds):
        begin, first = self.when, self.step
        time.sleep(seconds)
        return (self.step - first) / max(seconds, self.when - begin)

    def pauses(self):
        done = subprocess.run([self.robosim, 'control', self.address, 'pause', *self.client, *self.tokens['operator']],
                              capture_output=True, text=True, timeout=60)
        subprocess.run([self.robosim, 'control', self.address, 'start', *self.client, *self.tokens['operator']],
                       capture_output=True, timeout=60)
        return done.returncode == 0, done.stderr

    def evictions(self):
        return self.log_path.read_text().count('robots Pioneer1, Scout1') - 1

    def end(self):
        for process in (self.watch, self.robots, self.server):
            process.terminate()
            process.wait()


def main():
    options = argparse.ArgumentParser()
    options.add_argument('robosim')
    options.add_argument('--seconds', type=float, default=6)
    options.add_argument('--addresses', type=int, default=1000)
    options.add_argument('--tls')
    options.add_argument('--tokens', action='store_true')
    options.add_argument('--kinds', default=','.join(k for k in KINDS if ',' not in k) + ',unread')
    options = options.parse_args()
    kinds = ['HEADERS, answers unread' if k == 'unread' else k for k in options.kinds.split(',')]
    is_good = True
    print('| attack | addresses | pace | recovered | memory | pause | evictions |\n|---|---|---|---|---|---|---|')
    for kind in kinds:
        for count in sorted({1, options.addresses}):
            with tempfile.TemporaryDirectory() as folder:
                run = Run(options.robosim, options.tls, options.tokens, pathlib.Path(folder))
                try:
                    alone = run.pace(options.seconds / 2)
                    addresses = [f'127.0.{i // 250}.{i % 250 + 1}' for i in range(count)]
                    attacker = Attacker(int(run.address.rsplit(':', 1)[1]), kind, addresses, options.tls)
                    thread = threading.Thread(target=attacker.run)
                    thread.start()
                    pace = run.pace(options.seconds)
                    memory = resident_mib(run.server.pid)
                    paused, why = run.pauses()
                    attacker.is_over = True
                    thread.join()
                    time.sleep(1)
                    after = run.pace(options.seconds / 3)
                    print(f'| {kind} | {count} | {pace / alone:.2f} of {alone:.0f}/s | {after / alone:.2f} | {memory:.0f} MiB '
                          f'| {"yes" if paused else "no: " + why.strip()} | {run.evictions()} |', flush=True)
                    is_good = is_good and pace >= alone / 2 and paused and run.evictions() == 0 and memory <= 300
                finally:
                    run.end()
    sys.exit(0 if is_good else 1)


if __name__ == '__main__':
    main()
