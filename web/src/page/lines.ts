// SPDX-License-Identifier: GPL-3.0-or-later
/** A number and its unit, or a sign and its number, stay in one line: "8.5 mm", "30 %", "± 0.6". */
const kept = /(?<=\d) (?=(?:mm|m|s|ms|Hz|kPa|Pa|%|°)(?![\p{L}\d]))|(?<=±) /gu;

/** Breaks a text at blanks to lines of at most `most` pixels. */
export function linesOf(pen: CanvasRenderingContext2D, text: string, most: number): string[] {
  const lines: string[] = [];
  for (const word of text.replace(kept, '\u00a0').split(' ')) {
    const longer = lines.length > 0 ? `${lines[lines.length - 1]} ${word}` : word;
    if (lines.length > 0 && pen.measureText(longer).width <= most) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines.map((line) => line.replaceAll('\u00a0', ' '));
}
