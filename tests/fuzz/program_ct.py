# SPDX-License-Identifier: GPL-3.0-or-later
"""A head made by code as a CT of 4 mm voxels: DICOM slices, NRRD, NIfTI, labels, surfaces of bones.

Grids run to the left, to the back and up, as DICOM's patient axes do. Shapes are in mm: left, up, forward.
"""
import gzip
import math
import struct

SIZE, STEP = (31, 33, 32), 4
FIRST = (-60, -70, -62)  # patient axes of the first voxel
AIR, SOFT, BONE = -1000, 40, 1000
SKULL, MANDIBLE = 1, 2
EXPLICIT, IMPLICIT = "1.2.840.10008.1.2.1", "1.2.840.10008.1.2"
RUN_LENGTHS, LOSSLESS_JPEG = "1.2.840.10008.1.2.5", "1.2.840.10008.1.2.4.70"
LONG = ("OB", "OW", "SQ", "UN")


def ellipsoid(p, middle, radii):
    """About the distance from it, negative inside."""
    q = [(a - m) / r for a, m, r in zip(p, middle, radii)]
    norm, slope = math.hypot(*q), math.hypot(*(a / r for a, r in zip(q, radii)))
    return norm * (norm - 1) / slope if slope > 1e-9 else -min(radii)


def box(p, low, high):
    return max(max(a - x, x - b) for x, a, b in zip(p, low, high))


def skin_distance(p):
    return min(ellipsoid(p, (0, 10, -5), (44, 42, 48)), ellipsoid(p, (0, -26, 6), (43, 24, 38)),
               ellipsoid(p, (1, -8, 44), (8, 12, 12)), ellipsoid(p, (1, -36, 36), (10, 10, 10)))


def skull_distance(p):
    shell = max(ellipsoid(p, (0, 12, -6), (36, 34, 40)), -ellipsoid(p, (0, 14, -8), (28, 26, 31)))
    return min(shell, box(p, (-12, -22, 8), (12, -10, 34)))


def mandible_distance(p):
    x, z = p[0], max(p[2], 0)
    far = math.hypot(x, z) or 1
    ring = math.dist((x, p[1] + 31, p[2]), (28 * x / far, 0, 28 * z / far)) - 6
    return min(ring, box((abs(x), p[1], p[2]), (25, -33, -6), (33, -14, 4)))


def within(distance):
    return min(1, max(0, .5 - distance / STEP))


def head():
    """Hounsfield units and labels by voxel, and the skull and the mandible as points and triangles."""
    values, labels = [], []
    for k in range(SIZE[2]):
        for j in range(SIZE[1]):
            for i in range(SIZE[0]):
                x, y, z = (f + STEP * n for f, n in zip(FIRST, (i, j, k)))
                p = (x, z, -y)
                skull, mandible = skull_distance(p), mandible_distance(p)
                values.append(round(AIR + (SOFT - AIR) * within(skin_distance(p)) +
                                    (BONE - SOFT) * within(min(skull, mandible))))
                labels.append(SKULL if skull < 0 else MANDIBLE if mandible < 0 else 0)
    return values, labels


