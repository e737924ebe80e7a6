// SPDX-License-Identifier: GPL-3.0-or-later
// Names of action units: P. Ekman, W. V. Friesen, J. C. Hager, "Facial Action Coding System" (2002).

const names: Record<string, string> = {
  AU1: 'inner brow raiser', AU2: 'outer brow raiser', AU4: 'brow lowerer', AU5: 'upper lid raiser',
  AU6: 'cheek raiser', AU7: 'lid tightener', AU9: 'nose wrinkler', AU10: 'upper lip raiser',
  AU11: 'nasolabial furrow deepener', AU12: 'lip corner puller', AU13: 'sharp lip puller', AU14: 'dimpler',
  AU15: 'lip corner depressor', AU16: 'lower lip depressor', AU17: 'chin raiser', AU18: 'lip pucker',
  AU20: 'lip stretcher', AU22: 'lip funneler', AU23: 'lip tightener', AU24: 'lip pressor', AU25: 'lips part',
  AU26: 'jaw drop', AU27: 'mouth stretch', AU28: 'lip suck', AU29: 'jaw thrust', AU30: 'jaw sideways',
  AU34: 'puff', AU43: 'eye closure', AU45: 'blink',
};

/** "AU26+AU27" is "jaw drop, mouth stretch"; empty where FACS has no such unit. */
export const facsName = (facs: string): string =>
  facs.split('+').map((unit) => names[unit]).filter(Boolean).join(', ');
