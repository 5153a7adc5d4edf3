#!/usr/bin/env python3
"""Floods `robosim serve` or the console from one and from many addresses: prints the mean pace of a run during each
attack relative to that between the attacks, the greatest memory of the server, whether `control pause` succeeds, and
evicted robots.

usage: attacks.py ROBOSIM [--seconds S] [--rounds N] [--addresses N] [--tls FOLDER] [--tokens] [--ipv6 PREFIX]
                  [--arcos | --console] [--kinds KIND,…]
Phases of S seconds with an attack and without one alternate, because other programs use the processor as well. FOLDER
contains cert.pem and key.pem for 127.0.0.1. PREFIX is an IPv6 network of 64 bits all of whose addresses are local, such
as fd00:1:1:1: after `ip -6 route add local fd00:1:1:1::/64 dev lo`, best in a network namespace of its own. --arcos
floods the ARCOS port of a run in real time; --console floods the port of `robosim remote`, where the pace is that of
answers to a page's pings. For both, the longest time is printed that a client took which came during the attack: from
its connection to an ARCOS session, or to the page. Exits with 1 if a robot is evicted, a pause or such a client fails,
the mean pace is below half, during an attack or from one second after it on, or the server needs more than 300 MiB.
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
ARCOS = {'reconnecting FA FB FF': b'\xfa\xfb\xff', 'silent': None}
CONSOLE = {'reconnecting with half a request': b'GET / HTTP/1.1\r\n', 'silent': None,
           'reconnecting for the page': b'GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n'}
ARCOS_PORT = r'for ARCOS programs on (\S+)'
IPV6_FREEBIND = 78
MAX_MIB = 300
NEWCOMER_SECONDS = 10


class Attacker(multiprocessing.Process):
    """Connections from several addresses, each of which floods until it is closed, and then connects again."""

    def __init__(self, address, kind, addresses, tls):
        super().__init__(daemon=True)
        host, self.port = address.rsplit(':', 1)
        self.host, self.port = host.strip('[]'), int(self.port)
        self.is_busy = kind == BUSY
        self.kind = KINDS.get(kind, (b'', b'', True))
        openings = {**ARCOS, **CONSOLE}
        self.opening = openings[kind] if kind in openings else PREFACE + self.kind[0]
        self.protocol = 'http/1.1' if kind in CONSOLE else 'h2'
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
        context.set_alpn_protocols([self.protocol])
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
                is_silent = self.opening is None
                open_ones[s.fileno()] = [s, address, memoryview(self.opening or b''), 0, not self.tls or is_silent]
                if is_silent:
                    epoll.modify(s.fileno(), select.EPOLLIN)
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
                    if self.opening is None:
                        continue
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

    def newcomer(self):
        """@return the seconds until a program that connects to the attacked ARCOS port has a session"""
        if self.robots:
            return 0
        begin = time.monotonic()
        while time.monotonic() - begin < NEWCOMER_SECONDS:
            try:
                with socket.create_connection(self.attacked.rsplit(':', 1), timeout=NEWCOMER_SECONDS) as s:
                    for sync in (0, 1, 2):
                        s.sendall(bytes([0xfa, 0xfb, 3, sync, 0, sync]))
                        if not s.recv(4096):
                            raise ConnectionError
                return time.monotonic() - begin
            except OSError:
                time.sleep(0.01)
        return None

    def evictions(self):
        return self.log_path.read_text().count('robots Pioneer1, Scout1') - 1 if self.robots else 0

    def end(self):
        for process in filter(None, (self.watch, self.robots, self.server)):
            process.terminate()
            process.wait()


class ConsoleRun:
    """A console, and a page that sends pings one after the other. The robots are not there."""

    def __init__(self, robosim, tls, folder):
        self.log_path = folder / 'log'
        arguments = ['remote', 'worlds/teams/small_maze.xml', '--listen', '127.0.0.1:0']
        if tls:
            arguments += ['--tls-cert', f'{tls}/cert.pem', '--tls-key', f'{tls}/key.pem']
        self.context = ssl._create_unverified_context() if tls else None  # noqa: SLF001
        self.server = subprocess.Popen([robosim, *arguments], stdout=subprocess.DEVNULL, stderr=self.log_path.open('w'))
        while not (found := re.search(r'the console is at https?://([^/]+)/', self.log_path.read_text())):
            if self.server.poll() is not None:
                raise RuntimeError(self.log_path.read_text())
            time.sleep(0.02)
        self.attacked = found.group(1)
        self.answers = self.losses = 0
        self.is_over = False
        threading.Thread(target=self.keep_page, daemon=True).start()
        while self.answers == 0:
            time.sleep(0.02)

    def connection(self):
        s = socket.create_connection(self.attacked.rsplit(':', 1), timeout=NEWCOMER_SECONDS)
        return self.context.wrap_socket(s) if self.context else s

    @staticmethod
    def text_frame(text):
        return bytes([0x81, 0x80 | len(text), 0, 0, 0, 0]) + text.encode()  # the mask is 0

    def keep_page(self):
        """Keeps a page open, and counts how often it is lost."""
        while not self.is_over:
            try:
                self.ping()
            except OSError:
                if not self.is_over:
                    self.losses += 1
                    time.sleep(0.1)

    def ping(self):
        scheme = 'https' if self.context else 'http'
        page = self.connection()
        page.sendall((f'GET / HTTP/1.1\r\nHost: {self.attacked}\r\nOrigin: {scheme}://{self.attacked}\r\n'
                      'Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n'
                      'Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n'
                      'Sec-WebSocket-Protocol: robosim.remote.1\r\n\r\n').encode())
        page.sendall(self.text_frame('{"type":"hello","protocol":1,"name":"Page"}'))
        ping = '{"type":"ping","number":1}'
        page.sendall(self.text_frame(ping))
        while received := page.recv(65536):
            if count := received.count(b'"pong"'):
                self.answers += count
                time.sleep(0.001)
                page.sendall(self.text_frame(ping))
        raise ConnectionError('the page has been disconnected')

    def wait(self, seconds):
        answers, begin = self.answers, time.monotonic()
        time.sleep(seconds)
        return self.answers - answers, time.monotonic() - begin

    def control(self, _):
        return subprocess.CompletedProcess([], self.server.poll() or 0)

    def newcomer(self):
        """@return the seconds until the page is loaded over a new connection"""
        begin = time.monotonic()
        while time.monotonic() - begin < NEWCOMER_SECONDS:
            try:
                with self.connection() as s:
                    s.sendall(b'GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n')
                    received = b''
                    while piece := s.recv(65536):
                        received += piece
                    if received.startswith(b'HTTP/1.1 200') and received.rstrip().endswith(b'</html>'):
                        return time.monotonic() - begin
            except OSError:
                time.sleep(0.01)
        return None

    def evictions(self):
        return self.losses

    def end(self):
        self.is_over = True
        self.server.terminate()
        self.server.wait()


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
    pauses, failures, newcomers = 0, [], []
    for _ in range(options.rounds):
        alone.add(*run.wait(options.seconds / 2))
        attacker = Attacker(run.attacked, kind, addresses, options.tls)
        attacker.start()
        try:
            attacked.add(*run.wait(options.seconds))
            newcomers += [run.newcomer() for _ in range(3)]
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
    served = [seconds for seconds in newcomers if seconds is not None]
    is_served = len(served) == len(newcomers)
    newcomer = f'{max(served):.2f} s' if is_served else f'{len(served)} of {len(newcomers)} served'
    print(f'| {kind} | {count} | {float(attacked) / float(rest):.2f} of {float(rest):.0f}/s '
          f'| {float(recovered) / float(alone):.2f} '
          f'| {mib:.0f} MiB | {pauses} of {options.rounds} {"; ".join(failures)}| {run.evictions()} '
          f'| {newcomer} |', flush=True)
    return (float(attacked) >= float(rest) / 2 and float(recovered) >= float(alone) / 2 and pauses == options.rounds and
            run.evictions() == 0 and mib <= MAX_MIB and is_served)


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
    options.add_argument('--console', action='store_true')
    options.add_argument('--kinds', default=','.join(['busy', *(k for k in KINDS if ',' not in k), 'unread']))
    options = options.parse_args()
    names = {'busy': BUSY, 'unread': UNREAD}
    kinds = [names.get(k, k) for k in options.kinds.split(',')]
    if options.arcos or options.console:
        kinds = [BUSY, *(ARCOS if options.arcos else CONSOLE)]
    is_good = True
    print('| attack | addresses | pace | recovered | memory | pause | evictions | new client |\n' + '|---' * 8 + '|')
    for kind in kinds:
        for count in sorted({1, options.addresses} if kind != BUSY else {1}):
            addresses = [f'{options.ipv6}:{i + 1:x}' if options.ipv6 else f'127.0.{i // 250}.{i % 250 + 1}'
                         for i in range(count)]
            with tempfile.TemporaryDirectory() as folder:
                if options.console:
                    run = ConsoleRun(options.robosim, options.tls, pathlib.Path(folder))
                else:
                    run = Run(options.robosim, options.tls, options.tokens, options.ipv6, options.arcos,
                              pathlib.Path(folder))
                try:
                    is_good = measure(run, kind, addresses, options) and is_good
                finally:
                    run.end()
    sys.exit(0 if is_good else 1)


if __name__ == '__main__':
    main()
