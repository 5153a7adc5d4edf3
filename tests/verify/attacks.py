#!/usr/bin/env python3
"""Floods `robosim serve` from one and from many addresses: prints the mean pace of a run during each attack relative to
that between the attacks, the greatest memory of the server, whether `control pause` succeeds, and evicted robots.

usage: attacks.py ROBOSIM [--seconds S] [--rounds N] [--addresses N] [--tls FOLDER] [--tokens] [--ipv6 PREFIX] [--arcos]
                  [--kinds KIND,…]
Phases of S seconds with an attack and without one alternate, because other programs use the processor as well. FOLDER
contains cert.pem and key.pem for 127.0.0.1. PREFIX is an IPv6 network of 64 bits all of whose addresses are local, such
as fd00:1:1:1: after `ip -6 route add local fd00:1:1:1::/64 dev lo`, best in a network namespace of its own. --arcos
floods the ARCOS port of a run in real time. Exits with 1 if a robot is evicted, a pause fails, the mean pace is below
half, during an attack or from one second after it on, or the server needs more than 300 MiB.
"""
import argparse
import multiprocessing
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
UNREAD = 'HEADERS, answers unread'
KINDS = {  # what is sent once, what is repeated, whether answers are read
    'empty DATA': (frame(1, 4, 1, CALL), frame(0, 0, 1) * 2000, True),
    'empty CONTINUATION': (frame(1, 0, 1, CALL), frame(9, 0, 1) * 2000, True),
    'PING': (b'', frame(6, 0, 0, bytes(8)) * 1000, True),
    'HEADERS': (b''.join(frame(1, 4, s, CALL) for s in STREAMS), b'', True),
    UNREAD: (b''.join(frame(1, 4, s, CALL) for s in STREAMS), b'', False),
    'rapid reset': (b''.join(frame(1, 4, s, CALL) + frame(3, 0, s, bytes([0, 0, 0, 8])) for s in STREAMS), b'', True),
    'GOAWAY': (b'', frame(7, 0, 0, bytes(8)) * 1000, True),
}
BUSY = 'none; a busy process instead'  # what the attackers cost as a program beside the server
ARCOS = 'reconnecting FA FB FF'
ARCOS_PORT = r'for ARCOS programs on (\S+)'
IPV6_FREEBIND = 78
MAX_MIB = 300


class Attacker(multiprocessing.Process):
    """Connections from several addresses, each of which floods until it is closed, and then connects again."""

    def __init__(self, address, kind, addresses, tls):
        super().__init__(daemon=True)
        host, self.port = address.rsplit(':', 1)
        self.host, self.port = host.strip('[]'), int(self.port)
        self.is_busy = kind == BUSY
        self.kind = KINDS.get(kind, (b'', b'', True))
        self.opening = b'\xfa\xfb\xff' if kind == ARCOS else PREFACE + self.kind[0]
        self.tls, self.addresses = tls, addresses

    def socket_from(self, address):
        is_ipv6 = ':' in address
        s = socket.socket(socket.AF_INET6 if is_ipv6 else socket.AF_INET)
        if is_ipv6:
            s.setsockopt(socket.IPPROTO_IPV6, IPV6_FREEBIND, 1)
        s.bind((address, 0))
        s.setblocking(False)
        s.connect_ex((self.host, self.port))
        return s

    def run(self):
        while self.is_busy:
            pass
        epoll = select.epoll()
        open_ones = {}
        waiting = list(self.addresses)
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        context.set_alpn_protocols(['h2'])
        chunk = 16384
        while True:
            again, waiting = waiting[:64], waiting[64:]
            for address in again:
                try:
                    s = self.socket_from(address)
                    if self.tls:
                        s = context.wrap_socket(s, do_handshake_on_connect=False, server_side=False)
                except OSError:
                    waiting.append(address)
                    continue
                epoll.register(s.fileno(), select.EPOLLIN | select.EPOLLOUT)
                open_ones[s.fileno()] = [s, address, memoryview(self.opening), 0, not self.tls]
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
                except (BlockingIOError, ssl.SSLWantReadError, ssl.SSLWantWriteError):
                    continue
                except OSError:
                    epoll.unregister(number)
                    del open_ones[number]
                    s.close()
                    waiting.append(address)


def max_resident_mib(pid):
    return int(re.search(r'VmHWM:\s+(\d+)', pathlib.Path(f'/proc/{pid}/status').read_text()).group(1)) / 1024


