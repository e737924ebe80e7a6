# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes bytes as broken files, careless programs and attackers do. The same seed, the same bytes."""
import re
import struct

WORDS = [b"nan", b"inf", b"-inf", b"1e308", b"-1e308", b"1e-310", b"1e400", b"-1", b"0", b"-0", b"1", b"3",
         b"2147483647", b"2147483648", b"4294967295", b"9223372036854775808", b"9" * 400, b"1.5", b"0x10", b"",
         b'"', b"'", b"true", b"1,5", b"[]", b"{}", b"null", b"\\u0000", b"\x00", b"\x1b[31m", b"\xff\xfe",
         b"\xef\xbb\xbf", b"\xc3", b"\xed\xa0\x80", b"%s%n", b"../../x", b"/dev/zero", b"embedded", b"\r", b"\n",
         b"\t", b"#", b"=", b",", b";", b" ", b"[[", b"]]", b"-", b"."]
INTEGERS = [0, 1, 2, 3, 4, 0x7f, 0xff, 0x7fff, 0xffff, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff]
FLOATS = [float("nan"), float("inf"), float("-inf"), 1e30, -1e30, 3e38, 1e-40, -0.0, 0.0, 1e5]
NUMBER = re.compile(rb"-?[0-9][0-9.eE+-]*")


class Mutator:
    def __init__(self, random):
        self.random = random

    def mutated(self, data, others=()):
        """`others`: sound inputs of the same format, whose ends may be grafted on."""
        for _ in range(self.random.choice([1, 1, 1, 2, 2, 3, 5])):
            data = self.change(data, others)
        return data

    def place(self, data):
        """Headers decide most, so every other change is near the beginning."""
        if self.random.random() < 0.5:
            return self.random.randrange(min(len(data), 600) + 1)
        return self.random.randrange(len(data) + 1)

    def change(self, data, others):
        at = self.place(data)
        end = min(len(data), at + 1 + self.random.randrange(self.random.choice([8, 40, 400])))
        part = data[at:end]
        kinds = [self.flip, self.byte, self.cut, self.leave_out, self.repeat, self.word, self.number, self.number,
                 self.number, self.integer, self.float, self.much, self.swap, self.line, self.line, self.graft]
        return self.random.choice(kinds)(data, at, part, others)

    def flip(self, data, at, part, others):
        if at == len(data):
            return data
        return data[:at] + bytes([data[at] ^ 1 << self.random.randrange(8)]) + data[at + 1:]

    def byte(self, data, at, part, others):
        return data[:at] + bytes([self.random.randrange(256)]) + data[at + 1:]

    def cut(self, data, at, part, others):
        return data[:at]

    def leave_out(self, data, at, part, others):
        return data[:at] + data[at + len(part):]

    def repeat(self, data, at, part, others):
        return data[:at] + part + data[at:]

    def word(self, data, at, part, others):
        return data[:at] + self.random.choice(WORDS) + data[at:]

    def number(self, data, at, part, others):
        """The first number from there on becomes something else."""
        found = NUMBER.search(data, at)
        if not found:
            return data
        return data[:found.start()] + self.random.choice(WORDS) + data[found.end():]

    def integer(self, data, at, part, others):
        order = self.random.choice("<>")
        kind = self.random.choice(["I", "I", "H", "Q"])
        size = struct.calcsize(kind)
        value = self.random.choice(INTEGERS) % (1 << 8 * size)
        return data[:at] + struct.pack(order + kind, value) + data[at + size:]

    def float(self, data, at, part, others):
        at -= at % 4 if self.random.random() < 0.5 else 0
        return data[:at] + struct.pack(self.random.choice("<>") + "f", self.random.choice(FLOATS)) + data[at + 4:]

    def much(self, data, at, part, others):
        """A very long line, or very many lines."""
        return data[:at] + (part * (1 << self.random.randrange(17)))[:1 << 20] + data[at:]

    def swap(self, data, at, part, others):
        to = self.random.randrange(len(data) + 1)
        rest = data[:at] + data[at + len(part):]
        return rest[:to] + part + rest[to:]

    def line(self, data, at, part, others):
        """A whole line is left out, said twice, or goes elsewhere."""
        lines = data.split(b"\n")
        one = self.random.randrange(len(lines))
        what = self.random.randrange(4)
        if what == 0:
            del lines[one]
        elif what == 1:
            lines.insert(one, lines[one])
        elif what == 2:
            lines.insert(self.random.randrange(len(lines)), lines.pop(one))
        else:
            lines[one] = lines[one][:self.random.randrange(len(lines[one]) + 1)]
        return b"\n".join(lines)

    def graft(self, data, at, part, others):
        other = self.random.choice(list(others) or [data])
        return data[:at] + other[self.random.randrange(len(other) + 1):]
