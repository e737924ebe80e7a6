// SPDX-License-Identifier: GPL-3.0-or-later
// The subject's own sides, in the same order everywhere: right first, as on a face seen from in front.

export type Side = 'right' | 'left';
export type Letter = 'R' | 'L';

export const sides: Side[] = ['right', 'left'];
export const letterOf: Record<Side, Letter> = { right: 'R', left: 'L' };

interface SideWords {
  /** Over a view of the face. */
  letters: Record<Letter, string>;
  hints: Record<Letter, string>;
}

let words: SideWords = {
  letters: { R: 'R', L: 'L' }, hints: { R: 'The subject’s own right', L: 'The subject’s own left' },
};

/** Sets the words of another language. */
export function useSideWords(given: SideWords): void {
  words = given;
}

export const sideLetter = (letter: Letter): string => words.letters[letter];
export const sideHint = (letter: Letter): string => words.hints[letter];