class Run:
    """A run in lockstep with a process that drives its robots, or in real time with ARCOS ports."""

    def __init__(self, robosim, tls, with_tokens, with_ipv6, with_arcos, folder):
        self.robosim = robosim
        self.log_path = folder / 'log'
        world = 'worlds/open_house.xml' if with_arcos else 'worlds/small_maze.xml'
        arguments = ['serve', world, '--listen', '[::1]:0' if with_ipv6 else '127.0.0.1:0', '--time', '1000000']
        arguments += ['--arcos', '127.0.0.1:0', '--arcos-all'] if with_arcos else ['--wait-for-robots']
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
        self.server = subprocess.Popen([robosim, *arguments], stdout=subprocess.DEVNULL, stderr=self.log_path.open('w'),
                                       env=environment)
        self.await_log('listening on ')
        self.address = re.search(r'listening on (\S+)', self.log_path.read_text()).group(1)
        self.attacked = self.address
        self.robots = None
        if with_arcos:
            self.await_log('for ARCOS programs on ')
            self.attacked = re.search(ARCOS_PORT, self.log_path.read_text()).group(1)
        else:
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

    def wait(self, seconds):
        """@return the steps, and the time that they took"""
        step, when = self.step, self.when
        time.sleep(seconds)
        # Without news there were no steps.
        return self.step - step, max(seconds, self.when - when)

    def control(self, command):
        return subprocess.run([self.robosim, 'control', self.address, command, *self.client, *self.tokens['operator']],
                              capture_output=True, text=True, timeout=60)

    def evictions(self):
        return self.log_path.read_text().count('robots Pioneer1, Scout1') - 1 if self.robots else 0

    def end(self):
        for process in filter(None, (self.watch, self.robots, self.server)):
            process.terminate()
            process.wait()


class Pace:
    """Mean of several phases."""

    def __init__(self):
        self.steps = self.seconds = 0

    def add(self, steps, seconds):
        self.steps += steps
        self.seconds += seconds

    def __float__(self):
        return self.steps / self.seconds


def measure(run, kind, addresses, options):
    """Prints a line of the table. @return whether the run has withstood the attack"""
    alone, attacked, recovered, rest = Pace(), Pace(), Pace(), Pace()
    pauses, failures = 0, []
    for _ in range(options.rounds):
        alone.add(*run.wait(options.seconds / 2))
        attacker = Attacker(run.attacked, kind, addresses, options.tls)
        attacker.start()
        try:
            attacked.add(*run.wait(options.seconds))
            paused = run.control('pause')
            pauses += paused.returncode == 0
            failures += [paused.stderr.strip()] if paused.returncode else []
            run.control('start')
        finally:
            attacker.kill()
            attacker.join()
        time.sleep(1)
        recovered.add(*run.wait(options.seconds / 2))
    rest.add(alone.steps + recovered.steps, alone.seconds + recovered.seconds)
    mib = max_resident_mib(run.server.pid)
    count = len(addresses) if kind != BUSY else 0
    print(f'| {kind} | {count} | {float(attacked) / float(rest):.2f} of {float(rest):.0f}/s '
          f'| {float(recovered) / float(alone):.2f} '
          f'| {mib:.0f} MiB | {pauses} of {options.rounds} {"; ".join(failures)}| {run.evictions()} |', flush=True)
    return (float(attacked) >= float(rest) / 2 and float(recovered) >= float(alone) / 2 and pauses == options.rounds and
            run.evictions() == 0 and mib <= MAX_MIB)


def main():
    options = argparse.ArgumentParser()
    options.add_argument('robosim')
    options.add_argument('--seconds', type=float, default=4)
    options.add_argument('--rounds', type=int, default=3)
    options.add_argument('--addresses', type=int, default=1000)
    options.add_argument('--tls')
    options.add_argument('--tokens', action='store_true')
    options.add_argument('--ipv6')
    options.add_argument('--arcos', action='store_true')
    options.add_argument('--kinds', default=','.join(['busy', *(k for k in KINDS if ',' not in k), 'unread']))
    options = options.parse_args()
    names = {'busy': BUSY, 'unread': UNREAD}
    kinds = [BUSY, ARCOS] if options.arcos else [names.get(k, k) for k in options.kinds.split(',')]
    is_good = True
    print('| attack | addresses | pace | recovered | memory | pause | evictions |\n|---|---|---|---|---|---|---|')
    for kind in kinds:
        for count in sorted({1, options.addresses} if kind != BUSY else {1}):
            addresses = [f'{options.ipv6}:{i + 1:x}' if options.ipv6 else f'127.0.{i // 250}.{i % 250 + 1}'
                         for i in range(count)]
            with tempfile.TemporaryDirectory() as folder:
                run = Run(options.robosim, options.tls, options.tokens, options.ipv6, options.arcos, pathlib.Path(folder))
                try:
                    is_good = measure(run, kind, addresses, options) and is_good
                finally:
                    run.end()
    sys.exit(0 if is_good else 1)


if __name__ == '__main__':
    main()
