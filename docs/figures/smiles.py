#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The moving picture of README.md: the faces of smiles.mjs side by side, with their millimetres.

  python3 docs/figures/smiles.py out/demo FOLDER docs/images/smiles.webp
Needs python3-pil and fonts-dejavu-core."""
import csv
import pathlib
import sys

from PIL import Image, ImageChops, ImageDraw, ImageFont, ImageStat

WIDTH, HEIGHT, CAPTION = 290, 290, 64
ABOVE = 0.3  # of a stage that is left out: the forehead hardly moves
FONTS = pathlib.Path("/usr/share/fonts/truetype/dejavu")


def right_corners(run):
    """For base and each variant: its name and how far the right corner of the mouth moves, mm."""
    with open(run / "variants_excursions.csv", newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if (row["point"], row["side"]) == ("cheilion", "R")]
    return [("the recorded smile", float(rows[0]["base_mm"]))] + [
        (row["variant"], float(row["variant_mm"])) for row in rows]


def middle(picture):
    """The middle of a stage, as wide as a face needs."""
    top = ABOVE * picture.height
    width = (picture.height - top) * WIDTH / HEIGHT
    left = (picture.width - width) / 2
    box = (round(left), round(top), round(left + width), picture.height)
    return picture.crop(box).resize((WIDTH, HEIGHT), Image.LANCZOS)


def from_the_peak(frames):
    """Turned round so that the face that differs most from rest comes first: some viewers show that one alone."""
    def differs(frame):
        return sum(ImageStat.Stat(ImageChops.difference(frame, frames[0])).sum)
    peak = max(range(len(frames)), key=lambda i: differs(frames[i]))
    return frames[peak:] + frames[:peak]


def main(run, folder, out):
    faces = right_corners(pathlib.Path(run))
    name = ImageFont.truetype(str(FONTS / "DejaVuSans.ttf"), 15)
    number = ImageFont.truetype(str(FONTS / "DejaVuSans-Bold.ttf"), 18)
    frames = []
    for first in sorted(pathlib.Path(folder).glob("0_*.png")):
        frame = Image.new("RGB", (WIDTH * len(faces), HEIGHT + CAPTION), "white")
        draw = ImageDraw.Draw(frame)
        for i, (words, mm) in enumerate(faces):
            picture = Image.open(first.with_name(f"{i}_{first.name[2:]}")).convert("RGB")
            frame.paste(middle(picture), (i * WIDTH, 0))
            for text, font, y in ((words, name, 18), (f"right corner {mm:.1f} mm", number, 44)):
                draw.text((i * WIDTH + WIDTH / 2, HEIGHT + y), text, "#222222", font, anchor="mm")
        frames.append(frame)
    frames = from_the_peak(frames)
    frames[0].save(out, save_all=True, append_images=frames[1:], duration=67, loop=0, quality=70, method=6)


if __name__ == "__main__":
    main(*sys.argv[1:])