def blocks(labels, wanted):
    """Sides of the voxels that have a label, in the patient's frame."""
    at = {(n % SIZE[0], n // SIZE[0] % SIZE[1], n // (SIZE[0] * SIZE[1])) for n, one in enumerate(labels) if one == wanted}
    points, triangles = {}, []
    for voxel in sorted(at):
        for axis in range(3):
            for side in (0, 1):
                beside = list(voxel)
                beside[axis] += 2 * side - 1
                if tuple(beside) in at:
                    continue
                u, v = [0, 0, 0], [0, 0, 0]
                u[(axis + 1) % 3], v[(axis + 2) % 3] = 1, 1
                corner = [c + (side if a == axis else 0) for a, c in enumerate(voxel)]
                ring = [corner, [c + d for c, d in zip(corner, u)], [c + d + e for c, d, e in zip(corner, u, v)],
                        [c + d for c, d in zip(corner, v)]]
                a, b, c, d = (points.setdefault(tuple(one), len(points)) for one in (ring if side else ring[::-1]))
                triangles += [(a, b, c), (a, c, d)]
    return [tuple(f + STEP * (c - .5) for f, c in zip(FIRST, one)) for one in points], triangles


def even(value, filler=b" "):
    return value + filler * (len(value) % 2)


def element(group, number, kind, value, explicit):
    if isinstance(value, int):
        value = struct.pack("<H", value)
    elif isinstance(value, str):
        value = even(value.encode(), b"\0" if kind == "UI" else b" ")
    tag = struct.pack("<HH", group, number)
    if not explicit:
        return tag + struct.pack("<I", len(value)) + value
    if kind in LONG:
        return tag + kind.encode() + struct.pack("<HI", 0, len(value)) + value
    return tag + kind.encode() + struct.pack("<H", len(value)) + value


def run_lengths(plane):
    """One byte of every value, in PackBits without repetitions longer than a row."""
    out = b""
    for at in range(0, len(plane), SIZE[0]):
        row = plane[at:at + SIZE[0]]
        while row:
            count = next((n for n in range(len(row)) if row[n] != row[0]), len(row))
            out, row = out + (bytes([257 - count, row[0]]) if count > 1 else bytes([0, row[0]])), row[count:]
    return even(out, b"\0")


def as_run_lengths(pixels):
    planes = [run_lengths(pixels[first::2]) for first in (1, 0)]
    return struct.pack("<16I", 2, 64, 64 + len(planes[0]), *[0] * 13) + b"".join(planes)


def as_lossless_jpeg(pixels):
    """ITU-T T.81, process 14, each value predicted by its left neighbour. All codes have 5 bits."""
    values = struct.unpack(f"<{len(pixels) // 2}H", pixels)
    bits = []
    for n, value in enumerate(values):
        at = n % SIZE[0]
        before = values[n - 1] if at else values[n - SIZE[0]] if n else 1 << 15
        off = (value - before + (1 << 15)) % (1 << 16) - (1 << 15)
        size = abs(off).bit_length()
        bits.append(format(size, "05b") + (format(off if off > 0 else off + (1 << size) - 1, f"0{size}b") if size % 16 else ""))
    bits = "".join(bits)
    bits += "1" * (-len(bits) % 8)
    data = int(bits, 2).to_bytes(len(bits) // 8, "big").replace(b"\xff", b"\xff\0")
    return even(b"\xff\xd8\xff\xc3" + struct.pack(">HBHHB3B", 11, 16, SIZE[1], SIZE[0], 1, 1, 0x11, 0) +
                b"\xff\xc4" + struct.pack(">HB16B17B", 36, 0, 0, 0, 0, 0, 17, *[0] * 11, *range(17)) +
                b"\xff\xda" + struct.pack(">HB2B3B", 8, 1, 1, 0, 1, 0, 0) + data + b"\xff\xd9", b"\0")


def dicom(values, plane, syntax=EXPLICIT):
    """One slice. The values are unsigned and compressed, or signed and plain."""
    packed = syntax in (RUN_LENGTHS, LOSSLESS_JPEG)
    explicit, lift = syntax != IMPLICIT, 1024 if packed else 0
    own = [v + lift for v in values[plane * SIZE[0] * SIZE[1]:(plane + 1) * SIZE[0] * SIZE[1]]]
    pixels = struct.pack(f"<{len(own)}{'H' if packed else 'h'}", *own)
    uid = f"1.2.3.4.5.{plane + 1}"
    meta = b"".join(element(2, number, kind, value, True) for number, kind, value in (
        (1, "OB", b"\0\1"), (2, "UI", "1.2.840.10008.5.1.4.1.1.2"), (3, "UI", uid), (0x10, "UI", syntax), (0x12, "UI", "1.2.3.4")))
    name = element(8, 0x1155, "UI", "1.2.3", explicit)
    nested = struct.pack("<HHI", 0xfffe, 0xe000, len(name)) + name
    tags = [(8, 8, "CS", "ORIGINAL\\PRIMARY\\AXIAL"), (8, 0x16, "UI", "1.2.840.10008.5.1.4.1.1.2"), (8, 0x18, "UI", uid),
            (8, 0x60, "CS", "CT"), (8, 0x1140, "SQ", nested), (0x10, 0x10, "PN", "Made^Up"), (0x10, 0x20, "LO", "ID-0001"),
            (0x20, 0xd, "UI", "1.2.3.4"), (0x20, 0xe, "UI", "1.2.3.4.5"), (0x20, 0x11, "IS", "1"),
            (0x20, 0x32, "DS", f"{FIRST[0]}\\{FIRST[1]}\\{FIRST[2] + STEP * plane}"), (0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0"),
            (0x28, 2, "US", 1), (0x28, 4, "CS", "MONOCHROME2"), (0x28, 0x10, "US", SIZE[1]), (0x28, 0x11, "US", SIZE[0]),
            (0x28, 0x30, "DS", f"{STEP}\\{STEP}"), (0x28, 0x100, "US", 16), (0x28, 0x101, "US", 16), (0x28, 0x102, "US", 15),
            (0x28, 0x103, "US", 0 if packed else 1), (0x28, 0x1052, "DS", str(-lift)), (0x28, 0x1053, "DS", "1")]
    data = b"".join(element(*tag, explicit) for tag in tags)
    if packed:
        one = as_run_lengths(pixels) if syntax == RUN_LENGTHS else as_lossless_jpeg(pixels)
        data += b"\xe0\x7f\x10\0OB\0\0\xff\xff\xff\xff" + b"".join(
            struct.pack("<HHI", 0xfffe, tag, len(part)) + part for tag, part in ((0xe000, b""), (0xe000, one), (0xe0dd, b"")))
    else:
        data += element(0x7fe0, 0x10, "OW", pixels, explicit)
    return bytes(128) + b"DICM" + element(2, 0, "UL", struct.pack("<I", len(meta)), True) + meta + data


def series(values):
    return {f"{plane:02}.dcm": dicom(values, plane) for plane in range(SIZE[2])}


def nrrd(values, encoding="raw"):
    data = struct.pack(f"<{len(values)}h", *values)
    if encoding == "ascii":
        data = " ".join(map(str, values)).encode() + b"\n"
    sides = " ".join("(" + ",".join(str(STEP * (a == b)) for b in range(3)) + ")" for a in range(3))
    return (f"NRRD0004\n# made by code\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: "
            f"{SIZE[0]} {SIZE[1]} {SIZE[2]}\nspace directions: {sides}\nkinds: domain domain domain\nendian: little\n"
            f"encoding: {encoding}\nspace origin: ({FIRST[0]},{FIRST[1]},{FIRST[2]})\n\n").encode() + (
        gzip.compress(data, mtime=0) if encoding == "gzip" else data)


def nifti(values):
    """Its axes run to the right, forward and up."""
    head = bytearray(352)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, *SIZE, 1, 1, 1, 1)
    struct.pack_into("<2h", head, 70, 4, 16)
    struct.pack_into("<8f", head, 76, 1, STEP, STEP, STEP, 1, 1, 1, 1)
    struct.pack_into("<3f", head, 108, 352, 1, 0)
    head[123] = 2
    struct.pack_into("<2h", head, 252, 0, 1)
    struct.pack_into("<12f", head, 280, -STEP, 0, 0, -FIRST[0], 0, -STEP, 0, -FIRST[1], 0, 0, STEP, FIRST[2])
    head[344:348] = b"n+1\0"
    return bytes(head) + struct.pack(f"<{len(values)}h", *values)
