# SPDX-License-Identifier: GPL-3.0-or-later
"""Talks to `hyperex studio` as its page does, without a browser: uploads, requests, raw bytes."""
import base64
import json
import os
import re
import signal
import socket
import struct
import subprocess
import time


class Lost(Exception):
    """The studio has closed the connection: its right where a message is no request."""


class Silent(Exception):
    """The studio did not answer in time."""


class Studio:
    def __init__(self, command, environment, folder, patience_s):
        self.patience_s = patience_s
        self.errors = open(os.path.join(folder, ".stderr"), "wb+")
        self.process = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.PIPE,
                                        stderr=self.errors, stdin=subprocess.DEVNULL)
        first = self.process.stdout.readline().decode("utf-8", "replace")
        found = re.match(r"http://127\.0\.0\.1:(\d+)/#([0-9a-f]+)", first)
        self.port, self.token = (int(found[1]), found[2]) if found else (0, "")
        self.socket, self.asked = None, 0

    def connection(self):
        made = socket.create_connection(("127.0.0.1", self.port), timeout=self.patience_s)
        made.settimeout(self.patience_s)
        return made

    def raw(self, request):
        """The whole answer to these bytes, or what there was of it after a while."""
        with self.connection() as made:
            made.settimeout(2)
            answer = b""
            try:
                made.sendall(request)
                made.shutdown(socket.SHUT_WR)
                while part := made.recv(65536):
                    answer += part
            except OSError:
                pass
            return answer

    def head(self, line, more=()):
        return "\r\n".join([line, f"Host: 127.0.0.1:{self.port}", f"Origin: http://127.0.0.1:{self.port}",
                            *more, "", ""]).encode()

    def alive(self):
        try:
            return self.raw(self.head("GET / HTTP/1.1", ["Connection: close"])).startswith(b"HTTP/1.1 200")
        except OSError:
            return False

    def upload(self, name, data):
        """The name that the studio gives the file; empty where it refuses it."""
        answer = self.raw(self.head(f"POST /upload/{name} HTTP/1.1", [
            f"Authorization: Bearer {self.token}", f"Content-Length: {len(data)}", "Connection: close"]) + data)
        head, _, body = answer.partition(b"\r\n\r\n")
        if b" 200 " not in head.split(b"\r\n")[0]:
            return ""
        try:
            return json.loads(body)["name"]
        except (ValueError, KeyError, TypeError):
            return body.decode("utf-8", "replace").strip()

    def open_socket(self):
        self.close_socket()
        self.socket = self.connection()
        key = base64.b64encode(bytes(16)).decode()
        self.socket.sendall(self.head("GET /socket HTTP/1.1", [
            "Upgrade: websocket", "Connection: Upgrade", f"Sec-WebSocket-Key: {key}", "Sec-WebSocket-Version: 13"]))
        answer = b""
        while not answer.endswith(b"\r\n\r\n"):
            part = self.socket.recv(1)
            if not part:
                raise Lost()
            answer += part
        return self.ask("hello", token=self.token, version=1)

    def close_socket(self):
        if self.socket:
            self.socket.close()
        self.socket = None

    def send(self, data, code=1):
        """One frame, masked as RFC 6455 wants it of a page."""
        size = len(data)
        head = bytes([0x80 | code]) + (bytes([0x80 | size]) if size < 126 else
                                       b"\xfe" + struct.pack(">H", size) if size < 65536 else
                                       b"\xff" + struct.pack(">Q", size))
        try:
            self.socket.sendall(head + bytes(4) + data)
        except socket.timeout as late:
            raise Silent() from late
        except OSError as error:
            raise Lost() from error

    def exactly(self, count):
        data = b""
        while len(data) < count:
            try:
                part = self.socket.recv(min(count - len(data), 1 << 20))
            except socket.timeout as late:
                raise Silent() from late
            except OSError as error:
                raise Lost() from error
            if not part:
                raise Lost()
            data += part
        return data

    def message(self):
        """Its kind and its bytes, of however many frames; control frames may come in between."""
        kind, data, last = 0, b"", False
        while not last:
            first, part = self.frame()
            if first & 15 < 8:
                kind, data, last = kind or first & 15, data + part, first >= 128
        return kind, data

    def frame(self):
        first, size = self.exactly(2)
        if size == 126:
            size, = struct.unpack(">H", self.exactly(2))
        elif size == 127:
            size, = struct.unpack(">Q", self.exactly(8))
        data = self.exactly(size)
        if first & 15 == 9:
            self.send(data, 10)
        if first & 15 == 8:
            raise Lost()
        return first, data

    def answer(self, number):
        """Events in between are read over."""
        until = time.monotonic() + self.patience_s
        while time.monotonic() < until:
            code, data = self.message()
            if code == 1:
                message = json.loads(data)
                if message.get("answer") == number:
                    return message
        raise Silent()

    def ask(self, request, **fields):
        self.asked += 1
        self.send(json.dumps({"id": self.asked, "do": request, **fields}).encode())
        return self.answer(self.asked)

    def end(self):
        """The exit status after a SIGTERM, and what was printed as errors; None where it hangs."""
        self.close_socket()
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        try:
            status = self.process.wait(self.patience_s)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            status = None
        self.process.stdout.close()
        self.errors.seek(0)
        text = self.errors.read().decode("utf-8", "replace")
        self.errors.close()
        os.remove(self.errors.name)
        return status, text
